#include "meshes/ring_faces.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>

#include "meshes/planar_predicates.hpp"
#include "meshes/triangulation.hpp"

namespace frontend {
namespace {

using glm::dvec2;
using Ring = std::vector<uint32_t>;
using Places = std::span<const dvec2>;

double twice_area(const Ring& ring, Places places) {
  double sum = 0;
  const dvec2& origin = places[ring.front()];
  for (size_t i = 0; i < ring.size(); ++i) {
    const dvec2 a = places[ring[i]] - origin, b = places[ring[(i + 1) % ring.size()]] - origin;
    sum += a.x * b.y - a.y * b.x;
  }
  return sum;
}

/// Whether an even number of edges lie to the right of the point is false. A point of the ring may
/// be either.
bool is_within(const dvec2& point, const Ring& ring, Places places) {
  bool is_inside = false;
  for (size_t i = 0; i < ring.size(); ++i) {
    const dvec2 &a = places[ring[i]], &b = places[ring[(i + 1) % ring.size()]];
    if ((a.y > point.y) == (b.y > point.y)) continue;
    const int turn = a.y < b.y ? orientation(a, b, point) : orientation(b, a, point);
    if (turn > 0) is_inside = !is_inside;
  }
  return is_inside;
}

/// The corner of a hole furthest to the right.
size_t rightmost(const Ring& hole, Places places) {
  size_t result = 0;
  for (size_t i = 1; i < hole.size(); ++i) {
    if (places[hole[i]].x > places[hole[result]].x) result = i;
  }
  return result;
}

/// Looks for the corner of a ring that a hole's rightmost corner sees (Eberly, "Triangulation by
/// Ear Clipping", 2002).
class Bridge {
 public:
  Bridge(const dvec2& from, const Ring& ring, Places places)
      : from_(from), ring_(ring), places_(places) {}

  std::optional<size_t> end() const {
    const std::optional<size_t> edge = nearest_edge();
    if (!edge) return std::nullopt;
    size_t best = at(*edge).x > at(*edge + 1).x ? *edge : (*edge + 1) % ring_.size();
    const dvec2 hit(hit_x(*edge), from_.y);
    const dvec2 tip = at(best);
    // A corner within the triangle to that end hides it; the one with the least angle is seen.
    double least = steepness(tip);
    for (size_t i = 0; i < ring_.size(); ++i) {
      const dvec2& corner = at(i);
      if (corner.x <= from_.x || !is_in_triangle(corner, hit, tip) || corner == tip) continue;
      const double own = steepness(corner);
      const bool is_nearer = own == least && corner.x < at(best).x;
      if ((own < least || is_nearer) && is_reflex(i)) {
        best = i;
        least = own;
      }
    }
    return best;
  }

 private:
  const dvec2& at(size_t i) const { return places_[ring_[i % ring_.size()]]; }

  double hit_x(size_t edge) const {
    const dvec2 &a = at(edge), &b = at(edge + 1);
    if (a.y == b.y) return std::min(a.x, b.x);
    return a.x + (from_.y - a.y) / (b.y - a.y) * (b.x - a.x);
  }

  /// The nearest edge to the right that has the figure on its left side.
  std::optional<size_t> nearest_edge() const {
    std::optional<size_t> result;
    double nearest = std::numeric_limits<double>::infinity();
    for (size_t i = 0; i < ring_.size(); ++i) {
      if (!(at(i).y <= from_.y && from_.y <= at(i + 1).y) || at(i).y == at(i + 1).y) continue;
      const double x = hit_x(i);
      if (x < from_.x || x >= nearest) continue;
      nearest = x;
      result = i;
    }
    return result;
  }

  double steepness(const dvec2& corner) const {
    return std::abs(corner.y - from_.y) / (corner.x - from_.x);
  }

  bool is_in_triangle(const dvec2& p, const dvec2& hit, const dvec2& tip) const {
    const int turn = orientation(from_, hit, tip);
    if (turn == 0) return false;
    return orientation(from_, hit, p) * turn >= 0 && orientation(hit, tip, p) * turn >= 0 &&
           orientation(tip, from_, p) * turn >= 0;
  }

  bool is_reflex(size_t i) const {
    return orientation(at(i + ring_.size() - 1), at(i), at(i + 1)) <= 0;
  }

  const dvec2& from_;
  const Ring& ring_;
  const Places places_;
};

/// Makes one ring of both, which goes to the hole and back.
void join(Ring& ring, const Ring& hole, Places places) {
  const size_t start = rightmost(hole, places);
  const std::optional<size_t> end = Bridge(places[hole[start]], ring, places).end();
  if (!end) return;
  Ring joined(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(*end) + 1);
  for (size_t i = 0; i <= hole.size(); ++i) joined.push_back(hole[(start + i) % hole.size()]);
  joined.insert(joined.end(), ring.begin() + static_cast<std::ptrdiff_t>(*end), ring.end());
  ring = std::move(joined);
}

}  // namespace

void triangulate_rings(const std::vector<Ring>& rings, Places places,
                       std::vector<std::array<uint32_t, 3>>& triangles) {
  struct Outer {
    Ring ring;
    double area;
    std::vector<Ring> holes;
  };
  std::vector<Outer> outers;
  for (const Ring& ring : rings) {
    const double area = twice_area(ring, places);
    if (area > 0) outers.push_back({ring, area, {}});
  }
  for (const Ring& ring : rings) {
    if (twice_area(ring, places) > 0) continue;
    Outer* around = nullptr;
    for (Outer& outer : outers) {
      const bool is_around = is_within(places[ring[rightmost(ring, places)]], outer.ring, places);
      if (is_around && (around == nullptr || outer.area < around->area)) around = &outer;
    }
    if (around != nullptr) around->holes.push_back(ring);
  }
  for (Outer& outer : outers) {
    // What lies further to the right hides no other hole's way to the right.
    std::sort(outer.holes.begin(), outer.holes.end(), [&](const Ring& a, const Ring& b) {
      return places[a[rightmost(a, places)]].x > places[b[rightmost(b, places)]].x;
    });
    for (const Ring& hole : outer.holes) join(outer.ring, hole, places);
    std::vector<dvec2> corners;
    for (const uint32_t vertex : outer.ring) corners.push_back(places[vertex]);
    triangulate(outer.ring, corners, triangles);
  }
}

}  // namespace frontend
