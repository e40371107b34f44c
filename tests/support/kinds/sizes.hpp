// Draws the sizes of random primitives.
#pragma once

#include <random>

namespace test_support {

struct SizeRange {
  double low = 0.2, high = 3;
  /// The share of the lengths that are multiples of `step`, so that some sizes are equal.
  double even_share = 0, step = 1;
  int most_fragments = 40;
};

/// Draws sizes. The generator must outlive this object.
class Sizes {
 public:
  explicit Sizes(std::mt19937& random, const SizeRange& range = {})
      : random_(random), range_(range) {}

  std::mt19937& random() { return random_; }
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  bool by_chance(double share) { return uniform(0, 1) < share; }

  /// Returns a length in [low, high].
  double length();
  /// Returns a number from 3 to most_fragments.
  int fragments() {
    return 3 + static_cast<int>(random_() % static_cast<uint32_t>(range_.most_fragments - 2));
  }

 private:
  std::mt19937& random_;
  const SizeRange range_;
};

}  // namespace test_support
