#include "exact_primitive.hpp"

#include <algorithm>
#include <cmath>

namespace oracle {
namespace {

using csgcore::Affine;
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
std::optional<Part> within_slab(const Target<Number>& target, const LocalRay<Number>& ray) {
  const int direction = sign_of(ray.d[2]);
  if (direction > 0) return Part{Surface::kBottom, Surface::kTop};
  if (direction < 0) return Part{Surface::kTop, Surface::kBottom};
  const bool inside = sign_of(Number(target.half_height - ray.o[2])) >= 0 &&
                      sign_of(Number(target.half_height + ray.o[2])) >= 0;
  return inside ? std::optional(Part{}) : std::nullopt;
}

/// Of the cone's two nappes that with ρ ≥ 0.
template <class Number>
std::optional<Part> within_wall(const Target<Number>& target, const LocalRay<Number>& ray) {
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

}  // namespace

Target<Exact> make_target(const Primitive& primitive, const Vec3& pivot, double unit) {
  const Affine& map = primitive.local_to_world;
  std::array<Vector<Exact>, 3> columns;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) columns[i][j] = Exact(unit) * Exact(map.linear[i][j]);
  }
  Target<Exact> target;
  target.is_frustum = primitive.shape == Shape::kFrustum;
  target.to_local = {cross(columns[1], columns[2]), cross(columns[2], columns[0]),
                     cross(columns[0], columns[1])};
  const Exact determinant = dot(columns[0], target.to_local[0]);
  const Exact scale = Exact(determinant.sign()) * scale_to_one(target.to_local);
  for (Vector<Exact>& row : target.to_local) {
    for (Exact& entry : row) entry = scale * entry;
  }
  const Exact magnification = scale * determinant;
  Exact local_middle = 0;
  if (target.is_frustum) {
    const Exact half(0.5), bottom(primitive.z_min), top(primitive.z_max);
    const Exact r_bottom(primitive.r_bottom), r_top(primitive.r_top);
    const Exact wall_scale = power_of_two(-std::ilogb(primitive.z_max - primitive.z_min));
    local_middle = half * (bottom + top);
    target.growth = wall_scale * (r_top - r_bottom);
    target.squared_height = CGAL::square(Exact(wall_scale * (top - bottom)));
    target.half_height = magnification * half * (top - bottom);
    target.radius = wall_scale * target.half_height * (r_bottom + r_top);
  } else {
    target.radius = magnification * Exact(primitive.r_bottom);
  }
  for (int i = 0; i < 3; ++i) {
    target.from_middle[i] =
        Exact(unit) * (Exact(pivot[i]) - Exact(map.translation[i])) - columns[2][i] * local_middle;
  }
  return target;
}

Target<Interval> enclose(const Target<Exact>& target) {
  Target<Interval> result;
  result.is_frustum = target.is_frustum;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) result.to_local[i][j] = enclose(target.to_local[i][j]);
    result.from_middle[i] = enclose(target.from_middle[i]);
  }
  result.radius = enclose(target.radius);
  result.growth = enclose(target.growth);
  result.squared_height = enclose(target.squared_height);
  result.half_height = enclose(target.half_height);
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
  local.wall = target.is_frustum ? frustum_wall(target, local.o, local.d)
                                 : sphere_wall(target, local.o, local.d);
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
  double od = o[0] * d[0] + o[1] * d[1], dd = d[0] * d[0] + d[1] * d[1];
  if (!target.is_frustum) {
    od += o[2] * d[2];
    dd += d[2] * d[2];
  }
  // Of a frustum, next to the axis, but within the slab.
  double base = dd > 0 ? -od / dd : 0;
  if (target.is_frustum && d[2] != 0) {
    const double half = middle(target.half_height) / std::abs(d[2]), center = -o[2] / d[2];
    base = std::clamp(base, center - half, center + half);
  }
  return std::isfinite(base) ? base : 0;
}

template <class Number>
std::optional<Ends> ends_of(const Target<Number>& target, const LocalRay<Number>& ray) {
  const std::optional<Part> wall = within_wall(target, ray);
  if (!wall) return {};
  std::optional<Part> part = wall;
  if (target.is_frustum) {
    part = within_slab(target, ray);
    if (!part) return {};
    const auto beyond = [&](Surface surface, bool enters) {
      return compare(crossing_of(target, ray, Surface::kWall, enters),
                     crossing_of(target, ray, surface, enters));
    };
    if (wall->begin && (!part->begin || beyond(*part->begin, true) > 0)) part->begin = wall->begin;
    if (wall->end && (!part->end || beyond(*part->end, false) < 0)) part->end = wall->end;
  }
  const Ends ends{*part->begin, *part->end};
  // Two crossings of the wall lie apart, and so do the caps.
  if ((ends.begin == Surface::kWall) == (ends.end == Surface::kWall)) return ends;
  const bool has_length = compare(crossing_of(target, ray, ends.begin, true),
                                  crossing_of(target, ray, ends.end, false)) < 0;
  return has_length ? std::optional(ends) : std::nullopt;
}

template std::optional<Ends> ends_of(const Target<Exact>&, const LocalRay<Exact>&);
template std::optional<Ends> ends_of(const Target<Interval>&, const LocalRay<Interval>&);

Vector<Interval> normal_at(const Target<Interval>& target, const LocalRay<Interval>& ray,
                           const Interval& t, Surface surface) {
  Vector<Interval> local{0, 0, surface == Surface::kTop ? 1 : -1};
  if (surface == Surface::kWall) {
    // Half the gradient.
    for (int i = 0; i < 3; ++i) local[i] = ray.o[i] + t * ray.d[i];
    if (target.is_frustum) {
      const Interval radius = radius_at(target, local[2]);
      local[0] *= target.squared_height;
      local[1] *= target.squared_height;
      local[2] = -target.growth * radius;
    }
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
  const Interval across =
      surface == Surface::kWall ? CGAL::sqrt(ray.wall.discriminant) : CGAL::abs(ray.d[2]);
  return across / length(normal_at(target, ray, t, surface));
}

}  // namespace oracle
