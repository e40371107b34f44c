#include "exact_primitive.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "csgcore/polyhedron.hpp"

namespace oracle {
namespace {

using csgcore::Affine;
using csgcore::HalfSpace;
using csgcore::Polyhedron;
using csgcore::Primitive;
using csgcore::Shape;
using csgcore::Vec3;

double middle(const Interval& interval) { return 0.5 * (interval.inf() + interval.sup()); }

template <class Number>
Vector<Number> cross(const Vector<Number>& a, const Vector<Number>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Across the axis.
template <class Number>
Number dot_across(const Vector<Number>& a, const Vector<Number>& b) {
  return a[0] * b[0] + a[1] * b[1];
}

/// ρ(z).
template <class Number>
Number radius_at(const Target<Number>& target, const Number& z) {
  return target.radius + target.growth * z;
}

template <class Number>
Quadratic<Number> sphere_wall(const Target<Number>& target, const Vector<Number>& o,
                              const Vector<Number>& d) {
  Quadratic<Number> wall;
  const Number radius2 = CGAL::square(target.radius);
  wall.a = dot(d, d);
  wall.b = dot(o, d);
  wall.c = dot(o, o) - radius2;
  // By Lagrange's identity, without the squares of o, which cancel.
  const Vector<Number> moment = cross(o, d);
  wall.discriminant = radius2 * wall.a - dot(moment, moment);
  return wall;
}

template <class Number>
Quadratic<Number> frustum_wall(const Target<Number>& target, const Vector<Number>& o,
                               const Vector<Number>& d) {
  Quadratic<Number> wall;
  const Number& w = target.squared_height;
  const Number radius = radius_at(target, o[2]), growth = target.growth * d[2];
  wall.a = w * dot_across(d, d) - CGAL::square(growth);
  wall.b = w * dot_across(o, d) - radius * growth;
  wall.c = w * dot_across(o, o) - CGAL::square(radius);
  // Likewise: w(|ρd − go|² − w(o × d)²) across the axis, g the growth of ρ along the ray.
  const Number x = radius * d[0] - growth * o[0], y = radius * d[1] - growth * o[1];
  const Number moment = o[0] * d[1] - o[1] * d[0];
  wall.discriminant = w * (CGAL::square(x) + CGAL::square(y) - w * CGAL::square(moment));
  return wall;
}

Exact power_of_two(int exponent) { return Exact(std::ldexp(1.0, exponent)); }

/// The power of two that brings the largest entry to between 1 and 2.
Exact scale_to_one(const std::array<Vector<Exact>, 3>& matrix) {
  double largest = 0;
  for (const Vector<Exact>& row : matrix) {
    for (const Exact& entry : row) largest = std::max(largest, std::abs(CGAL::to_double(entry)));
  }
  return power_of_two(-std::ilogb(largest));
}

/// What of a line lies in a convex set, as far as is known: without an end it goes on.
struct Part {
  std::optional<Surface> begin, end;
};

template <class Number>
std::optional<Part> within_planes(const Target<Number>& target, const LocalRay<Number>& ray,
                                  std::span<const uint32_t> planes) {
  Part part;
  for (const uint32_t i : planes) {
    const Plane<Number>& plane = target.planes[i];
    const int direction = sign_of(dot(plane.normal, ray.d));
    if (direction == 0) {
      if (sign_of(Number(plane.limit - dot(plane.normal, ray.o))) < 0) return {};
      continue;
    }
    const bool enters = direction < 0;
    std::optional<Surface>& bound = enters ? part.begin : part.end;
    const auto crossing = [&](Surface surface) {
      return crossing_of(target, ray, surface, enters);
    };
    // Of planes that are met at once the first stays.
    if (!bound || direction * compare(crossing(Surface(i)), crossing(*bound)) < 0) {
      bound = Surface(i);
    }
  }
  return part;
}

/// Of the cone's two nappes that with ρ ≥ 0.
template <class Number>
std::optional<Part> within_wall(const Target<Number>& target, const LocalRay<Number>& ray) {
  if (target.shape == Shape::kPolyhedron) return Part{};
  const Quadratic<Number>& wall = ray.wall;
  const int a = sign_of(wall.a);
  if (a > 0) {
    const bool meets = sign_of(wall.discriminant) > 0;
    return meets ? std::optional(Part{Surface::kWall, Surface::kWall}) : std::nullopt;
  }
  if (a < 0) {
    // One half-line in each nappe: in ours the ray enters if ρ grows along it.
    const bool enters = sign_of(target.growth) * sign_of(ray.d[2]) > 0;
    return enters ? Part{Surface::kWall, {}} : Part{{}, Surface::kWall};
  }
  // Along a generatrix. A half-line in the other nappe does not reach the slab.
  const int b = sign_of(wall.b);
  if (b != 0) return b < 0 ? Part{Surface::kWall, {}} : Part{{}, Surface::kWall};
  return sign_of(wall.c) <= 0 ? std::optional(Part{}) : std::nullopt;
}

Plane<Exact> scaled(const HalfSpace& half_space, const Vector<Exact>& middle,
                    const Exact& magnification) {
  const Vec3 size = glm::abs(half_space.normal);
  const Exact scale = power_of_two(-std::ilogb(std::max({size.x, size.y, size.z})));
  Plane<Exact> plane;
  for (int i = 0; i < 3; ++i) plane.normal[i] = Exact(half_space.normal[i]);
  plane.limit = scale * magnification * (Exact(half_space.offset) - dot(plane.normal, middle));
  for (Exact& coordinate : plane.normal) coordinate = scale * coordinate;
  return plane;
}

/// A frustum's wall and planes; λ is `magnification`.
void add_frustum(const Primitive& primitive, const Exact& magnification, Target<Exact>& target) {
  const Exact half(0.5), bottom(primitive.z_min), top(primitive.z_max);
  const Exact r_bottom(primitive.r_bottom), r_top(primitive.r_top);
  const Exact wall_scale = power_of_two(-std::ilogb(primitive.z_max - primitive.z_min));
  const Exact half_height = magnification * half * (top - bottom);
  target.growth = wall_scale * (r_top - r_bottom);
  target.squared_height = CGAL::square(Exact(wall_scale * (top - bottom)));
  target.radius = wall_scale * half_height * (r_bottom + r_top);
  target.planes = {{{0, 0, -1}, half_height}, {{0, 0, 1}, half_height}};
  target.weight = {1, 1, 0};
}

csgcore::Box vertex_box(const Polyhedron& polyhedron) {
  csgcore::Box box;
  for (const Vec3& vertex : polyhedron.vertices()) box.merge(vertex);
  return box;
}

void add_polyhedron(const Polyhedron& polyhedron, const Vector<Exact>& middle,
                    const Exact& magnification, Target<Exact>& target) {
  for (const HalfSpace& half_space : polyhedron.half_spaces()) {
    target.planes.push_back(scaled(half_space, middle, magnification));
  }
  const Vec3 size = vertex_box(polyhedron).size();
  const Vec3 slender = std::min({size.x, size.y, size.z}) / size;
  target.weight = slender * slender;
}

/// In local space: any point well within the solid will do.
Vector<Exact> middle_of(const Primitive& primitive) {
  switch (primitive.shape) {
    case Shape::kSphere:
      break;
    case Shape::kFrustum:
      return {0, 0, Exact(0.5) * (Exact(primitive.z_min) + Exact(primitive.z_max))};
    case Shape::kPolyhedron:
      const Vec3 center = vertex_box(*primitive.polyhedron).center();
      return {center.x, center.y, center.z};
  }
  return {0, 0, 0};
}

}  // namespace

Target<Exact> make_target(const Primitive& primitive, const Vec3& pivot, double unit) {
  const Affine& map = primitive.local_to_world;
  std::array<Vector<Exact>, 3> columns;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) columns[i][j] = Exact(unit) * Exact(map.linear[i][j]);
  }
  Target<Exact> target;
  target.shape = primitive.shape;
  target.to_local = {cross(columns[1], columns[2]), cross(columns[2], columns[0]),
                     cross(columns[0], columns[1])};
  const Exact determinant = dot(columns[0], target.to_local[0]);
  const Exact scale = Exact(determinant.sign()) * scale_to_one(target.to_local);
  for (Vector<Exact>& row : target.to_local) {
    for (Exact& entry : row) entry = scale * entry;
  }
  const Exact magnification = scale * determinant;
  const Vector<Exact> middle = middle_of(primitive);
  switch (primitive.shape) {
    case Shape::kSphere:
      target.radius = magnification * Exact(primitive.r_bottom);
      target.weight = Vec3(1.0);
      break;
    case Shape::kFrustum:
      add_frustum(primitive, magnification, target);
      break;
    case Shape::kPolyhedron:
      add_polyhedron(*primitive.polyhedron, middle, magnification, target);
      break;
  }
  for (int i = 0; i < 3; ++i) {
    target.from_middle[i] = Exact(unit) * (Exact(pivot[i]) - Exact(map.translation[i]));
    for (int j = 0; j < 3; ++j) target.from_middle[i] -= columns[j][i] * middle[j];
  }
  return target;
}

