#include "kinds/mesh_solid.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace csgcore::reference {
namespace {

/// The sheets of open meshes (NUMERICS.md, "Meshes").
constexpr Real kSheetTolerances = 4;
constexpr Real kLeastSheetCosine = Real(1) / 1024;

/// A vertex as seen along the ray.
struct Seen {
  Real x, y, t;
};

/// Returns 1 if the edge passes the positive half of the x axis upwards, −1 if downwards, else 0.
int upwards(const Seen& from, const Seen& to) {
  const bool starts_below = from.y < 0, ends_below = to.y < 0;
  if (starts_below == ends_below) return 0;
  const Seen& below = starts_below ? from : to;
  const Seen& above = starts_below ? to : from;
  if (!(below.x * above.y - above.x * below.y > 0)) return 0;
  return starts_below ? 1 : -1;
}

/// Returns a coordinate axis across the direction, more or less.
LongVec3 axis_across(const LongVec3& d) {
  const Real x = std::abs(d.x), y = std::abs(d.y), z = std::abs(d.z);
  return x <= y && x <= z ? LongVec3(1, 0, 0) : y <= z ? LongVec3(0, 1, 0) : LongVec3(0, 0, 1);
}

Span span_between(const MeshPassage& begin, const MeshPassage& end) {
  // The outward normal is against the ray at the beginning, and along it at the end. A triangle's
  // own normal is against it where the winding number grows.
  return {begin.t, end.t, triangle_surface(begin.triangle, begin.turn < 0),
          triangle_surface(end.triangle, end.turn > 0)};
}

/// Adds a span that begins no earlier than the others, or extends the last one.
void unite(const Span& span, std::vector<Span>& spans, size_t first) {
  if (span.empty()) return;
  if (spans.size() == first || spans.back().end < span.begin) {
    spans.push_back(span);
  } else if (spans.back().end < span.end) {
    spans.back().end = span.end;
    spans.back().end_surface = span.end_surface;
  }
}

}  // namespace

LongVec3 triangle_normal(const TriangleMesh& mesh, uint32_t triangle) {
  const auto corner = [&](size_t k) {
    return LongVec3(mesh.vertices()[mesh.triangles()[triangle][k]]);
  };
  return glm::cross(corner(1) - corner(0), corner(2) - corner(0));
}

std::vector<MeshPassage> passages(const TriangleMesh& mesh, const NearRay& ray) {
  const LongVec3& d = ray.direction;
  const LongVec3 right = glm::normalize(glm::cross(axis_across(d), d));
  const LongVec3 up = glm::normalize(glm::cross(d, right));
  std::vector<Seen> seen;
  seen.reserve(mesh.vertices().size());
  for (const Vec3& vertex : mesh.vertices()) {
    const LongVec3 v = LongVec3(vertex) - ray.origin;
    seen.push_back({glm::dot(right, v), glm::dot(up, v), glm::dot(d, v) / glm::dot(d, d)});
  }
  std::vector<MeshPassage> result;
  for (uint32_t i = 0; i < mesh.triangles().size(); ++i) {
    const auto& [a, b, c] = mesh.triangles()[i];
    const int winding =
        upwards(seen[a], seen[b]) + upwards(seen[b], seen[c]) + upwards(seen[c], seen[a]);
    if (winding == 0) continue;
    const LongVec3 normal = triangle_normal(mesh, i);
    const Real at =
        glm::dot(normal, LongVec3(mesh.vertices()[a]) - ray.origin) / glm::dot(normal, d);
    const auto [nearest, furthest] = std::minmax({seen[a].t, seen[b].t, seen[c].t});
    const Real t = std::isnan(at) ? nearest : std::clamp(at, nearest, furthest);
    result.push_back({t, i, -winding});
  }
  std::sort(result.begin(), result.end(), [](const MeshPassage& a, const MeshPassage& b) {
    return a.t != b.t ? a.t < b.t : a.triangle < b.triangle;
  });
  return result;
}

std::vector<Span> wound_spans(const std::vector<MeshPassage>& passages) {
  std::vector<Span> spans;
  int winding = 0;
  const MeshPassage* begin = nullptr;
  for (const MeshPassage& passage : passages) {
    if (winding == 0) begin = &passage;
    winding += passage.turn;
    if (winding == 0) unite(span_between(*begin, passage), spans, 0);
  }
  return spans;
}

MeshSolid::MeshSolid(const Primitive& primitive)
    : mesh_(primitive.as<MeshShape>().mesh),
      local_to_world_(primitive.local_to_world.linear),
      world_to_local_(glm::inverse(local_to_world_)) {}

Real MeshSolid::sheet_length(const MeshPassage& passage, const NearRay& ray, Real thickness) const {
  const LongVec3 local = triangle_normal(*mesh_, passage.triangle);
  const LongVec3 normal = glm::normalize(glm::transpose(world_to_local_) * local);
  const LongVec3 direction = local_to_world_ * ray.direction;
  const Real speed =
      std::max(std::abs(glm::dot(normal, direction)), kLeastSheetCosine * glm::length(direction));
  return kSheetTolerances * thickness / speed;
}

void MeshSolid::add_spans(const NearRay& ray, Real thickness, std::vector<Span>& spans) const {
  const std::vector<MeshPassage> passed = passages(*mesh_, ray);
  int turns = 0;
  for (const MeshPassage& passage : passed) turns += passage.turn;
  if (turns == 0) {
    const std::vector<Span> wound = wound_spans(passed);
    spans.insert(spans.end(), wound.begin(), wound.end());
    return;
  }
  const size_t first = spans.size();
  for (const MeshPassage& start : passed) {
    MeshPassage end = start;
    end.t += sheet_length(start, ray, thickness);
    unite(span_between(start, end), spans, first);
  }
}

LongVec3 MeshSolid::normal(const LongVec3&, Surface surface) const {
  const LongVec3 own = triangle_normal(*mesh_, triangle_of(surface));
  return uint32_t(surface) % 2 == 1 ? -own : own;
}

}  // namespace csgcore::reference
