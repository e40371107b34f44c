#include "lower/slices.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "heal/matrix_healing.hpp"

namespace frontend {
namespace {

/// OpenSCAD takes a length below this for none.
constexpr double kGridFine = 0x1p-20;

/// Beyond OpenSCAD's own triangles, smooth sides get no more than these.
constexpr double kMostSmoothTriangles = 1 << 18;

/// The largest distance of the outline from the origin.
double reach_of(const SimplePolygons& outline) {
  double reach = 0;
  for (const Polygon& polygon : outline) {
    for (const Vec2& point : polygon) reach = std::max(reach, glm::length(point));
  }
  return reach;
}

double edge_count(const SimplePolygons& outline) {
  double count = 0;
  for (const Polygon& polygon : outline) count += static_cast<double>(polygon.size());
  return count;
}

/// Calls visit(start, end) for each edge.
template <typename Visit>
void visit_edges(const Polygon& polygon, const Visit& visit) {
  for (size_t i = 0; i < polygon.size(); ++i) visit(polygon[i], polygon[(i + 1) % polygon.size()]);
}

double turn_of(const TwistedLayers& layers) {
  return std::abs(layers.twist) * std::numbers::pi / 180;
}

double largest_scale(const TwistedLayers& layers) {
  return std::max({1.0, layers.top_scale.x, layers.top_scale.y});
}

/// The length of the curve in space that the farthest point runs along.
double helix_length(const TwistedLayers& layers, double reach) {
  const double turn = turn_of(layers);
  const double height = layers.z_max - layers.z_min;
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
  return std::max(1.0, pieces(std::hypot(farthest, layers.z_max - layers.z_min), facets.fs));
}

/// Cuts each edge into as many pieces of equal length as `count` has for it.
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

/// How far the upper end of an edge's image is moved against its lower end, from one end of the
/// extrusion to the other: that bends the sides between two layers.
double bend_of(const TwistedLayers& layers, const Vec2& edge) {
  const double skew = std::abs(layers.top_scale.x - layers.top_scale.y);
  return (turn_of(layers) * largest_scale(layers) + skew) * glm::length(edge);
}

/// Two triangles in place of a bent quadrilateral are off by a quarter of its bend.
constexpr double kShareOfBend = 4;

std::vector<int> smooth_pieces(const TwistedLayers& layers, const Polygon& polygon, double slices,
                               double tolerance) {
  std::vector<int> count;
  visit_edges(polygon, [&](const Vec2& a, const Vec2& b) {
    const double wanted = std::ceil(bend_of(layers, b - a) / (kShareOfBend * slices * tolerance));
    count.push_back(static_cast<int>(std::clamp(wanted, 1.0, kMostSmoothTriangles)));
  });
  return count;
}

double triangle_count(const std::vector<std::vector<int>>& counts, double slices) {
  double sum = 0;
  for (const std::vector<int>& polygon : counts) {
    for (const int count : polygon) sum += count;
  }
  return 2 * sum * slices;
}

/// The slices that keep the sides within the tolerance if edges are cut into pieces as well.
double slices_within(const TwistedLayers& layers, const SimplePolygons& outline, double reach,
                     double tolerance) {
  double bend = 0;
  for (const Polygon& polygon : outline) {
    visit_edges(polygon, [&](const Vec2& a, const Vec2& b) {
      bend = std::max(bend, bend_of(layers, b - a));
    });
  }
  // A chord is off by reach · angle² / 8. A bend is shared out between slices and pieces.
  return std::ceil(std::max(turn_of(layers) * std::sqrt(reach / (8 * tolerance)),
                            std::sqrt(bend / (kShareOfBend * tolerance))));
}

/// The offset for which opposite edges of a slice differ least. A circle about another axis turns
/// by rolling off, so to speak: its edges face those of the same direction. An outline with corners
/// has none.
size_t offset_of(const TwistedLayers& layers, int slices, const Polygon& polygon) {
  const TwistedLayers turning{0, 1, layers.twist / slices};
  const size_t count = polygon.size();
  std::vector<Vec2> below, above;
  visit_edges(polygon, [&](const Vec2& a, const Vec2& b) {
    below.push_back(b - a);
    above.push_back(turning.point_at(1, b - a));
  });
  const auto bend = [&](size_t offset) {
    double worst = 0;
    for (size_t i = 0; i < count; ++i) {
      worst = std::max(worst, glm::length(above[(i + offset) % count] - below[i]));
    }
    return worst;
  };
  // The outline turns by a whole turn in all its corners.
  const double steps = turning.twist / 360 * static_cast<double>(count);
  const double sense = signed_area(polygon) > 0 ? 1 : -1;
  const double offset = std::fmod(sense * std::round(steps), static_cast<double>(count));
  const auto candidate =
      static_cast<size_t>(offset < 0 ? offset + static_cast<double>(count) : offset);
  return bend(candidate) < bend(0) ? candidate : 0;
}

int whole(double slices, double edges) {
  return static_cast<int>(std::clamp(std::trunc(slices), 1.0,
                                     std::max(1.0, std::floor(kMostSideTriangles / (2 * edges)))));
}

}  // namespace

Vec2 TwistedLayers::point_at(double share, const Vec2& point) const {
  const double angle = -share * twist;
  const Vec2 turned(cos_deg(angle) * point.x - sin_deg(angle) * point.y,
                    sin_deg(angle) * point.x + cos_deg(angle) * point.y);
  return scale_at(share) * turned;
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
  const int count = whole(slices, edge_count(outline));
  const size_t polygons = outline.size();
  return {count, std::move(outline), std::vector<size_t>(polygons, 0)};
}

Slicing smooth_slicing(const TwistedLayers& layers, double slices, SimplePolygons outline) {
  const double reach = reach_of(outline) * largest_scale(layers);
  const double edges = edge_count(outline);
  const double most = std::max(kMostSmoothTriangles, 2 * edges * whole(slices, edges));
  std::vector<std::vector<int>> counts;
  double wanted = slices;
  for (double tolerance = kSmoothTolerance * reach; tolerance > 0; tolerance *= 2) {
    wanted = std::max(slices, slices_within(layers, outline, reach, tolerance));
    counts.clear();
    for (const Polygon& polygon : outline) {
      counts.push_back(smooth_pieces(layers, polygon, wanted, tolerance));
    }
    if (triangle_count(counts, wanted) <= most || tolerance > reach) break;
  }
  if (!counts.empty() && triangle_count(counts, wanted) <= most) {
    for (size_t i = 0; i < outline.size(); ++i) outline[i] = cut(outline[i], counts[i]);
    Slicing result{whole(wanted, edge_count(outline)), std::move(outline), {}};
    for (const Polygon& polygon : result.outline) {
      result.offsets.push_back(offset_of(layers, result.slices, polygon));
    }
    return result;
  }
  return openscad_slicing(slices, std::nullopt, std::move(outline));
}

}  // namespace frontend
