#include "solids/figure_solids.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "language/degrees.hpp"

namespace frontend {
namespace {

using csgcore::Affine;
using csgcore::HalfSpace;
using csgcore::Mat3;
using csgcore::Primitive;
using csgcore::Vec3;

/// A polygon with more corners is a profile: half-spaces take a ray past many of them.
constexpr size_t kMostPrismSides = 256;

/// The map x ↦ origin + size · x, by coordinate.
Affine stretched(const Vec3& origin, const Vec3& size) {
  Affine result;
  for (int axis = 0; axis < 3; ++axis) result.linear[axis][axis] = size[axis];
  result.translation = origin;
  return result;
}

/// The solid over the polygon from z = 0 to 1, where it is scaled.
csgcore::Polyhedron prism_of(const Polygon& corners, double top_scale) {
  std::vector<HalfSpace> half_spaces{{Vec3(0, 0, -1), 0}};
  if (top_scale > 0) half_spaces.push_back({Vec3(0, 0, 1), 1});
  std::vector<Vec3> vertices;
  for (size_t i = 0; i < corners.size(); ++i) {
    const Vec2& a = corners[i];
    const Vec2& b = corners[(i + 1) % corners.size()];
    const Vec2 normal(b.y - a.y, a.x - b.x);
    const double offset = std::max(glm::dot(normal, a), glm::dot(normal, b));
    half_spaces.push_back({Vec3(normal, offset * (1 - top_scale)), offset});
    vertices.emplace_back(a, 0.0);
    if (top_scale > 0) vertices.emplace_back(top_scale * a, 1.0);
  }
  if (top_scale == 0) vertices.emplace_back(0.0, 0.0, 1.0);
  return csgcore::Polyhedron(std::move(half_spaces), std::move(vertices));
}

/// The four corners of a rectangle with two sides on the lines y = a and y = b, or the three of a
/// triangle with one side there, which the axis x = 0 bounds: what revolves to a frustum.
struct FrustumSection {
  double z_min, z_max, r_bottom, r_top;
};

std::optional<FrustumSection> frustum_section(const Polygon& corners) {
  if (corners.size() != 3 && corners.size() != 4) return std::nullopt;
  std::vector<double> on_axis;
  for (const Vec2& corner : corners) {
    if (corner.x == 0) on_axis.push_back(corner.y);
  }
  if (on_axis.size() != 2) return std::nullopt;
  FrustumSection section{std::min(on_axis[0], on_axis[1]), std::max(on_axis[0], on_axis[1]), 0, 0};
  for (const Vec2& corner : corners) {
    if (corner.x == 0) continue;
    if (corner.y == section.z_min) {
      section.r_bottom = corner.x;
    } else if (corner.y == section.z_max) {
      section.r_top = corner.x;
    } else {
      return std::nullopt;
    }
  }
  const bool has_all = corners.size() == 3 || (section.r_bottom > 0 && section.r_top > 0);
  return has_all ? std::optional(section) : std::nullopt;
}

/// The disc of which the outline is the half right of the axis x = 0, on which its centre lies.
std::optional<Disc> half_disc(const Figure& figure) {
  const Disc* disc = std::get_if<Disc>(&figure);
  if (disc == nullptr || disc->center.x != 0) return std::nullopt;
  return *disc;
}

void add_numbers(const Vec2& v, std::vector<double>& key) { key.insert(key.end(), {v.x, v.y}); }

}  // namespace

Primitive FigureSolids::prism(const Polygon& corners, const Layers& layers) {
  // By a power of two to unit size, so that no coordinate is rounded.
  double largest = 0;
  for (const Vec2& corner : corners) {
    largest = std::max({largest, std::abs(corner.x), std::abs(corner.y)});
  }
  const int exponent = std::ilogb(largest);
  Polygon scaled;
  std::vector<double> key{layers.top_scale};
  for (const Vec2& corner : corners) {
    scaled.emplace_back(std::ldexp(corner.x, -exponent), std::ldexp(corner.y, -exponent));
    add_numbers(scaled.back(), key);
  }
  Polyhedron& polyhedron = prisms_[std::move(key)];
  if (!polyhedron) {
    polyhedron = std::make_shared<csgcore::Polyhedron>(prism_of(scaled, layers.top_scale));
  }
  const double size = std::ldexp(1.0, exponent);
  return csgcore::make_polyhedron(
      polyhedron,
      stretched(Vec3(0, 0, layers.z_min), Vec3(size, size, layers.z_max - layers.z_min)));
}

FigureSolids::Profile FigureSolids::profile(const Outline& outline) {
  std::vector<double> key{static_cast<double>(outline.fill_rule)};
  for (const csgcore::ProfileLoop& loop : outline.loops) {
    key.push_back(static_cast<double>(loop.size()));
    for (const csgcore::ProfileEdge& edge : loop) {
      key.push_back(static_cast<double>(edge.kind));
      key.push_back(edge.is_counterclockwise);
      add_numbers(edge.end, key);
      add_numbers(edge.control, key);
    }
  }
  Profile& shared = profiles_[std::move(key)];
  if (!shared) shared = std::make_shared<csgcore::Profile>(outline.loops, outline.fill_rule);
  return shared;
}

std::optional<Primitive> FigureSolids::extruded(const Figure& figure, const Layers& layers,
                                                const Profile& made) {
  if (const Disc* disc = std::get_if<Disc>(&figure)) {
    if (!(disc->radius > 0)) return std::nullopt;
    Primitive frustum = csgcore::make_frustum(layers.z_min, layers.z_max, disc->radius,
                                              disc->radius * layers.top_scale);
    // The axis runs from the centre to the scaled centre.
    const double slope = (layers.top_scale - 1) / (layers.z_max - layers.z_min);
    const Vec2 lean = slope * disc->center;
    frustum.local_to_world.linear[2] = Vec3(lean, 1);
    frustum.local_to_world.translation = Vec3(disc->center - layers.z_min * lean, 0);
    return frustum;
  }
  if (bounds_of(figure).empty()) return std::nullopt;
  const std::optional<Polygon> corners = convex_corners(figure);
  if (corners && corners->size() <= kMostPrismSides) return prism(*corners, layers);
  return csgcore::make_extrusion(made ? made : profile(std::get<Outline>(figure)), layers.z_min,
                                 layers.z_max, 1, layers.top_scale);
}

std::optional<Primitive> FigureSolids::revolved(const Figure& figure) {
  if (const std::optional<Disc> ball = half_disc(figure)) {
    if (!(ball->radius > 0)) return std::nullopt;
    return csgcore::make_sphere(ball->radius, stretched(Vec3(0, 0, ball->center.y), Vec3(1.0)));
  }
  Outline outline = right_half(figure);
  const Rectangle bounds = bounds_of(outline);
  if (bounds.empty() || bounds.max.x <= 0) return std::nullopt;
  if (const std::optional<Polygon> corners = convex_corners(outline)) {
    if (const std::optional<FrustumSection> section = frustum_section(*corners)) {
      return csgcore::make_frustum(section->z_min, section->z_max, section->r_bottom,
                                   section->r_top);
    }
  }
  return csgcore::make_revolution(profile(outline));
}

Primitive FigureSolids::wedge(double angle, double radius, double z_min, double z_max) {
  // A fan about the axis. Its outer sides, of 45° or less, stay outside of the radius.
  constexpr double kWidestSide = 45;
  const int sides = static_cast<int>(std::ceil(angle / kWidestSide));
  constexpr double kMargin = 1.5;
  const double reach = kMargin * radius / language::cosine_of_degrees(kWidestSide / 2);
  Polygon corners{Vec2(0.0)};
  for (int i = 0; i <= sides; ++i) {
    const double azimuth = angle * i / sides;
    corners.push_back(
        reach * Vec2(language::cosine_of_degrees(azimuth), language::sine_of_degrees(azimuth)));
  }
  // The axis is no corner of half a turn.
  if (angle == 180) corners.erase(corners.begin());
  const double margin = (kMargin - 1) * std::max(z_max - z_min, radius);
  return prism(corners, {z_min - margin, z_max + margin, 1});
}

}  // namespace frontend
