// Keeps for each family and size the design that is slowest per byte.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "design.hpp"
#include "random.hpp"

namespace slow_search {

struct Found {
  std::string family;  // of the design whose mutation it is, directly or not
  Design design;
  std::size_t bytes = 0;
  double excess_ms = 0;  // the median, minus that of `cube(1);`
  double cpu_ms = 0;     // of the whole process, all of its threads
  double peak_mb = 0;    // peak memory
  std::string end;       // "", "over the limit" or "signal"; then the time is a lower bound
  double ms_per_byte() const { return excess_ms / static_cast<double>(bytes); }
};

class Archive {
 public:
  /// The least excess at which a design of so many bytes is kept.
  double least_excess_ms(const std::string& family, std::size_t bytes) const;
  void add(Found found);

  bool empty() const { return kept_.empty(); }
  /// Returns any design; those with the largest excess come half of the time.
  const Found& any(Random& random) const;
  /// Returns first those beyond the threshold, then the others, each with the slowest per byte
  /// first.
  std::vector<Found> ranked(double threshold_ms) const;

 private:
  /// The family, and the logarithm of the bytes.
  using Slot = std::pair<std::string, int>;
  static Slot slot_of(const std::string& family, std::size_t bytes);
  std::map<Slot, Found> kept_;
};

}  // namespace slow_search
