#include "exact_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace oracle {
namespace {

using csgcore::TriangleMesh;

template <class Number>
Vector<Number> difference(const Vector<Number>& a, const Vector<Number>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

template <class Number>
Number side_of(const Vector<Number>& a, const Vector<Number>& b, const LocalRay<Number>& ray) {
  return dot(ray.d, cross(difference(a, ray.o), difference(b, ray.o)));
}

/// Returns the sign of the edge if the line is moved by (ε, ε², ε³), or 0 if the edge is parallel
/// to it. A move by δ changes d·((a − o) × (b − o)) by δ·(d × (b − a)).
int sign_if_moved(const Vector<Exact>& a, const Vector<Exact>& b, const LocalRay<Exact>& ray) {
  for (const Exact& change : cross(ray.d, difference(b, a))) {
    if (const int sign = sign_of(change)) return sign;
  }
  return 0;
}

/// Returns the boxes of the triangles.
std::vector<csgcore::Box> boxes_of(const TriangleMesh& mesh,
                                   const std::vector<Vector<Interval>>& vertices) {
  std::vector<csgcore::Box> boxes;
  for (const TriangleMesh::Triangle& triangle : mesh.triangles()) {
    csgcore::Box& box = boxes.emplace_back();
    for (const uint32_t vertex : triangle) {
      const Vector<Interval>& v = vertices[vertex];
      box.merge(csgcore::Vec3(v[0].inf(), v[1].inf(), v[2].inf()));
      box.merge(csgcore::Vec3(v[0].sup(), v[1].sup(), v[2].sup()));
    }
  }
  return boxes;
}

}  // namespace

ExactMesh::ExactMesh(std::shared_ptr<const TriangleMesh> mesh, const Vector<Exact>& middle,
                     const Exact& magnification)
    : mesh_(std::move(mesh)), middle_(middle), magnification_(magnification), tree_({}) {
  for (uint32_t i = 0; i < mesh_->vertices().size(); ++i) {
    const Vector<Exact> exact = vertex(i);
    vertices_.push_back({enclose(exact[0]), enclose(exact[1]), enclose(exact[2])});
  }
  tree_ = BoxTree(boxes_of(*mesh_, vertices_));
}

Vector<Exact> ExactMesh::vertex(uint32_t index) const {
  Vector<Exact> result;
  for (int i = 0; i < 3; ++i) {
    result[i] = magnification_ * (Exact(mesh_->vertices()[index][i]) - middle_[i]);
  }
  return result;
}

Plane<Exact> ExactMesh::plane(uint32_t triangle) const {
  Vector<Exact> corners[3];
  for (int k = 0; k < 3; ++k) {
    const csgcore::Vec3& v = mesh_->vertices()[mesh_->triangles()[triangle][size_t(k)]];
    corners[k] = difference(Vector<Exact>{v.x, v.y, v.z}, middle_);
  }
  Plane<Exact> plane;
  plane.normal = cross(difference(corners[1], corners[0]), difference(corners[2], corners[0]));
  double largest = 0;
  for (const Exact& coordinate : plane.normal) {
    largest = std::max(largest, std::abs(CGAL::to_double(coordinate)));
  }
  const Exact scale = power_of_two(-std::ilogb(largest));
  for (Exact& coordinate : plane.normal) coordinate = scale * coordinate;
  plane.limit = magnification_ * dot(plane.normal, corners[0]);
  return plane;
}

int ExactMesh::turn_of(const TriangleMesh::Triangle& triangle, const LocalRay<Exact>& ray,
                       const LocalRay<Interval>& enclosed) const {
  int common = 0;
  for (size_t k = 0; k < 3; ++k) {
    const uint32_t a = triangle[k], b = triangle[(k + 1) % 3];
    const Interval side = side_of(vertices_[a], vertices_[b], enclosed);
    int sign = side.inf() > 0 ? 1 : side.sup() < 0 ? -1 : 0;
    if (sign == 0) {
      const Vector<Exact> from = vertex(a), to = vertex(b);
      sign = sign_of(side_of(from, to, ray));
      if (sign == 0) sign = sign_if_moved(from, to, ray);
    }
    if (sign == 0 || sign == -common) return 0;
    common = sign;
  }
  // Corners that turn to the left along the ray belong to a normal along it.
  return -common;
}

std::vector<Passage> ExactMesh::passages(const LocalRay<Exact>& ray) const {
  const LocalRay<Interval> enclosed = enclose(ray);
  constexpr double kEndless = std::numeric_limits<double>::infinity();
  std::vector<uint32_t> near;
  tree_.find(middle(enclosed.o), middle(enclosed.d), -kEndless, near);
  std::vector<Passage> passages;
  for (const uint32_t i : near) {
    const int turn = turn_of(mesh_->triangles()[i], ray, enclosed);
    if (turn != 0) passages.push_back({i, turn});
  }
  return passages;
}

namespace {

/// A passage with its parameter.
struct Passed {
  Passage passage;
  ExactRoot t;
  Interval enclosed;
};

int compare(const Passed& a, const Passed& b) {
  const auto sure = CGAL::compare(a.enclosed, b.enclosed);
  return CGAL::is_certain(sure) ? int(CGAL::get_certain(sure)) : compare(a.t, b.t);
}

/// Returns the segments where the winding number is not 0. Passages at one parameter count at once,
/// so that segments which touch are one.
std::vector<Ends> wound_segments(const std::vector<Passed>& passed) {
  std::vector<Ends> segments;
  int winding = 0;
  for (size_t begin = 0, end = 0; begin < passed.size(); begin = end) {
    const int before = winding;
    while (end < passed.size() && (end == begin || compare(passed[begin], passed[end]) == 0)) {
      winding += passed[end++].passage.turn;
    }
    const auto surface = Surface(passed[begin].passage.triangle);
    if (before == 0 && winding != 0) segments.push_back({surface, surface});
    if (before != 0 && winding == 0) segments.back().end = surface;
  }
  return segments;
}

/// Returns the segments of a ray that passes a hole: sheets, of which those that overlap or touch
/// are united. `length_of(surface)` returns the length of a sheet in t.
template <class LengthOf>
std::vector<Ends> sheets(const std::vector<Passed>& passed, const LengthOf& length_of) {
  std::vector<Ends> segments;
  ExactRoot furthest;
  for (const Passed& start : passed) {
    const auto surface = Surface(start.passage.triangle);
    const double length = length_of(surface);
    const ExactRoot end = moved(start.t, length);
    if (segments.empty() || compare(furthest, start.t) < 0) {
      segments.push_back({surface, surface, length});
      furthest = end;
    } else if (compare(furthest, end) < 0) {
      segments.back().end = surface;
      segments.back().beyond = length;
      furthest = end;
    }
  }
  return segments;
}

}  // namespace

std::vector<Ends> mesh_segments(const Target<Exact>& target, const Target<Interval>& enclosed,
                                const NearRay<Exact>& ray, double base, double thickness) {
  const LocalRay<Exact> near = localize(target, ray, base);
  const LocalRay<Interval> near_enclosed = enclose(near);
  std::vector<Passed> passed;
  int turns = 0;
  for (const Passage& passage : target.mesh->passages(near)) {
    const auto surface = Surface(passage.triangle);
    const bool enters = passage.turn > 0;
    turns += passage.turn;
    const ExactRoot t = crossing_of(target, near, surface, enters);
    passed.push_back({passage, t, enclose(t.p) / enclose(t.r)});
  }
  std::sort(passed.begin(), passed.end(), [](const Passed& a, const Passed& b) {
    const int sign = compare(a, b);
    return sign != 0 ? sign < 0 : a.passage.triangle < b.passage.triangle;
  });
  if (turns == 0) return wound_segments(passed);
  Vector<Interval> direction;
  for (int i = 0; i < 3; ++i) direction[i] = enclose(ray.direction[i]);
  return sheets(passed, [&](Surface surface) {
    const Interval speed = steepness_at(enclosed, near_enclosed, Interval(0), surface, true);
    const Interval least = Interval(kSheetCosine) * length(direction);
    return middle(Interval(kSheetThickness) * Interval(thickness) / (CGAL::max)(speed, least));
  });
}

}  // namespace oracle