Target<Interval> enclose(const Target<Exact>& target) {
  Target<Interval> result;
  result.shape = target.shape;
  result.weight = target.weight;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) result.to_local[i][j] = enclose(target.to_local[i][j]);
    result.from_middle[i] = enclose(target.from_middle[i]);
  }
  result.radius = enclose(target.radius);
  result.growth = enclose(target.growth);
  result.squared_height = enclose(target.squared_height);
  for (const Plane<Exact>& plane : target.planes) {
    result.planes.push_back(
        {{enclose(plane.normal[0]), enclose(plane.normal[1]), enclose(plane.normal[2])},
         enclose(plane.limit)});
  }
  return result;
}

template <class Number>
LocalRay<Number> localize(const Target<Number>& target, const NearRay<Number>& ray, double base) {
  Vector<Number> offset;
  for (int i = 0; i < 3; ++i) offset[i] = ray.origin[i] + target.from_middle[i];
  LocalRay<Number> local;
  for (int i = 0; i < 3; ++i) {
    local.d[i] = dot(target.to_local[i], ray.direction);
    local.o[i] = dot(target.to_local[i], offset) + Number(base) * local.d[i];
  }
  if (target.shape == Shape::kSphere) local.wall = sphere_wall(target, local.o, local.d);
  if (target.shape == Shape::kFrustum) local.wall = frustum_wall(target, local.o, local.d);
  return local;
}

