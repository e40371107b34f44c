#include "edges/solid_around.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "csgcore/polyhedron.hpp"

namespace frontend {
namespace {

using csgcore::Vec3;
using std::numbers::pi;

/// Two planes that meet at a smaller angle are one: six digits of a file tell no more.
constexpr double kSameAngle_rad = 1e-5;
/// A plane across which the line runs, rather than in it, has only a point of the line.
constexpr double kLeastAcross = 1e-6;

/// A point in a face is told to lie in the body after it is moved inwards by this share.
constexpr double kInwards = 1e-6;

/// Returns a unit vector that is perpendicular to a unit vector.
Vec3 perpendicular(const Vec3& direction) {
  const Vec3 size = glm::abs(direction);
  const Vec3 axis = size.x <= size.y && size.x <= size.z ? Vec3(1, 0, 0)
                    : size.y <= size.z                   ? Vec3(0, 1, 0)
                                                         : Vec3(0, 0, 1);
  return glm::normalize(glm::cross(direction, axis));
}

}  // namespace

SolidAround::SolidAround(const ImportedDesign& design, std::span<const Body> bodies,
                         uint64_t& steps)
    : bodies_(bodies),
      tree_(design.scene.model, static_cast<uint32_t>(design.scene.primitives.size())),
      steps_(steps) {}

CrossSection SolidAround::across(const Body& owner, const Vec3& point, const Vec3& direction) {
  gather(owner, point);
  const Vec3 x = perpendicular(direction);
  const Vec3 y = glm::cross(direction, x);
  traces_.clear();
  angles_rad_.clear();
  for (const Through& plane : through_) {
    const Trace trace{plane.place, glm::dot(plane.normal, x), glm::dot(plane.normal, y)};
    if (std::hypot(trace.x, trace.y) < kLeastAcross) continue;
    traces_.push_back(trace);
    const double normal_rad = std::atan2(trace.y, trace.x);
    for (const double turn : {-pi / 2, pi / 2}) {
      const double angle = normal_rad + turn;
      angles_rad_.push_back(angle < 0 ? angle + 2 * pi : angle);
    }
  }
  std::sort(angles_rad_.begin(), angles_rad_.end());
  const auto same = [](double a, double b) { return b - a < kSameAngle_rad; };
  angles_rad_.erase(std::unique(angles_rad_.begin(), angles_rad_.end(), same), angles_rad_.end());
  while (angles_rad_.size() > 1 &&
         angles_rad_.front() + 2 * pi - angles_rad_.back() < kSameAngle_rad) {
    angles_rad_.pop_back();
  }
  // The angles at which the solid begins or ends.
  std::vector<double> changes;
  const size_t count = angles_rad_.size();
  bool last = false;
  for (size_t i = 0; i < count; ++i) {
    const double next = i + 1 < count ? angles_rad_[i + 1] : angles_rad_[0] + 2 * pi;
    if (i == 0) last = is_solid_at((angles_rad_[count - 1] + angles_rad_[0] + 2 * pi) / 2);
    const bool is_solid = is_solid_at((angles_rad_[i] + next) / 2);
    if (is_solid != last) changes.push_back(angles_rad_[i]);
    last = is_solid;
  }
  forget();
  if (changes.empty()) return CrossSection::kNone;
  const bool is_flat =
      changes.size() == 2 && std::abs(changes[1] - changes[0] - pi) < kSameAngle_rad;
  return is_flat ? CrossSection::kFlat : CrossSection::kEdge;
}

bool SolidAround::is_cut(const Body& owner, const Vec3& point) {
  gather(owner, point);
  const bool is_kept = tree_.value();
  forget();
  return !is_kept;
}

/// Finds the closed bodies that hold the point, and says so to the tree.
void SolidAround::gather(const Body& owner, const Vec3& point) {
  look_at(owner, point);
  const csgcore::Box at{point, point};
  steps_ += owner.neighbours.size();
  for (const uint32_t neighbour : owner.neighbours) {
    const Body& body = bodies_[neighbour];
    if (touch(body.box, at, body.tolerance)) look_at(body, point);
  }
  is_outside_.assign(near_.size(), 0);
}

void SolidAround::look_at(const Body& body, const Vec3& point) {
  const size_t known = through_.size();
  const Position position = position_of(body, point);
  if (position == Position::kOutside) {
    through_.resize(known);
    return;
  }
  near_.push_back(body.primitive);
  tree_.set(body.primitive, true);
}

/// Adds the planes that the point lies in to through_, also if it lies outside.
SolidAround::Position SolidAround::position_of(const Body& body, const Vec3& point) {
  if (!body.mesh) {
    return csgcore::contains(*body.canonical, point) ? Position::kInside : Position::kOutside;
  }
  const auto place = static_cast<uint32_t>(near_.size());
  bool is_outside = false;
  const auto compare = [&](const BodyPlane& plane) {
    const double above = plane.above(point);
    is_outside = is_outside || above > body.tolerance;
    if (std::abs(above) <= body.tolerance) through_.push_back({place, plane.normal});
  };
  if (!body.canonical) {
    steps_ += body.planes.size();
    for (const BodyPlane& plane : body.planes) compare(plane);
    return is_outside ? Position::kOutside : Position::kInside;
  }
  const csgcore::CanonicalPrimitive& canonical = *body.canonical;
  const Vec3 local = canonical.world_to_canonical * (point - canonical.center);
  const double slack = 2 * body.tolerance * canonical.canonical_stretch;
  steps_ += kFewPlanes;
  if (canonical.polyhedron->contains(local, slack)) return Position::kInside;
  if (!canonical.polyhedron->contains((1 - kInwards - slack) * local)) return Position::kOutside;
  // The point lies in a face, or beside one.
  body.faces.for_each_near({point, point}, 2 * body.tolerance, steps_,
                           [&](uint32_t face) { compare(body.planes[face]); });
  return is_outside ? Position::kOutside : Position::kInside;
}

void SolidAround::forget() {
  for (const uint32_t primitive : near_) tree_.set(primitive, false);
  near_.clear();
  through_.clear();
}

bool SolidAround::is_solid_at(double angle_rad) {
  const double x = std::cos(angle_rad);
  const double y = std::sin(angle_rad);
  std::fill(is_outside_.begin(), is_outside_.end(), 0);
  for (const Trace& trace : traces_) {
    if (trace.x * x + trace.y * y > 0) is_outside_[trace.place] = 1;
  }
  for (size_t i = 0; i < near_.size(); ++i) tree_.set(near_[i], is_outside_[i] == 0);
  return tree_.value();
}

}  // namespace frontend
