#include "lower/slices.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "language/degrees.hpp"

namespace frontend {
namespace {

/// OpenSCAD takes a length below this for none.
constexpr double kGridFine = 0x1p-20;

/// The length of the curve in space that the farthest point runs along.
double helix_length(const TwistedLayers& layers, double reach) {
  const double turn = layers.turn();
  const double height = layers.height();
  const double scale = layers.top_scale.x;
  if (scale == 1 || scale != layers.top_scale.y) return std::hypot(turn * reach, height);
  // The plan is an Archimedean spiral.
  const double end = turn * scale / (scale - 1);
  const double outer = scale > 1 ? end : turn / (1 - scale);
  const double pitch = reach / outer;
  const auto arc = [&](double angle) {
    return pitch / 2 * (angle * std::sqrt(1 + angle * angle) + std::asinh(angle));
  };
  return std::hypot(arc(outer) - arc(outer - turn), height);
}

/// A length in pieces; one where the piece is no length.
double pieces(double length, double piece) {
  const double count = std::ceil(length / piece);
  return std::isfinite(count) ? count : 1;
}

double twisted_slices(const TwistedLayers& layers, double reach,
                      const csgcore::FacetSettings& facets) {
  const double turn = std::abs(layers.twist);
  const double fewest = std::max(1.0, std::ceil(turn / 120));
  if (reach < kGridFine || !std::isfinite(facets.fn)) return fewest;
  if (facets.fn > 0) return std::max(fewest, std::ceil(turn * facets.fn / 360));
  return std::max(
      fewest, std::min(pieces(turn, facets.fa), pieces(helix_length(layers, reach), facets.fs)));
}

double scaled_slices(const TwistedLayers& layers, const SimplePolygons& outline,
                     const csgcore::FacetSettings& facets) {
  double farthest = 0;
  for (const Polygon& polygon : outline) {
    for (const Vec2& point : polygon) {
      farthest = std::max(farthest, glm::length(point - layers.top_scale * point));
    }
  }
  if (farthest < kGridFine || !std::isfinite(facets.fn)) return 1;
  if (facets.fn > 0) return std::max(1.0, std::trunc(facets.fn));
  return std::max(1.0, pieces(std::hypot(farthest, layers.height()), facets.fs));
}

/// OpenSCAD's `segments` are counted one by one.
constexpr double kMostSegments = 1 << 16;

/// The pieces of each edge that OpenSCAD's `segments` asks for: the longest ones are cut, and those
/// that are about as long together, while no more pieces than asked for result.
std::vector<int> segments_of(const Polygon& polygon, double wanted) {
  constexpr double kAboutAsLong = 0.999;
  std::vector<double> length;
  visit_edges(polygon, [&](const Vec2& a, const Vec2& b) { length.push_back(glm::length(b - a)); });
  std::vector<int> count(polygon.size(), 1);
  size_t total = polygon.size();
  while (static_cast<double>(total) < wanted) {
    const auto share = [&](size_t i) { return length[i] / (count[i] + 0.5); };
    double longest = 0;
    for (size_t i = 0; i < count.size(); ++i) longest = std::max(longest, share(i));
    std::vector<size_t> chosen;
    for (size_t i = 0; i < count.size(); ++i) {
      if (share(i) >= kAboutAsLong * longest) chosen.push_back(i);
    }
    if (static_cast<double>(total + chosen.size()) > wanted) break;
    for (const size_t i : chosen) ++count[i];
    total += chosen.size();
  }
  return count;
}

}  // namespace

double TwistedLayers::turn() const { return std::abs(twist) * std::numbers::pi / 180; }

double TwistedLayers::largest_scale() const { return std::max({1.0, top_scale.x, top_scale.y}); }

Vec2 TwistedLayers::point_at(double share, const Vec2& point) const {
  const double angle = -share * twist;
  const Vec2 turned(
      language::cosine_of_degrees(angle) * point.x - language::sine_of_degrees(angle) * point.y,
      language::sine_of_degrees(angle) * point.x + language::cosine_of_degrees(angle) * point.y);
  return scale_at(share) * turned;
}

double reach_of(const SimplePolygons& outline) {
  double reach = 0;
  for (const Polygon& polygon : outline) {
    for (const Vec2& point : polygon) reach = std::max(reach, glm::length(point));
  }
  return reach;
}

Polygon cut(const Polygon& polygon, const std::vector<int>& count) {
  Polygon result;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Vec2& start = polygon[i];
    const Vec2 way = polygon[(i + 1) % polygon.size()] - start;
    for (int k = 0; k < count[i]; ++k) {
      result.push_back(start + way * (static_cast<double>(k) / count[i]));
    }
  }
  return result;
}

int affordable_slices(double slices, size_t edges) {
  return static_cast<int>(
      std::clamp(std::trunc(slices), 1.0,
                 std::max(1.0, std::floor(kMostSideTriangles / (2 * static_cast<double>(edges))))));
}

double slice_count(const TwistedLayers& layers, const SimplePolygons& outline,
                   const csgcore::FacetSettings& facets) {
  if (layers.twist != 0) return twisted_slices(layers, reach_of(outline), facets);
  if (layers.top_scale.x == layers.top_scale.y) return 1;
  return scaled_slices(layers, outline, facets);
}

Slicing openscad_slicing(double slices, const std::optional<double>& segments,
                         SimplePolygons outline) {
  if (segments) {
    const double wanted = std::min(*segments, kMostSegments);
    for (Polygon& polygon : outline) polygon = cut(polygon, segments_of(polygon, wanted));
  }
  const int count = affordable_slices(slices, edge_count(outline));
  const size_t polygons = outline.size();
  return {count, std::move(outline), std::vector<size_t>(polygons, 0)};
}

}  // namespace frontend
