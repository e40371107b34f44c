#include "csgcore/polyhedron.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "base/constants.hpp"

namespace csgcore {
namespace {

/// The enclosing quadric is larger than it need be by this share, and a branch's faces are taken to
/// lie further in by it. It is far above the rounding, so that no face below a branch that is
/// skipped would have moved a crossing by its last bit, and far below the distances between faces.
constexpr double kMargin = 1e-9;

/// A branch with so few entries would cost as much as the entries themselves.
constexpr size_t kFewEntries = 8;

/// Lists the points `items` (indices) as a hierarchy in preorder. It calls `open(items)` before the
/// points of a branch, `close(entry)` with the result of `open` after them, and `add(i)` for each
/// point. A branch's points are divided in halves across the longest side of their box.
template <typename Open, typename Close, typename Add>
void list_clusters(std::span<const Vec3> points, std::span<uint32_t> items, bool is_whole,
                   const Open& open, const Close& close, const Add& add) {
  if (items.size() <= kFewEntries) {
    for (const uint32_t i : items) add(i);
    return;
  }
  const size_t entry = is_whole ? 0 : open(std::span<const uint32_t>(items));
  Box box;
  for (const uint32_t i : items) box.merge(points[i]);
  const Vec3 size = box.size();
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto half = items.begin() + static_cast<std::ptrdiff_t>(items.size() / 2);
  std::nth_element(items.begin(), half, items.end(), [&](uint32_t a, uint32_t b) {
    return points[a][axis] != points[b][axis] ? points[a][axis] < points[b][axis] : a < b;
  });
  for (const std::span<uint32_t> part :
       {std::span(items.begin(), half), std::span(half, items.end())}) {
    list_clusters(points, part, false, open, close, add);
  }
  if (!is_whole) close(entry);
}

std::vector<uint32_t> all_indices(size_t count) {
  std::vector<uint32_t> indices(count);
  std::iota(indices.begin(), indices.end(), 0u);
  return indices;
}

/// Returns the mean direction of points as seen from the origin, or any direction if the points lie
/// all around it.
Vec3 mean_direction(std::span<const Vec3> points, std::span<const uint32_t> items) {
  Vec3 sum(0.0);
  for (const uint32_t i : items) sum += glm::normalize(points[i]);
  const double length = glm::length(sum);
  return length > 0 ? sum / length : Vec3(0, 0, 1);
}

/// Returns the largest direction · p over the points p of a frustum in canonical space.
double frustum_support(const Polyhedron::Canonical& frustum, const Vec3& direction) {
  const double lateral = std::hypot(direction.x, direction.y);
  return std::max(direction.z + lateral * (frustum.radius_mid + frustum.radius_slope),
                  -direction.z + lateral * (frustum.radius_mid - frustum.radius_slope));
}

/// Returns a lower bound of axis · p over the points p of the frustum with normal · p ≥ offset; +∞
/// if there are none. It maximises the Lagrangian dual offset·λ − support(λ·normal − axis), which
/// is concave in λ and every value of which for λ ≥ 0 is such a bound.
double least_in_frustum(const Polyhedron::Canonical& frustum, const Vec3& axis, const Vec3& normal,
                        double offset) {
  if (offset >= frustum_support(frustum, normal)) return kInfinity;
  const auto bound = [&](double lambda) {
    return offset * lambda - frustum_support(frustum, lambda * normal - axis);
  };
  double high = 1 / glm::length(normal);
  while (bound(2 * high) > bound(high)) high *= 2;
  high *= 2;
  double low = 0;
  constexpr int kSteps = 40;  // each keeps 2/3 of the interval
  for (int step = 0; step < kSteps; ++step) {
    const double a = low + (high - low) / 3;
    const double b = high - (high - low) / 3;
    (bound(a) < bound(b) ? low : high) = bound(a) < bound(b) ? a : b;
  }
  return bound(0.5 * (low + high));
}

/// Returns the minimum for the unit ball, of which the half-space cuts off a cap. `axis` has unit
/// length.
double least_in_ball(const Vec3& axis, const Vec3& normal, double offset) {
  const double length = glm::length(normal);
  const double height = offset / length;
  if (height >= 1) return kInfinity;
  const double cosine = glm::dot(axis, normal) / length;
  if (-cosine >= height) return -1;  // −axis lies in the cap
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  return height * cosine - std::sqrt(1 - height * height) * sine;
}

Vec3 mean_of(const std::vector<Vec3>& points) {
  Vec3 sum(0.0);
  for (const Vec3& point : points) sum += point / static_cast<double>(points.size());
  return sum;
}

/// Returns a canonical space, centred at the vertices' mean, in which the vertices lie in the unit
/// ball.
Polyhedron::Canonical within_ball(const std::vector<Vec3>& vertices) {
  const Vec3 center = mean_of(vertices);
  Vec3 half(0.0);
  for (const Vec3& vertex : vertices) half = glm::max(half, glm::abs(vertex - center));
  double radius = 0;
  for (const Vec3& vertex : vertices) {
    radius = std::max(radius, glm::length((vertex - center) / half));
  }
  return {center, half * radius, false};
}

/// Returns the normal of the half-space in canonical space, where it is normal · x ≤ 1. The offset
/// from the centre may be a small difference of large numbers, and is computed in long double.
Vec3 canonical_normal(const HalfSpace& half_space, const Vec3& center, const Vec3& scale) {
  long double offset = half_space.offset;
  for (int i = 0; i < 3; ++i) {
    offset -= static_cast<long double>(half_space.normal[i]) * center[i];
  }
  Vec3 normal;
  for (int i = 0; i < 3; ++i) {
    normal[i] =
        static_cast<double>(half_space.normal[i] * static_cast<long double>(scale[i]) / offset);
  }
  return normal;
}

/// Returns the axis that the vector is parallel to, or kNoAxis.
uint32_t axis_of(const Vec3& v) {
  const int zeros = (v.x == 0) + (v.y == 0) + (v.z == 0);
  if (zeros != 2) return Polyhedron::Entry::kNoAxis;
  return v.x != 0 ? 0 : v.y != 0 ? 1 : 2;
}

}  // namespace

Polyhedron::Polyhedron(std::vector<HalfSpace> half_spaces, std::vector<Vec3> vertices,
                       Canonical canonical)
    : half_spaces_(std::move(half_spaces)),
      vertices_(std::move(vertices)),
      canonical_(std::move(canonical)) {
  canonical_.scale *= 1 + kMargin;
  list_faces();
  list_vertices();
  find_slabs();
}

Polyhedron::Polyhedron(std::vector<HalfSpace> half_spaces, std::vector<Vec3> vertices)
    : Polyhedron(std::move(half_spaces), vertices, within_ball(vertices)) {}

std::shared_ptr<const Polyhedron> Polyhedron::sphere(double radius, int fragments) {
  return std::make_shared<const Polyhedron>(csgcore::half_spaces(faceted_sphere(radius, fragments)),
                                            sphere_mesh(radius, fragments).vertices,
                                            Canonical{Vec3(0.0), Vec3(radius), false});
}

std::shared_ptr<const Polyhedron> Polyhedron::frustum(double z_min, double z_max, double r_bottom,
                                                      double r_top, int fragments) {
  const double radius = std::max(r_bottom, r_top);
  const double bottom = r_bottom / radius;
  const double top = r_top / radius;
  return std::make_shared<const Polyhedron>(
      csgcore::half_spaces(faceted_frustum(z_min, z_max, r_bottom, r_top, fragments)),
      frustum_mesh(z_min, z_max, r_bottom, r_top, fragments).vertices,
      Canonical{{0, 0, 0.5 * z_min + 0.5 * z_max},
                {radius, radius, 0.5 * (z_max - z_min)},
                true,
                0.5 * (bottom + top),
                0.5 * (top - bottom)});
}

std::shared_ptr<const Polyhedron> Polyhedron::box(const Box& box) {
  return std::make_shared<const Polyhedron>(csgcore::half_spaces(box), box_mesh(box).vertices);
}

std::shared_ptr<const Polyhedron> Polyhedron::from(const Mesh& mesh) {
  std::optional<std::vector<HalfSpace>> half_spaces = csgcore::half_spaces(mesh);
  if (!half_spaces) return nullptr;
  return std::make_shared<const Polyhedron>(std::move(*half_spaces), mesh.vertices);
}

void Polyhedron::list_faces() {
  std::vector<Vec3> normals;
  for (const HalfSpace& half_space : half_spaces_) {
    normals.push_back(canonical_normal(half_space, canonical_.center, canonical_.scale));
  }
  const auto branch_of = [&](std::span<const uint32_t> items) {
    const Vec3 axis = mean_direction(normals, items);
    double limit = kInfinity;
    for (const uint32_t i : items) {
      const double offset = 1 - kMargin * std::max(1.0, glm::length(normals[i]));
      limit = std::min(limit, canonical_.in_frustum
                                  ? least_in_frustum(canonical_, axis, normals[i], offset)
                                  : least_in_ball(axis, normals[i], offset));
    }
    return Entry{axis, limit, 0};
  };
  double longest = 0;
  for (const Vec3& normal : normals) longest = std::max(longest, glm::length(normal));
  inner_radius_ = (1 - kMargin) / longest;
  std::vector<uint32_t> faces = all_indices(normals.size());
  list_clusters(
      normals, faces, true,
      [&](std::span<const uint32_t> items) {
        entries_.push_back(branch_of(items));
        return entries_.size() - 1;
      },
      [&](size_t entry) { entries_[entry].skip = uint32_t(entries_.size() - entry - 1); },
      [&](uint32_t i) {
        entries_.push_back({normals[i], 1, 0, axis_of(normals[i])});
      });
}

void Polyhedron::list_vertices() {
  std::vector<Vec3> points;
  for (const Vec3& vertex : vertices_) {
    points.push_back((vertex - canonical_.center) / canonical_.scale);
  }
  const auto branch_of = [&](std::span<const uint32_t> items) {
    VertexEntry branch{mean_direction(points, items)};
    branch.cosine = 1;
    for (const uint32_t i : items) {
      const double length = glm::length(points[i]);
      branch.reach = std::max(branch.reach, length);
      branch.cosine = std::min(branch.cosine, glm::dot(branch.direction, points[i]) / length);
    }
    branch.sine = std::sqrt(std::max(0.0, 1 - branch.cosine * branch.cosine));
    return branch;
  };
  std::vector<uint32_t> corners = all_indices(points.size());
  list_clusters(
      points, corners, true,
      [&](std::span<const uint32_t> items) {
        vertex_entries_.push_back(branch_of(items));
        return vertex_entries_.size() - 1;
      },
      [&](size_t entry) {
        vertex_entries_[entry].skip = uint32_t(vertex_entries_.size() - entry - 1);
      },
      [&](uint32_t i) {
        vertex_entries_.push_back({points[i], 0, 0});
      });
}

void Polyhedron::find_slabs() {
  if (half_spaces_.size() != 6) return;
  Slabs slabs{Vec3(0.0), Vec3(0.0)};
  for (const Entry& entry : entries_) {
    if (entry.skip > 0) continue;
    if (entry.axis == Entry::kNoAxis) return;
    const int axis = static_cast<int>(entry.axis);
    const double along = entry.normal[axis];
    (along < 0 ? slabs.below : slabs.above)[axis] = along;
  }
  // If six axis-parallel faces bound a solid, two of them are perpendicular to each axis.
  slabs_ = slabs;
}

bool Polyhedron::contains(const Vec3& point, double slack) const {
  const double inner = inner_radius_ - slack;
  if (inner > 0 && glm::dot(point, point) <= inner * inner) return true;
  if (!(gauge(point) <= 1)) return false;
  for (size_t i = 0; i < entries_.size(); ++i) {
    const Entry& entry = entries_[i];
    const double reach = glm::dot(entry.normal, point);
    const bool is_face = entry.skip == 0;
    if (is_face &&
        !(reach <= 1 && (slack == 0 || reach <= 1 - slack * glm::length(entry.normal)))) {
      return false;
    }
    if (!is_face && reach <= entry.limit && slack <= kMargin) i += entry.skip;
  }
  return true;
}

Vec3 Polyhedron::face_towards(const Vec3& point) const {
  // It is the face with the largest normal · x, which is the same at all points x of the ray. At
  // the point where the ray meets the enclosing quadric, which lies outside of the solid, that face
  // is below no branch that is skipped.
  const Vec3 p = point / gauge(point);
  Vec3 normal(0.0);
  double furthest = -kInfinity;
  for (size_t i = 0; i < entries_.size(); ++i) {
    const Entry& entry = entries_[i];
    const double reach = glm::dot(entry.normal, p);
    if (entry.skip > 0) {
      if (reach <= entry.limit) i += entry.skip;
    } else if (reach > furthest) {
      furthest = reach;
      normal = entry.normal;
    }
  }
  return normal;
}

double Polyhedron::gauge(const Vec3& p) const {
  if (!canonical_.in_frustum) return glm::length(p);
  const double lateral = std::hypot(p.x, p.y) - canonical_.radius_slope * p.z;
  return std::max(std::abs(p.z), lateral / canonical_.radius_mid);
}

Vec3 Polyhedron::support(const Vec3& direction) const {
  const double length = glm::length(direction);
  // Returns a bound of how far the vertices below a branch reach; the margin is for rounding.
  const auto reach_of = [&](const VertexEntry& branch, double along) {
    const double cosine = along / length;
    if (cosine >= branch.cosine) return branch.reach * length;
    const double across = std::sqrt(std::max(0.0, length * length - along * along));
    return branch.reach * (along * branch.cosine + across * branch.sine + kMargin * length);
  };
  Vec3 vertex(0.0);
  double furthest = -kInfinity;
  const auto visit = [&](const VertexEntry& entry, double along) {
    if (along <= furthest) return;
    furthest = along;
    vertex = entry.direction;
  };
  // First descend into the branch with the furthest bound, so that most others can be skipped.
  for (size_t begin = 0, end = vertex_entries_.size(); begin < end;) {
    size_t next_begin = end, next_end = end;
    double next_reach = -kInfinity;
    for (size_t i = begin; i < end; i += vertex_entries_[i].skip + 1) {
      const VertexEntry& entry = vertex_entries_[i];
      const double along = glm::dot(entry.direction, direction);
      if (entry.skip == 0) {
        visit(entry, along);
      } else if (const double reach = reach_of(entry, along); reach > next_reach) {
        next_reach = reach;
        next_begin = i + 1;
        next_end = next_begin + entry.skip;
      }
    }
    begin = next_begin;
    end = next_end;
  }
  for (size_t i = 0; i < vertex_entries_.size(); ++i) {
    const VertexEntry& entry = vertex_entries_[i];
    const double along = glm::dot(entry.direction, direction);
    if (entry.skip == 0) {
      visit(entry, along);
    } else if (reach_of(entry, along) <= furthest) {
      i += entry.skip;
    }
  }
  return vertex;
}

bool same_polyhedron(const Polyhedron* a, const Polyhedron* b) {
  if (a == b) return true;
  if (!a || !b) return false;
  const Polyhedron::Canonical &x = a->canonical(), &y = b->canonical();
  return x.center == y.center && x.scale == y.scale && x.in_frustum == y.in_frustum &&
         x.radius_mid == y.radius_mid && x.radius_slope == y.radius_slope &&
         a->vertices() == b->vertices() &&
         std::equal(a->half_spaces().begin(), a->half_spaces().end(), b->half_spaces().begin(),
                    b->half_spaces().end(), [](const HalfSpace& p, const HalfSpace& q) {
                      return p.normal == q.normal && p.offset == q.offset;
                    });
}

}  // namespace csgcore
