#include "plane/hull.hpp"

#include <algorithm>
#include <cmath>

#include "base/angles.hpp"

namespace frontend {
namespace {

using csgcore::ProfileEdge;
using csgcore::ProfileLoop;

/// Returns the corners of the points' hull, counterclockwise (Andrew's monotone chain).
Polygon hull_of_points(Polygon points) {
  const auto less = [](const Vec2& a, const Vec2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; };
  std::sort(points.begin(), points.end(), less);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  Polygon hull;
  const auto add_chain = [&](auto begin, auto end) {
    const size_t first = hull.size();
    for (auto point = begin; point != end; ++point) {
      while (hull.size() >= first + 2 &&
             cross(hull.back() - hull[hull.size() - 2], *point - hull.back()) <= 0) {
        hull.pop_back();
      }
      hull.push_back(*point);
    }
    hull.pop_back();  // the other chain starts there
  };
  add_chain(points.begin(), points.end());
  add_chain(points.rbegin(), points.rend());
  return hull;
}

/// In radians: far above rounding, and a corner so flat cannot be seen.
constexpr double kSameAngle = 1e-9;

Vec2 direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

/// A step around the hull: the next disc, and the outward normal of the line that touches both.
struct Step {
  size_t disc;
  double normal_angle;
  Vec2 normal;
};

/// Goes around discs by the lines that touch two of them, as one wraps a gift. No disc holds all
/// others.
class Wrapping {
 public:
  explicit Wrapping(std::span<const Disc> discs) : discs_(discs) {}

  ProfileLoop loop() {
    const size_t start = lowest();
    size_t at = start;
    double angle = -kTurn / 4;
    const double end = angle + kTurn;
    std::vector<Step> steps;
    // Each disc shows in at most as many arcs as there are others; rounding adds no more.
    while (steps.size() <= 2 * discs_.size()) {
      const Step step = next(at, angle);
      if (step.disc == at || step.normal_angle > end + kSameAngle) break;
      steps.push_back(step);
      if (step.disc == start && step.normal_angle >= end - kSameAngle) break;
      at = step.disc;
      angle = step.normal_angle;
    }
    return loop_of(steps);
  }

 private:
  size_t lowest() const {
    const auto depth = [](const Disc& d) { return d.center.y - d.radius; };
    size_t best = 0;
    for (size_t i = 1; i < discs_.size(); ++i) {
      const double difference = depth(discs_[i]) - depth(discs_[best]);
      // Of several that touch the lowest line, the hull leaves it at the last one.
      if (difference < 0 || (difference == 0 && discs_[i].center.x > discs_[best].center.x)) {
        best = i;
      }
    }
    return best;
  }

  /// The first disc that reaches as far as disc `at` while the normal turns on from `angle`.
  Step next(size_t at, double angle) const {
    const Disc& from = discs_[at];
    Step best{at, angle + 2 * kTurn, Vec2(0.0)};
    double best_length = 0;
    for (size_t i = 0; i < discs_.size(); ++i) {
      const Vec2 gap = discs_[i].center - from.center;
      const double growth = from.radius - discs_[i].radius;
      const double distance = glm::length(gap);
      if (distance <= std::abs(growth)) continue;  // one holds the other
      double turn = std::atan2(gap.y, gap.x) - std::acos(growth / distance) - angle;
      turn = std::remainder(turn, kTurn);
      if (turn < -kSameAngle) turn += kTurn;
      const double normal_angle = angle + std::max(turn, 0.0);
      const double length = std::sqrt((distance - growth) * (distance + growth));
      const double difference = normal_angle - best.normal_angle;
      const bool is_next = difference < -kSameAngle ||
                           (difference <= kSameAngle &&
                            reaches_further(length, discs_[i], best_length, discs_[best.disc]));
      if (is_next) {
        const Vec2 across(gap.y, -gap.x);
        best = {i, normal_angle, (growth * gap + length * across) / (distance * distance)};
        best_length = length;
      }
    }
    return best;
  }

  /// Of two discs that touch the same line, at those lengths along it.
  static bool reaches_further(double length, const Disc& disc, double other_length,
                              const Disc& other) {
    const double rounding = kSameAngle * length;
    if (std::abs(length - other_length) > rounding) return length > other_length;
    return disc.radius > other.radius;
  }

  Vec2 point_on(size_t disc, const Vec2& normal) const {
    return discs_[disc].center + discs_[disc].radius * normal;
  }

  ProfileLoop loop_of(const std::vector<Step>& steps) const {
    ProfileLoop loop;
    for (size_t i = 0; i < steps.size(); ++i) {
      const bool is_last = i + 1 == steps.size();
      Step leaves = is_last ? steps.front() : steps[i + 1];
      if (is_last) leaves.normal_angle += kTurn;
      ProfileEdge line;
      line.end = point_on(steps[i].disc, steps[i].normal);
      loop.push_back(line);
      if (discs_[steps[i].disc].radius > 0) add_arc(steps[i], leaves, loop);
    }
    return loop;
  }

  void add_arc(const Step& step, const Step& leaves, ProfileLoop& loop) const {
    const double sweep = leaves.normal_angle - step.normal_angle;
    if (sweep <= 0) return;
    ProfileEdge arc;
    arc.kind = ProfileEdge::Kind::kArc;
    arc.control = discs_[step.disc].center;
    if (sweep > kTurn / 2) {
      arc.end = point_on(step.disc, direction(step.normal_angle + sweep / 2));
      loop.push_back(arc);
    }
    arc.end = point_on(step.disc, leaves.normal);
    loop.push_back(arc);
  }

  std::span<const Disc> discs_;
};

}  // namespace

Figure convex_hull(std::span<const Disc> discs) {
  Polygon points;
  std::vector<Disc> parts;
  for (const Disc& disc : discs) {
    if (disc.radius > 0) {
      parts.push_back(disc);
    } else {
      points.push_back(disc.center);
    }
  }
  points = hull_of_points(std::move(points));
  if (parts.empty()) {
    if (points.size() < 3) return Outline{};
    return outline_of(Polygons{points});
  }
  for (const Vec2& point : points) parts.push_back({point, 0});
  const auto largest = std::max_element(
      parts.begin(), parts.end(), [](const Disc& a, const Disc& b) { return a.radius < b.radius; });
  const bool holds_all = std::all_of(parts.begin(), parts.end(), [&](const Disc& disc) {
    return glm::length(disc.center - largest->center) + disc.radius <= largest->radius;
  });
  if (holds_all) return *largest;
  Outline outline;
  outline.loops.push_back(Wrapping(parts).loop());
  return outline;
}

void add_hull_points(const Figure& figure, std::vector<Disc>& discs) {
  if (const Disc* disc = std::get_if<Disc>(&figure)) {
    discs.push_back(*disc);
    return;
  }
  for (const Polygon& polygon : chords_of(figure)) {
    for (const Vec2& point : polygon) discs.push_back({point, 0});
  }
}

}  // namespace frontend
