// Random numbers that are the same on every machine: distributions of std differ from one library
// to another.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>

namespace slow_search {

class Random {
 public:
  explicit Random(uint64_t seed) : engine_(seed) {}

  /// Returns a number in [0, limit); 0 if that is empty.
  std::size_t below(std::size_t limit) {
    return limit == 0 ? 0 : static_cast<std::size_t>(engine_() % limit);
  }
  /// Returns a number in [first, last].
  int from_to(int first, int last) {
    return first + static_cast<int>(below(static_cast<std::size_t>(last - first + 1)));
  }
  /// Returns a number in [low, high).
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  bool one_in(std::size_t count) { return below(count) == 0; }

 private:
  std::mt19937_64 engine_;
};

}  // namespace slow_search
