#include "exact_primitive.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "exact_mesh.hpp"
#include "exact_profile.hpp"
#include "exact_twin.hpp"

namespace oracle {
namespace {

using csgcore::Affine;
using csgcore::Primitive;
using csgcore::Vec3;

/// Returns the power of two that scales the largest entry to [1, 2).
Exact scale_to_one(const std::array<Vector<Exact>, 3>& matrix) {
  double largest = 0;
  for (const Vector<Exact>& row : matrix) {
    for (const Exact& entry : row) largest = std::max(largest, std::abs(CGAL::to_double(entry)));
  }
  return power_of_two(-std::ilogb(largest));
}

/// The part of a line in a convex set. It is infinite on a side without a surface.
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
    // If planes are met at the same point, the first one stays.
    if (!bound || direction * compare(crossing(Surface(i)), crossing(*bound)) < 0) {
      bound = Surface(i);
    }
  }
  return part;
}

/// Returns the part of the ray within the wall; of a cone, within the nappe with ρ ≥ 0.
template <class Number>
std::optional<Part> within_wall(const Target<Number>& target, const LocalRay<Number>& ray) {
  if (!target.has_wall) return Part{};
  const Quadratic<Number>& wall = ray.walls.enter;
  const int a = sign_of(wall.a);
  if (a > 0) {
    const bool meets = sign_of(wall.discriminant) > 0 && sign_of(ray.walls.leave.discriminant) > 0;
    return meets ? std::optional(Part{Surface::kWall, Surface::kWall}) : std::nullopt;
  }
  if (a < 0) {
    // The ray has one half-line in each nappe. It enters the one with ρ ≥ 0 if ρ grows along the
    // ray.
    const bool enters = sign_of(target.growth) * sign_of(ray.d[2]) > 0;
    return enters ? Part{Surface::kWall, {}} : Part{{}, Surface::kWall};
  }
  // The ray is parallel to a generatrix. A half-line in the other nappe does not reach the slab.
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
  target.twin = &twin_of(primitive.shape());
  target.to_local = {cross(columns[1], columns[2]), cross(columns[2], columns[0]),
                     cross(columns[0], columns[1])};
  const Exact determinant = dot(columns[0], target.to_local[0]);
  const Exact scale = Exact(determinant.sign()) * scale_to_one(target.to_local);
  for (Vector<Exact>& row : target.to_local) {
    for (Exact& entry : row) entry = scale * entry;
  }
  const Exact magnification = scale * determinant;
  const Vector<Exact> middle = target.twin->middle(primitive);
  target.twin->add_surfaces(primitive, magnification, target);
  for (int i = 0; i < 3; ++i) {
    target.from_middle[i] = Exact(unit) * (Exact(pivot[i]) - Exact(map.translation[i]));
    for (int j = 0; j < 3; ++j) target.from_middle[i] -= columns[j][i] * middle[j];
  }
  return target;
}

namespace {

Plane<Interval> enclose(const Plane<Exact>& plane) {
  return {{oracle::enclose(plane.normal[0]), oracle::enclose(plane.normal[1]),
           oracle::enclose(plane.normal[2])},
          oracle::enclose(plane.limit)};
}

}  // namespace

Target<Interval> enclose(const Target<Exact>& target) {
  Target<Interval> result;
  result.twin = target.twin;
  result.has_wall = target.has_wall;
  result.weight = target.weight;
  result.mesh = target.mesh;
  result.profile = target.profile;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) result.to_local[i][j] = enclose(target.to_local[i][j]);
    result.from_middle[i] = enclose(target.from_middle[i]);
  }
  result.radius = enclose(target.radius);
  result.growth = enclose(target.growth);
  result.squared_height = enclose(target.squared_height);
  for (const Plane<Exact>& plane : target.planes) result.planes.push_back(enclose(plane));
  return result;
}

template <>
Plane<Exact> triangle_plane(const ExactMesh& mesh, Surface triangle) {
  return mesh.plane(uint32_t(triangle));
}

