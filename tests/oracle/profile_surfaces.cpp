#include "profile_surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

namespace oracle {

using csgcore::LongVec3;
using csgcore::Real;
using csgcore::reference::FigureEdge;

constexpr Real kInfinity = std::numeric_limits<Real>::infinity();

ProfileSurfaces::ProfileSurfaces(const csgcore::Primitive& primitive, const csgcore::Vec3& pivot)
    : primitive_(primitive),
      figure_(*primitive.profile()),
      world_to_local_(glm::inverse(csgcore::checks::LongMat3(primitive.local_to_world.linear))),
      pivot_(LongVec3(pivot) - LongVec3(primitive.local_to_world.translation)) {}

Real ProfileSurfaces::distance(const LongVec3& point) const {
  const LongVec3 local = world_to_local_ * (point + pivot_);
  const bool is_revolution = primitive_.shape() == csgcore::Shape::kRevolution;
  return is_revolution ? from_revolution(local) : from_extrusion(local);
}

Real ProfileSurfaces::thickness() const {
  const LongVec2 size = figure_.max() - figure_.min();
  const auto* const extrusion = std::get_if<csgcore::ExtrusionShape>(&primitive_.solid);
  const Real height = extrusion ? Real(extrusion->z_max) - extrusion->z_min : size.y;
  const Real across = extrusion ? std::min(size.x, size.y) : size.x;
  return std::min(
      {in_world(across, {1, 0, 0}), in_world(across, {0, 1, 0}), in_world(height, {0, 0, 1})});
}

/// Returns the length in world space of a step of local space across a plane with that unit normal.
Real ProfileSurfaces::in_world(Real outside, const LongVec3& gradient) const {
  return outside / glm::length(glm::transpose(world_to_local_) * gradient);
}

ProfileSurfaces::Gap ProfileSurfaces::gap(const FigureEdge& edge, const LongVec2& place) {
  const LongVec2 nearest = edge.nearest(place), away = place - nearest;
  const Real distance = glm::length(away);
  // A Bézier curve may be straight.
  const LongVec2 chord = edge.end - edge.start, slope = edge.gradient(nearest);
  const LongVec2 normal =
      glm::normalize(glm::length(slope) > 0 ? slope : LongVec2(chord.y, -chord.x));
  // Beside an edge, and next to it, where rounding leaves nothing of the way to it, its normal
  // tells the way. Beyond its end it is the way to the vertex.
  constexpr Real kBeside = Real(0.999), kNext = Real(1e-14);
  const bool is_beside = std::abs(glm::dot(away, normal)) >= kBeside * distance;
  if (is_beside || distance < kNext * glm::length(place)) return {distance, normal};
  return {distance, away / distance};
}

Real ProfileSurfaces::from_revolution(const LongVec3& local) const {
  const LongVec2 place{std::hypot(local.x, local.y), local.z};
  const LongVec2 across = place.x > 0 ? LongVec2(local) / place.x : LongVec2(1, 0);
  Real least = kInfinity;
  for (const FigureEdge& edge : figure_.edges()) {
    if (edge.is_line() && edge.start.x == 0 && edge.end.x == 0) continue;  // on the axis
    const auto [outside, outwards] = gap(edge, place);
    least = std::min(least,
                     in_world(outside, {outwards.x * across.x, outwards.x * across.y, outwards.y}));
  }
  return least;
}

Real ProfileSurfaces::from_extrusion(const LongVec3& local) const {
  const auto& [profile, z_min, z_max, bottom, top] = primitive_.as<csgcore::ExtrusionShape>();
  const Real growth = (Real(top) - bottom) / (Real(z_max) - z_min);
  const Real scale = bottom + growth * (local.z - z_min);
  const Real beyond = std::max(z_min - local.z, local.z - z_max);
  const Real from_cap = in_world(std::abs(beyond), {0, 0, 1});
  if (!(scale > 0)) return from_cap;
  const LongVec2 place = LongVec2(local) / scale;
  Real beside = kInfinity;
  for (const FigureEdge& edge : figure_.edges()) {
    const auto [outside, outwards] = gap(edge, place);
    const Real rise = growth * (outside - glm::dot(outwards, place));
    beside = std::min(beside, in_world(scale * outside, {outwards.x, outwards.y, rise}));
  }
  const Real from_wall = std::max(beside, beyond > 0 ? from_cap : 0);
  const Real from_end = figure_.contains(place) ? from_cap : std::max(from_cap, beside);
  return std::min(from_wall, from_end);
}

}  // namespace oracle
