#include "exact_number.hpp"

#include <CGAL/Sqrt_extension.h>

#include <cmath>

namespace oracle {
namespace {

/// Roots in CGAL, which compares those of different radicands by repeated squaring. It has no
/// filter of its own, since callers have tried intervals before.
using Extension = CGAL::Sqrt_extension<Exact, Exact, CGAL::Tag_true, CGAL::Tag_false>;

/// Returns root·scale·root.r. CGAL takes √0 for positive, so that a rational number must not be
/// given as a root.
Extension scaled(const ExactRoot& root, const Exact& scale) {
  if (root.q.is_zero() || root.radicand.is_zero()) return Extension(Exact(root.p * scale));
  return Extension(Exact(root.p * scale), Exact(root.q * scale), root.radicand);
}

}  // namespace

int compare(const ExactRoot& a, const ExactRoot& b) {
  constexpr bool kSameRadicand = false;
  return scaled(a, b.r).compare(scaled(b, a.r), kSameRadicand);
}

Interval enclose(const Exact& number) {
  const double nearest = CGAL::to_double(number);
  const bool is_double = std::isfinite(nearest) && Exact(nearest) == number;
  return is_double ? Interval(nearest) : Interval(CGAL::to_interval(number));
}

ExactRoot quotient(const Exact& numerator, const Exact& denominator) {
  if (denominator.sign() > 0) return {numerator, 0, 0, denominator};
  return {-numerator, 0, 0, -denominator};
}

// Half the derivative, a·t + b, is −√discriminant where the ray enters, and √discriminant where it
// leaves.

ExactRoot root_of(const Quadratic<Exact>& quadratic, bool enters) {
  const auto& [a, b, c, discriminant] = quadratic;
  const int a_sign = a.sign();
  if (a_sign == 0) return quotient(-c, Exact(2) * b);
  const Exact slope(enters ? -1 : 1);
  if (a_sign > 0) return {-b, slope, discriminant, a};
  return {b, -slope, discriminant, -a};
}

Interval root_of(const Quadratic<Interval>& quadratic, bool enters) {
  const auto& [a, b, c, discriminant] = quadratic;
  const Interval root = CGAL::sqrt(discriminant);
  const Interval slope = enters ? -root : root;
  // The root has the forms (slope − b)/a and c/(−b − slope). Take the one without cancellation.
  const bool opposite = enters ? b.sup() < 0 : b.inf() > 0;
  return opposite ? c / (-b - slope) : (slope - b) / a;
}

}  // namespace oracle
