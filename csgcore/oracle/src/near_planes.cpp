#include "near_planes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "box_tree.hpp"

namespace oracle {
namespace {

/// Error bound of a dozen operations, as a share of their largest term, for every rounding mode.
constexpr double kRounding = 16 * std::numeric_limits<double>::epsilon();

/// Bound of the sum of a normal's coordinates, each of which is at most 2.
constexpr double kNormalSum = 6;

double width(const Interval& x) { return x.sup() - x.inf(); }
double magnitude(const Interval& x) { return std::max(std::abs(x.inf()), std::abs(x.sup())); }

/// Returns the error bound of n·v if v's lower bounds are taken for v.
double error_of(const Vector<Interval>& v) {
  double error = 0;
  for (const Interval& x : v) error = std::max(error, width(x) + kRounding * magnitude(x));
  return kNormalSum * error;
}

double dot(const Vector<Interval>& a, const Vector<Interval>& b) {
  return a[0].inf() * b[0].inf() + a[1].inf() * b[1].inf() + a[2].inf() * b[2].inf();
}

}  // namespace

bool NearPlanes::find(const Target<Interval>& target, const LocalRay<Interval>& ray) {
  meetings_.clear();
  planes_.clear();
  const double origin_error = error_of(ray.o), ascent_error = error_of(ray.d);
  double begin = -kInfinity, end = kInfinity;  // the part certainly lies within these
  for (const Plane<Interval>& plane : target.planes) {
    const double ascent = dot(plane.normal, ray.d);
    const double room = plane.limit.inf() - dot(plane.normal, ray.o);
    const double room_error =
        origin_error + width(plane.limit) + kRounding * magnitude(plane.limit);
    const double least_ascent = std::abs(ascent) - ascent_error;
    if (!(least_ascent > 0)) {
      const double room_left = std::max(0.0, std::abs(room) - room_error);
      const double reach = room_left / (std::abs(ascent) + ascent_error);
      meetings_.push_back({room > 0 ? Kind::kStaysWithin : Kind::kStaysOutside, -reach, reach});
      continue;
    }
    // (r + δr)/(a + δa) − r/a = (δr − δa·r/a)/(a + δa)
    const double t = room / ascent;
    const double error =
        (room_error + std::abs(t) * ascent_error) / least_ascent + kRounding * std::abs(t);
    const Meeting meeting{ascent < 0 ? Kind::kEnters : Kind::kLeaves, t - error, t + error};
    if (meeting.kind == Kind::kEnters) begin = std::max(begin, meeting.lower);
    if (meeting.kind == Kind::kLeaves) end = std::min(end, meeting.upper);
    meetings_.push_back(meeting);
  }
  if (begin > end) return false;
  const double furthest = std::max(std::abs(begin), std::abs(end));
  for (uint32_t i = 0; i < meetings_.size(); ++i) {
    const auto& [kind, lower, upper] = meetings_[i];
    bool is_far = false;
    switch (kind) {
      case Kind::kEnters:
        is_far = upper < begin;
        break;
      case Kind::kLeaves:
        is_far = lower > end;
        break;
      case Kind::kStaysWithin:
        is_far = upper > furthest;
        break;
      case Kind::kStaysOutside:
        if (upper > furthest) return false;
        break;
    }
    if (!is_far) planes_.push_back(i);
  }
  return true;
}

}  // namespace oracle
