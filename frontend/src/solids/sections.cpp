#include "solids/sections.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "base/primitive_traits.hpp"
#include "csgcore/profile.hpp"
#include "csgcore/triangle_mesh.hpp"
#include "hulls/generator.hpp"
#include "hulls/orthonormal.hpp"
#include "plane/flattened_solid.hpp"
#include "solids/triangles_of.hpp"

namespace frontend {
namespace {

using csgcore::Affine;
using csgcore::Primitive;
using csgcore::Vec3;

/// What the map makes of local points at that height, seen along z.
PlaneMap plan_at(const Affine& map, double z) {
  PlaneMap plan = plane_part(map);
  plan.translation = plan_of(map.point(Vec3(0, 0, z)));
  return plan;
}

/// Returns whether the map takes horizontal planes to horizontal planes.
bool is_upright(const Affine& map) { return map.linear[0].z == 0 && map.linear[1].z == 0; }

/// A frustum or an extrusion, where the plane cuts it.
struct CutAt {
  double z;       // local
  double radius;  // there: of the frustum, or the scale of the extrusion
};

/// Returns where the plane cuts a frustum or an extrusion that stands upright, with these radii or
/// scales at its ends; nothing if it does not.
std::optional<CutAt> cut_of(const Primitive& primitive, const CutAt& lower, const CutAt& upper) {
  const double size = size_of(primitive);
  const auto world_z = [&](double z) {
    const double result = primitive.local_to_world.point(Vec3(0, 0, z)).z;
    return is_in_plane(result, size) ? 0 : result;
  };
  const double bottom = world_z(lower.z), top = world_z(upper.z);
  if (bottom == 0) return lower;
  if (top == 0) return upper;
  if ((bottom > 0) == (top > 0)) return std::nullopt;
  const double share = bottom / (bottom - top);
  return CutAt{lower.z + share * (upper.z - lower.z),
               lower.radius + share * (upper.radius - lower.radius)};
}

std::vector<Figure> disc_under(const PlaneMap& plan, double radius) {
  if (!(radius > 0)) return {};
  return {mapped(plan, Disc{Vec2(0.0), radius})};
}

/// The plane cuts a circle from the local ball, which the map takes to an ellipse.
std::vector<Figure> section_of_sphere(double radius, const Affine& map) {
  const Vec3 rise(map.linear[0].z, map.linear[1].z, map.linear[2].z);
  const double steepness = glm::length(rise);
  const double distance = -map.translation.z / steepness;
  if (!(std::abs(distance) < radius)) return {};
  const Axes axes = axes_along(rise / steepness);
  PlaneMap plan;
  plan.linear = {plan_of(map.linear * axes.x), plan_of(map.linear * axes.y)};
  plan.translation = plan_of(map.point(distance * axes.z));
  return disc_under(plan, std::sqrt((radius - distance) * (radius + distance)));
}

std::vector<Figure> section_of_frustum(const Primitive& primitive,
                                       const csgcore::FrustumShape& frustum) {
  const std::optional<CutAt> cut =
      cut_of(primitive, {frustum.z_min, frustum.r_bottom}, {frustum.z_max, frustum.r_top});
  if (!cut) return {};
  return disc_under(plan_at(primitive.local_to_world, cut->z), cut->radius);
}

std::vector<Figure> section_of_extrusion(const Primitive& primitive,
                                         const csgcore::ExtrusionShape& extrusion) {
  const std::optional<CutAt> cut = cut_of(primitive, {extrusion.z_min, extrusion.scale_bottom},
                                          {extrusion.z_max, extrusion.scale_top});
  if (!cut || !(cut->radius > 0)) return {};
  PlaneMap plan = plan_at(primitive.local_to_world, cut->z);
  plan.linear *= cut->radius;
  const csgcore::Profile& profile = *extrusion.profile;
  return {
      mapped(plan, Outline{{profile.loops().begin(), profile.loops().end()}, profile.fill_rule()})};
}

std::vector<Figure> section_of_primitive(const Primitive& primitive, bool& has_open_mesh) {
  if (!csgcore::is_valid(primitive)) return {};  // it is flat
  const csgcore::LocalSolid& solid = primitive.solid;
  if (const auto* const sphere = std::get_if<csgcore::SphereShape>(&solid)) {
    return section_of_sphere(sphere->radius, primitive.local_to_world);
  }
  if (is_upright(primitive.local_to_world)) {
    if (const auto* const frustum = std::get_if<csgcore::FrustumShape>(&solid)) {
      return section_of_frustum(primitive, *frustum);
    }
    if (const auto* const extrusion = std::get_if<csgcore::ExtrusionShape>(&solid)) {
      return section_of_extrusion(primitive, *extrusion);
    }
  }
  if (primitive.mesh() && !primitive.mesh()->is_closed()) {
    has_open_mesh = true;
    return {};
  }
  csgcore::TriangleSet triangles = triangles_of(primitive);
  put_in_plane(triangles);
  return section_of(triangles);
}

std::vector<Figure> section_of_part(const SolidPart& part, bool& has_open_mesh) {
  if (part.primitive) return section_of_primitive(*part.primitive, has_open_mesh);
  const Generators& generators = part.body.generators;
  if (!std::all_of(generators.begin(), generators.end(), is_finite)) return {};
  std::vector<Figure> result;
  for (const Primitive& piece : convex_solid(generators).pieces) {
    std::vector<Figure> figures = section_of_primitive(piece, has_open_mesh);
    std::move(figures.begin(), figures.end(), std::back_inserter(result));
  }
  return result;
}

}  // namespace

Section section_of(const SolidValue& value) {
  Section result;
  const auto add = [&](const SolidPart& part, std::vector<Figure>& figures) {
    std::ranges::move(section_of_part(part, result.has_open_mesh), std::back_inserter(figures));
  };
  result.operations = replaced<Figure>(value, add);
  return result;
}

}  // namespace frontend