template LocalRay<Exact> localize(const Target<Exact>&, const NearRay<Exact>&, double);
template LocalRay<Interval> localize(const Target<Interval>&, const NearRay<Interval>&, double);

LocalRay<Interval> enclose(const LocalRay<Exact>& ray) {
  LocalRay<Interval> result;
  for (int i = 0; i < 3; ++i) {
    result.o[i] = enclose(ray.o[i]);
    result.d[i] = enclose(ray.d[i]);
  }
  result.wall = {enclose(ray.wall.a), enclose(ray.wall.b), enclose(ray.wall.c),
                 enclose(ray.wall.discriminant)};
  return result;
}

Interval enclose_crossing(const Target<Exact>& target, const LocalRay<Exact>& exact,
                          const LocalRay<Interval>& enclosed, Surface surface, bool enters) {
  if (surface == Surface::kWall) return root_of(enclosed.wall, enters);
  const ExactRoot t = crossing_of(target, exact, surface, enters);
  return enclose(t.p) / enclose(t.r);
}

double base_of(const Target<Interval>& target, const NearRay<Interval>& ray) {
  double o[3], d[3];
  for (int i = 0; i < 3; ++i) {
    o[i] = d[i] = 0;
    for (int j = 0; j < 3; ++j) {
      const double entry = middle(target.to_local[i][j]);
      o[i] += entry * (middle(ray.origin[j]) + middle(target.from_middle[j]));
      d[i] += entry * middle(ray.direction[j]);
    }
  }
  double od = 0, dd = 0;
  for (int i = 0; i < 3; ++i) {
    od += target.weight[i] * o[i] * d[i];
    dd += target.weight[i] * d[i] * d[i];
  }
  // Of a frustum, next to the axis, but within the slab.
  double base = dd > 0 ? -od / dd : 0;
  if (target.shape == Shape::kFrustum && d[2] != 0) {
    const double half = middle(target.planes[0].limit) / std::abs(d[2]), center = -o[2] / d[2];
    base = std::clamp(base, center - half, center + half);
  }
  return std::isfinite(base) ? base : 0;
}

