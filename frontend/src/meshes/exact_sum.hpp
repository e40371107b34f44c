// Exact sums and products of doubles, for the signs of determinants that rounding leaves in doubt.
#pragma once

#include <cmath>
#include <vector>

namespace frontend {

/// A sum of doubles none of which overlaps another, the smallest first (Shewchuk, "Adaptive
/// Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates", 1997). It is exact as
/// long as nothing overflows or underflows.
class ExactSum {
 public:
  ExactSum() = default;
  static ExactSum product(double a, double b) {
    ExactSum result;
    const double rounded = a * b;
    result.add(std::fma(a, b, -rounded));
    result.add(rounded);
    return result;
  }
  static ExactSum difference(double a, double b) {
    ExactSum result;
    result.add(a);
    result.add(-b);
    return result;
  }

  void add(double value) {
    std::vector<double> terms;
    terms.reserve(terms_.size() + 1);
    for (const double term : terms_) {
      const double sum = value + term;
      const double virtual_part = sum - value;
      const double rest = (value - (sum - virtual_part)) + (term - virtual_part);
      if (rest != 0) terms.push_back(rest);
      value = sum;
    }
    if (value != 0) terms.push_back(value);
    terms_ = std::move(terms);
  }
  void add(const ExactSum& other) {
    for (const double term : other.terms_) add(term);
  }
  void subtract(const ExactSum& other) {
    for (const double term : other.terms_) add(-term);
  }
  ExactSum times(const ExactSum& other) const {
    ExactSum result;
    for (const double a : terms_) {
      for (const double b : other.terms_) result.add(product(a, b));
    }
    return result;
  }

  /// −1, 0 or 1.
  int sign() const {
    if (terms_.empty()) return 0;
    return terms_.back() < 0 ? -1 : 1;
  }

 private:
  std::vector<double> terms_;
};

}  // namespace frontend
