#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <optional>
#include <utility>

#include "hulls/orthonormal.hpp"
#include "hulls/point_solid.hpp"
#include "hulls/round_bodies.hpp"
#include "hulls/strips.hpp"

namespace frontend {
namespace {

using csgcore::Primitive;
using csgcore::Vec3;
using glm::dvec2;

/// In the direction of an azimuth a disc reaches a = center·direction + radius, at its height z. A
/// plane that touches two discs is the line through their (a, z); a third one sticks out of it if
/// its a exceeds the line's.
class DiscStrips {
 public:
  explicit DiscStrips(RoundBodies discs)
      : discs_(std::move(discs)), slack_(discs_.slack()), tangents_(discs_.bodies.size()) {}

  std::optional<DiscHull> hull() {
    DiscHull result;
    const auto visit = [&](uint32_t i, uint32_t j, const Circle& circle, const CircleArcs& arcs) {
      for (const CircleArcs::Arc& arc : arcs.arcs()) {
        for (const double angle : {arc.begin, arc.end}) {
          const Vec3 direction(std::cos(angle), std::sin(angle), 0);
          if (is_round(i)) add_direction(direction, tangents_[i]);
          if (is_round(j)) add_direction(direction, tangents_[j]);
        }
      }
      if (arcs.length() < kLeastStrip) return;
      result.frusta.push_back(circle.growth > 0 ? DiscHull::Pair{i, j} : DiscHull::Pair{j, i});
    };
    if (!visit_strips(*this, discs_, visit)) return std::nullopt;
    for (size_t i = 0; i < size(); ++i) {
      if (!is_round(i)) result.points.push_back(disc(i).center);
      for (const Vec3& direction : tangents_[i]) {
        result.points.push_back(disc(i).center + disc(i).radius * direction);
      }
    }
    result.discs = std::move(discs_.bodies);
    return result;
  }

  // What strips.hpp asks for.

  struct Circle {
    double growth;  // of z from one disc to the other
  };
  size_t size() const { return discs_.bodies.size(); }
  bool is_round(size_t i) const { return disc(i).radius > 0; }
  std::optional<Circle> circle(size_t i, size_t j) const {
    const double growth = disc(j).center.z - disc(i).center.z;
    // Two at one height: the planes that touch both are those that touch a third one as well.
    if (std::abs(growth) <= slack_) return std::nullopt;
    return Circle{growth};
  }
  void cut(const Circle& circle, size_t i, size_t j, size_t k, CircleArcs& arcs) const {
    const RoundBody &a = disc(i), &b = disc(j), &c = disc(k);
    const double share = (c.center.z - a.center.z) / circle.growth;
    // Beyond both the line is far from them: weights that are large cancel.
    const double scale = 1 / std::max({1.0, std::abs(share), std::abs(1 - share)});
    const double weight_a = scale * (1 - share), weight_b = scale * share;
    const Vec3 gap = scale * (c.center - a.center) - weight_b * (b.center - a.center);
    arcs.cut(gap.x, gap.y, weight_a * a.radius + weight_b * b.radius - scale * c.radius + slack_);
  }

 private:
  const RoundBody& disc(size_t i) const { return discs_.bodies[i]; }

  RoundBodies discs_;
  const double slack_;
  std::vector<std::vector<Vec3>> tangents_;  // by disc: directions of azimuths
};

class BallHull {
 public:
  BallHull(RoundBodies balls, double least_strip, std::vector<Primitive>& pieces)
      : balls_(std::move(balls)),
        slack_(balls_.slack()),
        least_strip_(least_strip),
        pieces_(pieces),
        tangents_(balls_.bodies.size()),
        shows_(balls_.bodies.size()) {}

  bool add_pieces() {
    const auto visit = [this](uint32_t i, uint32_t j, const Circle& circle,
                              const CircleArcs& arcs) { add_strip(i, j, circle, arcs); };
    if (!visit_strips(*this, balls_, visit)) return false;
    add_polyhedron();
    for (size_t i = 0; i < size(); ++i) {
      if (is_round(i) && (shows_[i] || size() == 1)) {
        pieces_.push_back(
            csgcore::make_sphere(ball(i).radius, {csgcore::Mat3(1.0), ball(i).center}));
      }
    }
    return true;
  }

  // What strips.hpp asks for.

