#include "hulls/strips.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/angles.hpp"

namespace frontend {
void CircleArcs::cut(double a, double b, double c) {
  const double amplitude = std::sqrt(a * a + b * b);
  if (c >= amplitude) return;
  if (c < -amplitude) {
    arcs_.clear();
    is_whole_ = false;
    return;
  }
  const double half = std::acos(c / amplitude);  // of the arc that is taken away
  const double begin = std::atan2(b, a) + half;
  const double length = kTurn - 2 * half;
  if (is_whole_) {
    origin_ = begin;
    arcs_ = {{begin, begin + length}};
    is_whole_ = false;
    return;
  }
  // Where what is left begins, within a turn from the origin; the same one turn earlier may reach
  // across the origin.
  double from = begin - origin_;
  from = origin_ + from - kTurn * std::floor(from / kTurn);
  cut_.clear();
  for (const Arc& arc : arcs_) {
    for (const double start : {from - kTurn, from}) {
      const Arc rest{std::max(arc.begin, start), std::min(arc.end, start + length)};
      if (rest.begin <= rest.end) cut_.push_back(rest);
    }
  }
  std::swap(arcs_, cut_);
}

double CircleArcs::length() const {
  if (is_whole_) return kTurn;
  double sum = 0;
  for (const Arc& arc : arcs_) sum += arc.end - arc.begin;
  return sum;
}

}  // namespace frontend
