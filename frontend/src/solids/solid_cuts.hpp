// The outcome of set operations on solids, where all of them are convex.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "solids/solid_value.hpp"

namespace frontend {

class SolidCuts {
 public:
  /// Returns convex parts whose union is the value, or nothing if failure() is not empty. What is
  /// round and takes part in a difference or an intersection becomes facets.
  std::vector<SolidPart> united(const SolidValue& value);
  std::string_view failure() const { return failure_; }

 private:
  using Parts = std::vector<SolidPart>;

  Parts operated(csgcore::Op op, std::vector<Parts> operands);
  Parts difference(Parts parts, const SolidPart& cutter);
  Parts intersection(const Parts& parts, const Parts& others);
  bool are_convex(const SolidPart& a, const SolidPart& b);
  bool is_affordable(size_t parts, size_t steps);
  void fail(std::string_view why);

  std::string_view failure_;
  size_t steps_ = 0;
};

}  // namespace frontend