  /// The outward normals of the planes that touch two balls: axial · axis + radial · (x, y).
  struct Circle {
    Axes axes;
    double axial, radial, distance;
  };
  size_t size() const { return balls_.bodies.size(); }
  bool is_round(size_t i) const { return ball(i).radius > 0; }
  std::optional<Circle> circle(size_t i, size_t j) const {
    const Vec3 gap = ball(j).center - ball(i).center;
    const double distance = glm::length(gap);
    const double growth = ball(i).radius - ball(j).radius;
    if (distance <= std::abs(growth)) return std::nullopt;
    const double radial = std::sqrt((distance - growth) * (distance + growth)) / distance;
    return Circle{axes_along(gap / distance), growth / distance, radial, distance};
  }
  void cut(const Circle& circle, size_t i, size_t, size_t k, CircleArcs& arcs) const {
    const Vec3 gap = ball(k).center - ball(i).center;
    arcs.cut(
        circle.radial * glm::dot(gap, circle.axes.x), circle.radial * glm::dot(gap, circle.axes.y),
        ball(i).radius - ball(k).radius - circle.axial * glm::dot(gap, circle.axes.z) + slack_);
  }

 private:
  const RoundBody& ball(size_t i) const { return balls_.bodies[i]; }

  void add_strip(uint32_t i, uint32_t j, const Circle& circle, const CircleArcs& arcs) {
    shows_[i] = shows_[j] = true;
    for (const CircleArcs::Arc& arc : arcs.arcs()) {
      add_tangents(i, j, circle, arc.begin);
      add_tangents(i, j, circle, arc.end);
    }
    if (arcs.length() >= least_strip_) add_frustum(i, j, circle);
  }

  void add_tangents(uint32_t i, uint32_t j, const Circle& circle, double angle) {
    const Vec3 normal = circle.axial * circle.axes.z +
                        circle.radial * std::cos(angle) * circle.axes.x +
                        circle.radial * std::sin(angle) * circle.axes.y;
    if (is_round(i)) add_direction(normal, tangents_[i]);
    if (is_round(j)) add_direction(normal, tangents_[j]);
  }

  void add_frustum(uint32_t i, uint32_t j, const Circle& circle) {
    const double r = ball(i).radius, s = ball(j).radius;
    pieces_.push_back(csgcore::make_frustum(r * circle.axial, circle.distance + s * circle.axial,
                                            r * circle.radial, s * circle.radial,
                                            {circle.axes.matrix(), ball(i).center}));
  }

  void add_polyhedron() {
    std::vector<Vec3> points;
    for (size_t i = 0; i < size(); ++i) {
      if (!is_round(i)) points.push_back(ball(i).center);
      for (const Vec3& normal : tangents_[i]) {
        points.push_back(ball(i).center + ball(i).radius * normal);
      }
    }
    const bool has_round = std::any_of(balls_.bodies.begin(), balls_.bodies.end(),
                                       [](const RoundBody& body) { return body.radius > 0; });
    std::optional<PointSolid> solid = solid_of_points(points);
    // A sheet within a thick hull adds nothing.
    if (solid && !(has_round && solid->is_sheet)) pieces_.push_back(std::move(solid->primitive));
  }

  const RoundBodies balls_;
  const double slack_, least_strip_;
  std::vector<Primitive>& pieces_;
  std::vector<std::vector<Vec3>> tangents_;  // by ball: outward normals of planes that touch three
  std::vector<bool> shows_;
};

}  // namespace

Primitive DiscHull::frustum(const Pair& pair) const {
  const RoundBody& lower = discs[pair.lower];
  const RoundBody& upper = discs[pair.upper];
  const Vec3 gap = upper.center - lower.center;
  Primitive result = csgcore::make_frustum(0, gap.z, lower.radius, upper.radius);
  result.local_to_world.linear[2] = Vec3(gap.x / gap.z, gap.y / gap.z, 1);
  result.local_to_world.translation = lower.center;
  return result;
}

std::optional<DiscHull> disc_hull(std::vector<RoundBody> discs) {
  return DiscStrips(without_inner_bodies(std::move(discs), BodyKind::kDiscs)).hull();
}

bool add_disc_hull(std::vector<RoundBody> discs, std::vector<Primitive>& pieces) {
  const std::optional<DiscHull> hull = disc_hull(std::move(discs));
  if (!hull) return false;
  const std::optional<PointSolid> solid = solid_of_points(hull->points);
  // A sheet within a thick hull adds nothing.
  if (solid && !solid->is_sheet) pieces.push_back(solid->primitive);
  for (const DiscHull::Pair& pair : hull->frusta) pieces.push_back(hull->frustum(pair));
  return true;
}

bool add_ball_hull(std::vector<RoundBody> balls, double least_strip,
                   std::vector<Primitive>& pieces) {
  return BallHull(without_inner_bodies(std::move(balls), BodyKind::kBalls), least_strip, pieces)
      .add_pieces();
}

}  // namespace frontend
