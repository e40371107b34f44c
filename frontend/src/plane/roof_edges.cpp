#include "plane/roof_edges.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <utility>

#include "base/angles.hpp"

namespace frontend {
namespace {

/// A corner that turns by less does not: its edges would meet at any point of the line.
constexpr double kStraight = 1e-11;

/// Returns whether the boundary turns at b by a corner of the region.
bool is_corner(const Vec2& a, const Vec2& b, const Vec2& c) {
  const Vec2 before = b - a, after = c - b;
  const double size = glm::length(before) * glm::length(after);
  return std::abs(cross(before, after)) > kStraight * size;
}

/// Returns the polygon without points that are no corners, and without tips of no width.
std::vector<uint32_t> corners_of(std::vector<uint32_t> loop, const std::vector<Vec2>& places) {
  for (bool is_changed = true; is_changed && loop.size() >= 3;) {
    is_changed = false;
    std::vector<uint32_t> kept;
    for (size_t i = 0; i < loop.size(); ++i) {
      const uint32_t before = kept.empty() ? loop.back() : kept.back();
      const uint32_t after = loop[(i + 1) % loop.size()];
      const bool is_kept =
          loop[i] != before && is_corner(places[before], places[loop[i]], places[after]);
      if (is_kept) kept.push_back(loop[i]);
    }
    is_changed = kept.size() < loop.size();
    loop = std::move(kept);
  }
  if (loop.size() < 3) loop.clear();
  return loop;
}

struct OutlineEdge {
  uint32_t start, end;  // corners
  uint32_t next;        // edge
};

/// Lets the boundary turn left as far as it can at points that it passes several times, so that
/// no other edge begins or ends within one of the region's corners.
void part_touching_corners(std::vector<OutlineEdge>& edges, const std::vector<Vec2>& places) {
  std::map<uint32_t, std::vector<uint32_t>> coming, going;  // edges by corner
  for (uint32_t i = 0; i < edges.size(); ++i) {
    coming[edges[i].end].push_back(i);
    going[edges[i].start].push_back(i);
  }
  for (const auto& [corner, ends] : coming) {
    if (ends.size() < 2) continue;
    for (const uint32_t end : ends) {
      const Vec2 back = places[edges[end].start] - places[corner];
      double least = std::numeric_limits<double>::infinity();
      for (const uint32_t start : going[corner]) {
        const Vec2 on = places[edges[start].end] - places[corner];
        double angle = std::atan2(cross(on, back), glm::dot(on, back));
        if (angle <= 0) angle += kTurn;
        if (angle < least) {
          least = angle;
          edges[end].next = start;
        }
      }
    }
  }
}

/// Returns the shortest edge of each corner; infinity: it has none.
std::vector<double> shortest_edges(const std::vector<OutlineEdge>& edges,
                                   const std::vector<Vec2>& places) {
  std::vector<double> shortest(places.size(), std::numeric_limits<double>::infinity());
  for (const OutlineEdge& edge : edges) {
    const double length = glm::length(places[edge.end] - places[edge.start]);
    for (const uint32_t corner : {edge.start, edge.end}) {
      shortest[corner] = std::min(shortest[corner], length);
    }
  }
  return shortest;
}

void jitter_corners(const std::vector<double>& shortest, double jitter, std::vector<Vec2>& places) {
  std::minstd_rand random;
  const auto offset = [&] {
    return 2.0 * static_cast<double>(random() - random.min()) / (random.max() - random.min()) - 1;
  };
  for (size_t i = 0; i < places.size(); ++i) {
    if (!std::isfinite(shortest[i])) continue;
    const double x = offset(), y = offset();
    places[i] += jitter * shortest[i] * Vec2(x, y);
  }
}

}  // namespace

Vec2 corner_velocity(const Vec2& before, const Vec2& after) {
  const double cosine = glm::dot(before, after);
  if (cosine < -0.5) return (after - before) / cross(before, after);
  const Vec2 sum = before + after;
  return Vec2(-sum.y, sum.x) / (1 + cosine);
}

bool is_reflex(const Vec2& before, const Vec2& after) {
  constexpr double kRounding = 1e-9;
  return cross(before, after) < -kRounding;
}

RoofEdges roof_edges(std::span<const Polygon> polygons, double bevel_step, double jitter) {
  RoofEdges result;
  std::map<std::pair<double, double>, uint32_t> number_of;
  std::vector<OutlineEdge> outline;
  std::vector<std::vector<uint32_t>> loops;
  for (const Polygon& polygon : polygons) {
    std::vector<uint32_t>& loop = loops.emplace_back();
    for (const Vec2& point : polygon) {
      const auto [entry, is_new] =
          number_of.try_emplace({point.x, point.y}, static_cast<uint32_t>(result.corners.size()));
      if (is_new) result.corners.push_back(point);
      loop.push_back(entry->second);
    }
  }
  for (std::vector<uint32_t>& points : loops) {
    const std::vector<uint32_t> loop = corners_of(std::move(points), result.corners);
    const auto first = static_cast<uint32_t>(outline.size());
    const auto count = static_cast<uint32_t>(loop.size());
    for (uint32_t i = 0; i < count; ++i) {
      outline.push_back({loop[i], loop[(i + 1) % count], first + (i + 1) % count});
    }
  }
  part_touching_corners(outline, result.corners);
  std::vector<Vec2> places = result.corners;
  result.shortest = shortest_edges(outline, places);
  if (jitter > 0) jitter_corners(result.shortest, jitter, places);

  std::vector<RoofEdge>& edges = result.edges;
  for (const OutlineEdge& edge : outline) {
    RoofEdge& own = edges.emplace_back();
    own.start_corner = edge.start;
    own.end_corner = edge.end;
    own.start = places[edge.start];
    own.end = places[edge.end];
    own.direction = glm::normalize(own.end - own.start);
    own.next = edge.next;
  }
  for (uint32_t i = 0; i < outline.size(); ++i) {
    const RoofEdge before = edges[i];
    const Vec2 after = edges[before.next].direction;
    if (bevel_step <= 0 || !is_reflex(before.direction, after)) continue;
    const double turn =
        std::atan2(cross(after, before.direction), glm::dot(before.direction, after));
    const int bevels = static_cast<int>(std::ceil(turn / bevel_step));
    uint32_t last = i;
    for (int k = 1; k <= bevels; ++k) {
      RoofEdge bevel;
      bevel.start_corner = bevel.end_corner = before.end_corner;
      bevel.start = bevel.end = before.end;
      bevel.direction = turned(before.direction, -turn * k / (bevels + 1));
      bevel.next = before.next;
      edges[last].next = static_cast<uint32_t>(edges.size());
      last = edges[last].next;
      edges.push_back(bevel);
    }
  }
  for (RoofEdge& edge : edges) {
    RoofEdge& next = edges[edge.next];
    edge.end_velocity = corner_velocity(edge.direction, next.direction);
    if (!is_reflex(edge.direction, next.direction)) continue;
    edge.end_reach = glm::dot(edge.end_velocity, edge.direction);
    next.start_reach = -glm::dot(edge.end_velocity, next.direction);
  }
  return result;
}

}  // namespace frontend
