// The two arithmetics of the exact ray oracle, and roots of quadratics in them.
#pragma once

#include <CGAL/Interval_nt.h>
#include <CGAL/Mpzf.h>

#include <cmath>

namespace oracle {

/// Sums and products of doubles, of any length. No quotients.
using Exact = CGAL::Mpzf;

inline Exact power_of_two(int exponent) { return Exact(std::ldexp(1.0, exponent)); }

/// Doubles that enclose a number. Valid while a RoundingUp lives on the thread; a predicate that it
/// cannot decide throws Undecided.
using Interval = CGAL::Interval_nt<false>;
using RoundingUp = CGAL::Protect_FPU_rounding<true>;
using Undecided = CGAL::Uncertain_conversion_exception;

/// A number that is a double is enclosed by itself alone.
Interval enclose(const Exact& number);

/// a·t² + 2b·t + c along a ray, negative within the primitive's wall; discriminant = b² − a·c.
template <class Number>
struct Quadratic {
  Number a, b, c, discriminant;
};

/// (p + q·√radicand)/r, r > 0; rational where q = 0.
struct ExactRoot {
  Exact p, q, radicand, r;
};

// What both arithmetics offer. A parameter t is an Interval or an ExactRoot.

/// −1, 0 or 1.
inline int sign_of(const Exact& number) { return number.sign(); }
inline int sign_of(const Interval& number) { return CGAL::make_certain(CGAL::sign(number)); }

/// Of two parameters along the same ray: −1 if `a` comes first, 0 if they are equal.
int compare(const ExactRoot& a, const ExactRoot& b);
inline int compare(const Interval& a, const Interval& b) {
  return CGAL::make_certain(CGAL::compare(a, b));
}

/// numerator/denominator; the denominator is not 0.
ExactRoot quotient(const Exact& numerator, const Exact& denominator);
inline Interval quotient(const Interval& numerator, const Interval& denominator) {
  return numerator / denominator;
}

/// The root at which the ray enters the wall, or leaves it; it has one, and a discriminant > 0.
ExactRoot root_of(const Quadratic<Exact>& quadratic, bool enters);
Interval root_of(const Quadratic<Interval>& quadratic, bool enters);

}  // namespace oracle
