// Counts many errors in little memory.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace stress {

/// Counts errors by their logarithm. Medians are good to a few per cent.
class ErrorHistogram {
 public:
  void add(double error) {
    largest_ = std::max(largest_, error);
    ++count_;
    ++bins_[bin_of(error)];
  }
  void add(const ErrorHistogram& other) {
    largest_ = std::max(largest_, other.largest_);
    count_ += other.count_;
    for (size_t i = 0; i < kBins; ++i) bins_[i] += other.bins_[i];
  }
  uint64_t count() const { return count_; }
  double largest() const { return largest_; }
  /// 0 if there are none, or if it is below 2^kLowest.
  double median() const {
    uint64_t below = 0;
    for (size_t i = 0; i < kBins; ++i) {
      below += bins_[i];
      if (2 * below >= count_ && i > 0) {
        return std::exp2(kLowest + (double(i) - 0.5) / kBinsPerOctave);
      }
      if (2 * below >= count_) return 0;
    }
    return largest_;
  }

 private:
  static constexpr int kLowest = -80, kHighest = 20, kBinsPerOctave = 8;
  static constexpr size_t kBins = size_t{kHighest - kLowest} * kBinsPerOctave + 1;

  static size_t bin_of(double error) {
    if (!(error > std::exp2(kLowest))) return 0;
    const double octaves = std::log2(error) - kLowest;
    return std::min(kBins - 1, 1 + size_t(octaves * kBinsPerOctave));
  }

  std::array<uint64_t, kBins> bins_{};
  uint64_t count_ = 0;
  double largest_ = 0;
};

}  // namespace stress