template <>
Plane<Interval> triangle_plane(const ExactMesh& mesh, Surface triangle) {
  return enclose(mesh.plane(uint32_t(triangle)));
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
  if (target.has_wall) local.walls = target.twin->walls(target, local.o, local.d);
  return local;
}

template LocalRay<Exact> localize(const Target<Exact>&, const NearRay<Exact>&, double);
template LocalRay<Interval> localize(const Target<Interval>&, const NearRay<Interval>&, double);

namespace {

Quadratic<Interval> enclose(const Quadratic<Exact>& wall) {
  return {oracle::enclose(wall.a), oracle::enclose(wall.b), oracle::enclose(wall.c),
          oracle::enclose(wall.discriminant)};
}

}  // namespace

LocalRay<Interval> enclose(const LocalRay<Exact>& ray) {
  LocalRay<Interval> result;
  for (int i = 0; i < 3; ++i) {
    result.o[i] = enclose(ray.o[i]);
    result.d[i] = enclose(ray.d[i]);
  }
  result.walls = {enclose(ray.walls.enter), enclose(ray.walls.leave)};
  return result;
}

Interval enclose_crossing(const Target<Exact>& target, const LocalRay<Exact>& exact,
                          const LocalRay<Interval>& enclosed, Surface surface, bool enters) {
  if (surface == Surface::kWall) return root_of(enclosed.wall(enters), enters);
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
  // If there is an axis, take the point next to it, within the slab.
  double base = dd > 0 ? -od / dd : 0;
  if (target.has_wall && !target.planes.empty() && d[2] != 0) {
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
  // Two crossings of the wall are distinct.
  if (ends.begin == ends.end) return ends;
  const bool has_length = compare(crossing_of(target, ray, ends.begin, true),
                                  crossing_of(target, ray, ends.end, false)) < 0;
  return has_length ? std::optional(ends) : std::nullopt;
}

template std::optional<Ends> ends_of(const Target<Exact>&, const LocalRay<Exact>&,
                                     std::span<const uint32_t>);
template std::optional<Ends> ends_of(const Target<Interval>&, const LocalRay<Interval>&,
                                     std::span<const uint32_t>);

namespace {

Vector<Interval> local_normal(const Target<Interval>& target, const LocalRay<Interval>& ray,
                              const Interval& t, Surface surface) {
  Vector<Interval> point;
  for (int i = 0; i < 3; ++i) point[i] = ray.o[i] + t * ray.d[i];
  return target.profile ? target.profile->normal(point, surface)
                        : target.twin->wall_normal(target, point);
}

/// Returns |n·d| for the local normal n of a surface that is not the wall.
Interval across_surface(const Target<Interval>& target, const LocalRay<Interval>& ray,
                        const Interval& t, Surface surface) {
  if (target.profile) return CGAL::abs(dot(local_normal(target, ray, t, surface), ray.d));
  return with_plane(target, surface, [&](const Plane<Interval>& plane) {
    return Interval(CGAL::abs(dot(plane.normal, ray.d)));
  });
}

}  // namespace

Vector<Interval> normal_at(const Target<Interval>& target, const LocalRay<Interval>& ray,
                           const Interval& t, Surface surface) {
  Vector<Interval> local;
  if (surface == Surface::kWall || target.profile) {
    local = local_normal(target, ray, t, surface);
  } else {
    local = with_plane(target, surface, [](const Plane<Interval>& plane) { return plane.normal; });
  }
  Vector<Interval> world;
  for (int i = 0; i < 3; ++i) {
    world[i] = target.to_local[0][i] * local[0] + target.to_local[1][i] * local[1] +
               target.to_local[2][i] * local[2];
  }
  return world;
}

Interval steepness_at(const Target<Interval>& target, const LocalRay<Interval>& ray,
                      const Interval& t, Surface surface, bool enters) {
  // Half the gradient times the direction is half the derivative along the ray, at a root ±√D.
  const Interval across = surface == Surface::kWall ? CGAL::sqrt(ray.wall(enters).discriminant)
                                                    : across_surface(target, ray, t, surface);
  return across / length(normal_at(target, ray, t, surface));
}

}  // namespace oracle
