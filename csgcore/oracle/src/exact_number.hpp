// The two arithmetics of the exact ray oracle, and roots of quadratics in them.
#pragma once

#include <CGAL/Interval_nt.h>
#include <CGAL/Mpzf.h>

#include <cmath>

namespace oracle {

/// Exact sums and products of doubles, of any length. There are no quotients.
using Exact = CGAL::Mpzf;

inline Exact power_of_two(int exponent) { return Exact(std::ldexp(1.0, exponent)); }

/// Doubles that enclose a number. Intervals are valid only while a RoundingUp lives on the thread.
/// A predicate that they cannot decide throws Undecided.
using Interval = CGAL::Interval_nt<false>;
using RoundingUp = CGAL::Protect_FPU_rounding<true>;
using Undecided = CGAL::Uncertain_conversion_exception;

/// Returns a number in the interval.
inline double middle(const Interval& interval) {
  return interval.inf() + (interval.sup() - interval.inf()) / 2;
}

/// Returns an interval around the number; of width 0 if the number is a double.
Interval enclose(const Exact& number);

/// The function a·t² + 2b·t + c along a ray, which is negative inside the primitive's wall;
/// discriminant = b² − a·c.
template <class Number>
struct Quadratic {
  Number a, b, c, discriminant;
};

/// The number (p + q·√radicand)/r with r > 0, which is rational if q = 0.
struct ExactRoot {
  Exact p, q, radicand, r;
};

// Both arithmetics have the following functions. A parameter t is an Interval or an ExactRoot.

/// Returns −1, 0 or 1.
inline int sign_of(const Exact& number) { return number.sign(); }
inline int sign_of(const Interval& number) { return CGAL::make_certain(CGAL::sign(number)); }

/// Compares two parameters of the same ray. Returns −1 if `a` comes first, 0 if they are equal, 1
/// otherwise.
int compare(const ExactRoot& a, const ExactRoot& b);
inline int compare(const Interval& a, const Interval& b) {
  return CGAL::make_certain(CGAL::compare(a, b));
}

/// Returns numerator/denominator. The denominator must not be 0.
ExactRoot quotient(const Exact& numerator, const Exact& denominator);
inline Interval quotient(const Interval& numerator, const Interval& denominator) {
  return numerator / denominator;
}

/// Returns the parameter that comes `by` later.
inline ExactRoot moved(ExactRoot t, double by) {
  if (by != 0) t.p = t.p + Exact(by) * t.r;
  return t;
}

/// Returns the root at which the ray enters the wall, or leaves it. It must have this root, and a
/// discriminant > 0 (or a = 0).
ExactRoot root_of(const Quadratic<Exact>& quadratic, bool enters);
Interval root_of(const Quadratic<Interval>& quadratic, bool enters);

}  // namespace oracle
