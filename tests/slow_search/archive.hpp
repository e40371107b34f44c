// Keeps, of each family and size of designs, the one that is slowest per byte.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "design.hpp"
#include "random.hpp"

namespace slow_search {

struct Found {
  std::string family;  // of the design that it was mutated from first
  Design design;
  std::size_t bytes = 0;
  double excess_ms = 0;  // of the median beyond what `cube(1);` takes
  double cpu_ms = 0;     // of the whole process, all of its threads
  double peak_mb = 0;    // of memory
  std::string end;       // "", "over the limit" or "signal"; then the time is a lower bound
  double ms_per_byte() const { return excess_ms / static_cast<double>(bytes); }
};

class Archive {
 public:
  /// Below that excess a design of so many bytes is not kept.
  double least_excess_ms(const std::string& family, std::size_t bytes) const;
  void add(Found found);

  bool empty() const { return kept_.empty(); }
  /// One of those with the largest excess as often as any other.
  const Found& any(Random& random) const;
  /// First those beyond the threshold, then the others, each the slowest per byte first.
  std::vector<Found> ranked(double threshold_ms) const;

 private:
  /// The family, and the bytes' logarithm.
  using Slot = std::pair<std::string, int>;
  static Slot slot_of(const std::string& family, std::size_t bytes);
  std::map<Slot, Found> kept_;
};

}  // namespace slow_search
