#include "meshes/planar_predicates.hpp"

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace frontend {
namespace {

using glm::dvec2;

constexpr double kEpsilon = std::numeric_limits<double>::epsilon() / 2;
/// Bounds of the determinants' rounding, as shares of the sums of their terms' sizes (Shewchuk
/// 1997, §4.3 and §4.4).
constexpr double kOrientationError = (3 + 16 * kEpsilon) * kEpsilon;
constexpr double kCircleError = (10 + 96 * kEpsilon) * kEpsilon;

int sign_of(double value) { return (value > 0) - (value < 0); }

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

struct ExactOffset {
  ExactSum x, y;
  ExactOffset(const dvec2& from, const dvec2& to)
      : x(ExactSum::difference(to.x, from.x)), y(ExactSum::difference(to.y, from.y)) {}
};

ExactSum exact_cross(const ExactOffset& a, const ExactOffset& b) {
  ExactSum result = a.x.times(b.y);
  result.subtract(a.y.times(b.x));
  return result;
}

}  // namespace

int orientation(const dvec2& a, const dvec2& b, const dvec2& c) {
  const double left = (a.x - c.x) * (b.y - c.y), right = (a.y - c.y) * (b.x - c.x);
  const double turn = left - right;
  if (std::abs(turn) > kOrientationError * (std::abs(left) + std::abs(right))) return sign_of(turn);
  return exact_cross(ExactOffset(c, a), ExactOffset(c, b)).sign();
}

int in_circle(const dvec2& a, const dvec2& b, const dvec2& c, const dvec2& d) {
  const dvec2 da = a - d, db = b - d, dc = c - d;
  const auto lift = [](const dvec2& v) { return v.x * v.x + v.y * v.y; };
  const auto turn = [](const dvec2& u, const dvec2& v) { return u.x * v.y - u.y * v.x; };
  const auto size = [](const dvec2& u, const dvec2& v) {
    return std::abs(u.x * v.y) + std::abs(u.y * v.x);
  };
  const double determinant =
      lift(da) * turn(db, dc) + lift(db) * turn(dc, da) + lift(dc) * turn(da, db);
  const double largest =
      lift(da) * size(db, dc) + lift(db) * size(dc, da) + lift(dc) * size(da, db);
  return std::abs(determinant) > kCircleError * largest ? sign_of(determinant) : 0;
}

}  // namespace frontend
