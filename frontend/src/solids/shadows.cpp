#include "solids/shadows.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "csgcore/polyhedron.hpp"
#include "csgcore/profile.hpp"
#include "csgcore/triangle_mesh.hpp"
#include "plane/flattened_solid.hpp"
#include "plane/hull.hpp"
#include "solids/sections.hpp"
#include "solids/solid_union.hpp"
#include "solids/triangles_of.hpp"

namespace frontend {
namespace {

using csgcore::Affine;
using csgcore::Primitive;
using csgcore::Vec3;

constexpr std::string_view kBecauseShadowCrosses = "the edges of its shadow cross too often";

/// The image of a disc or a ball: an ellipse with these half-axes, which may be 0.
struct Ellipse {
  Vec2 center, a, b;
};

/// Half-axes of the set of all sums x·u + y·v + z·w for x² + y² + z² ≤ 1.
Ellipse ellipse_of(const Vec2& center, const Vec2& u, const Vec2& v, const Vec2& w = Vec2(0.0)) {
  const double xx = u.x * u.x + v.x * v.x + w.x * w.x;
  const double xy = u.x * u.y + v.x * v.y + w.x * w.y;
  const double yy = u.y * u.y + v.y * v.y + w.y * w.y;
  const double angle = std::atan2(2 * xy, xx - yy) / 2;
  const Vec2 along(std::cos(angle), std::sin(angle));
  const Vec2 across(-along.y, along.x);
  const auto reach = [&](const Vec2& direction) {
    return std::hypot(glm::dot(direction, u), glm::dot(direction, v), glm::dot(direction, w));
  };
  return {center, reach(along) * along, reach(across) * across};
}

/// Adds the ellipse, or chords that no picture shows.
void add_ellipse(const Ellipse& ellipse, std::vector<Disc>& discs) {
  if (keeps_circles({{ellipse.a, ellipse.b}, ellipse.center})) {
    discs.push_back({ellipse.center, glm::length(ellipse.a)});
    return;
  }
  for (const Vec2& corner : circle_polygon({Vec2(0.0), 1}, kChordsOfCircle)) {
    discs.push_back({ellipse.center + corner.x * ellipse.a + corner.y * ellipse.b, 0});
  }
}

void add_shadow(const Generator& generator, std::vector<Disc>& discs) {
  const Vec2 center = plan_of(generator.center);
  const Ellipse disc = ellipse_of(center, plan_of(generator.disc_a), plan_of(generator.disc_b));
  const Ellipse ball = ellipse_of(center, plan_of(generator.ball[0]), plan_of(generator.ball[1]),
                                  plan_of(generator.ball[2]));
  std::vector<Disc> of_ball;
  add_ellipse(ball, of_ball);
  std::vector<Disc> of_disc;
  add_ellipse(disc, of_disc);
  for (const Disc& a : of_disc) {
    for (const Disc& b : of_ball) {
      discs.push_back({a.center + b.center - center, a.radius + b.radius});
    }
  }
}

Operations<Figure> hull_shadow(const SolidPart& part) {
  SupportSet support;
  part.add_support(support);
  std::vector<Disc> discs;
  for (const Generator& generator : support.generators) {
    if (is_finite(generator)) add_shadow(generator, discs);
  }
  if (discs.empty()) return {};
  const Figure hull = convex_hull(discs);
  if (bounds_of(hull).empty()) return {};
  return value_of(hull);
}

/// The corners of a polyhedron in the world, from the lowest on.
std::vector<Vec3> corners_from_below(const Primitive& polyhedron) {
  std::vector<Vec3> corners;
  for (const Vec3& vertex : polyhedron.polyhedron()->vertices()) {
    corners.push_back(polyhedron.local_to_world.point(vertex));
  }
  std::sort(corners.begin(), corners.end(), [](const Vec3& a, const Vec3& b) {
    return std::array{a.z, a.x, a.y} < std::array{b.z, b.x, b.y};
  });
  return corners;
}

/// The heights between which a solid has one and the same section.
struct Stretch {
  double bottom, top;
};

std::optional<Stretch> stretch_of_polyhedron(const Primitive& primitive) {
  const std::vector<Vec3> corners = corners_from_below(primitive);
  const size_t half = corners.size() / 2;
  const Stretch stretch{corners.front().z, corners.back().z};
  if (corners.size() % 2 != 0) return std::nullopt;
  for (size_t i = 0; i < half; ++i) {
    const Vec3 &lower = corners[i], &upper = corners[half + i];
    const bool is_upright =
        plan_of(lower) == plan_of(upper) && lower.z == stretch.bottom && upper.z == stretch.top;
    if (!is_upright) return std::nullopt;
  }
  return stretch;
}

/// Returns whether vertical lines stay vertical, and horizontal planes horizontal.
bool keeps_vertical(const Affine& map) {
  return map.linear[0].z == 0 && map.linear[1].z == 0 && map.linear[2].x == 0 &&
         map.linear[2].y == 0;
}

/// Returns the extrusion if the primitive is one that does not taper, else null.
const csgcore::ExtrusionShape* straight_extrusion(const Primitive& primitive) {
  const auto* const extrusion = std::get_if<csgcore::ExtrusionShape>(&primitive.solid);
  return extrusion && extrusion->scale_bottom == extrusion->scale_top ? extrusion : nullptr;
}

std::optional<Stretch> stretch_of(const SolidPart& part) {
  if (!part.primitive || !csgcore::is_valid(*part.primitive)) return std::nullopt;
  const Primitive& primitive = *part.primitive;
  if (primitive.polyhedron()) return stretch_of_polyhedron(primitive);
  if (!keeps_vertical(primitive.local_to_world)) return std::nullopt;
  const auto between = [&](double z_min, double z_max) {
    const double a = primitive.local_to_world.point(Vec3(0, 0, z_min)).z;
    const double b = primitive.local_to_world.point(Vec3(0, 0, z_max)).z;
    return Stretch{std::min(a, b), std::max(a, b)};
  };
  if (const auto* const frustum = std::get_if<csgcore::FrustumShape>(&primitive.solid)) {
    if (frustum->r_bottom == frustum->r_top) return between(frustum->z_min, frustum->z_max);
  }
  if (const auto* const extrusion = straight_extrusion(primitive)) {
    return between(extrusion->z_min, extrusion->z_max);
  }
  return std::nullopt;
}

/// The rings that an upright solid of revolution covers: each loop of its profile covers one.
Operations<Figure> shadow_of_revolution(const csgcore::Profile& profile, const PlaneMap& plan) {
  std::vector<Figure> rings;
  for (const csgcore::ProfileLoop& loop : profile.loops()) {
    const Rectangle bounds = bounds_of(Figure(Outline{{loop}, csgcore::FillRule::kEvenOdd}));
    if (bounds.empty() || !(bounds.max.x > 0)) continue;
    Outline ring = outline_of(Disc{Vec2(0.0), bounds.max.x});
    if (bounds.min.x > 0) {
      Outline hole = outline_of(Disc{Vec2(0.0), bounds.min.x});
      ring.loops.push_back(std::move(hole.loops.front()));
    }
    rings.push_back(mapped(plan, std::move(ring)));
  }
  return union_of(std::move(rings));
}

/// More sections take longer than the mesh of the outcome.
constexpr size_t kMostShadowSections = 1 << 14;

/// The shadow of what stands upright: between the heights of its parts it has few sections.
std::optional<Operations<Figure>> shadow_of_upright(const SolidValue& value) {
  std::vector<double> heights;
  for (const SolidPart& part : value.parts) {
    const std::optional<Stretch> stretch = stretch_of(part);
    if (!stretch) return std::nullopt;
    heights.insert(heights.end(), {stretch->bottom, stretch->top});
  }
  std::sort(heights.begin(), heights.end());
  heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
  if (heights.size() * value.parts.size() > kMostShadowSections) return std::nullopt;
  std::vector<Operations<Figure>> sections;
  for (size_t i = 1; i < heights.size(); ++i) {
    SolidValue lowered = value;
    Affine down;
    down.translation.z = -(heights[i - 1] + heights[i]) / 2;
    for (SolidPart& part : lowered.parts) part.map(down);
    sections.push_back(section_of(lowered).operations);
  }
  return combined(csgcore::Op::kUnion, std::move(sections));
}

}  // namespace

void Shadows::fail(std::string_view why) {
  if (failure_.empty()) failure_ = why;
}

Operations<Figure> Shadows::of_part(const SolidPart& part) {
  if (part.is_convex()) return hull_shadow(part);
  const Primitive& primitive = *part.primitive;
  const Affine& map = primitive.local_to_world;
  if (keeps_vertical(map)) {
    PlaneMap plan = plane_part(map);
    if (const auto* const revolution = std::get_if<csgcore::RevolutionShape>(&primitive.solid)) {
      return shadow_of_revolution(*revolution->profile, plan);
    }
    if (const auto* const extrusion = straight_extrusion(primitive)) {
      const csgcore::Profile& profile = *extrusion->profile;
      plan.linear *= extrusion->scale_bottom;
      return value_of(mapped(
          plan, Outline{{profile.loops().begin(), profile.loops().end()}, profile.fill_rule()}));
    }
  }
  const bool is_open = primitive.mesh() && !primitive.mesh()->is_closed();
  std::optional<Figure> shadow =
      shadow_of(triangles_of(primitive), is_open ? Boundary::kOpen : Boundary::kClosed);
  if (!shadow) {
    fail(kBecauseShadowCrosses);
    return {};
  }
  if (bounds_of(*shadow).empty()) return {};
  return value_of(std::move(*shadow));
}

Operations<Figure> Shadows::of_operation(const SolidValue& value) {
  if (value.parts.size() == 1) return of_part(value.parts.front());
  if (std::optional<Operations<Figure>> shadow = shadow_of_upright(value))
    return std::move(*shadow);
  SolidUnion outcome(pool_);
  std::vector<Operations<Figure>> shadows;
  for (const SolidPart& part : outcome.parts_of(value)) shadows.push_back(of_part(part));
  if (!outcome.failure().empty()) fail(outcome.failure());
  return combined(csgcore::Op::kUnion, std::move(shadows));
}

std::optional<Operations<Figure>> Shadows::of(const SolidValue& value) {
  if (value.is_empty()) return Operations<Figure>{};
  std::vector<Operations<Figure>> shadows;
  for (const SolidValue& operand : operands_of_union(value)) {
    shadows.push_back(of_operation(operand));
    if (!failure_.empty()) return std::nullopt;
  }
  return combined(csgcore::Op::kUnion, std::move(shadows));
}

}  // namespace frontend