template <class Number>
std::optional<Ends> ends_of(const Target<Number>& target, const LocalRay<Number>& ray,
                            std::span<const uint32_t> planes) {
  const std::optional<Part> wall = within_wall(target, ray);
  if (!wall) return {};
  std::optional<Part> part = within_planes(target, ray, planes);
  if (!part) return {};
  const auto beyond = [&](Surface surface, bool enters) {
    return compare(crossing_of(target, ray, Surface::kWall, enters),
                   crossing_of(target, ray, surface, enters));
  };
  if (wall->begin && (!part->begin || beyond(*part->begin, true) > 0)) part->begin = wall->begin;
  if (wall->end && (!part->end || beyond(*part->end, false) < 0)) part->end = wall->end;
  const Ends ends{*part->begin, *part->end};
  // Two crossings of the wall lie apart.
  if (ends.begin == ends.end) return ends;
  const bool has_length = compare(crossing_of(target, ray, ends.begin, true),
                                  crossing_of(target, ray, ends.end, false)) < 0;
  return has_length ? std::optional(ends) : std::nullopt;
}

template std::optional<Ends> ends_of(const Target<Exact>&, const LocalRay<Exact>&,
                                     std::span<const uint32_t>);
template std::optional<Ends> ends_of(const Target<Interval>&, const LocalRay<Interval>&,
                                     std::span<const uint32_t>);

Vector<Interval> normal_at(const Target<Interval>& target, const LocalRay<Interval>& ray,
                           const Interval& t, Surface surface) {
  Vector<Interval> local;
  if (surface == Surface::kWall) {
    // Half the gradient.
    for (int i = 0; i < 3; ++i) local[i] = ray.o[i] + t * ray.d[i];
    if (target.shape == Shape::kFrustum) {
      const Interval radius = radius_at(target, local[2]);
      local[0] *= target.squared_height;
      local[1] *= target.squared_height;
      local[2] = -target.growth * radius;
    }
  } else {
    local = target.planes[uint32_t(surface)].normal;
  }
  Vector<Interval> world;
  for (int i = 0; i < 3; ++i) {
    world[i] = target.to_local[0][i] * local[0] + target.to_local[1][i] * local[1] +
               target.to_local[2][i] * local[2];
  }
  return world;
}

Interval steepness_at(const Target<Interval>& target, const LocalRay<Interval>& ray,
                      const Interval& t, Surface surface) {
  // Half the gradient times the direction is half the derivative along the ray, at a root ±√D.
  const Interval across = surface == Surface::kWall
                              ? CGAL::sqrt(ray.wall.discriminant)
                              : CGAL::abs(dot(target.planes[uint32_t(surface)].normal, ray.d));
  return across / length(normal_at(target, ray, t, surface));
}

}  // namespace oracle
