#include "solids/smooth_slices.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "base/angles.hpp"

namespace frontend {
namespace {

/// Beyond OpenSCAD's own triangles, smooth sides get no more than these.
constexpr double kMostSmoothTriangles = 1 << 18;

/// How far the upper end of an edge's image is moved against its lower end, from one end of the
/// extrusion to the other: that bends the sides between two layers.
double bend_of(const TwistedLayers& layers, const Vec2& edge) {
  const double skew = std::abs(layers.top_scale.x - layers.top_scale.y);
  return (layers.turn() * layers.largest_scale() + skew) * glm::length(edge);
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

using Pieces = std::vector<std::vector<int>>;  // by polygon and edge

double piece_count(const Pieces& pieces) {
  double sum = 0;
  for (const std::vector<int>& polygon : pieces) {
    for (const int count : polygon) sum += count;
  }
  return sum;
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
  return std::ceil(std::max(layers.turn() * std::sqrt(reach / (8 * tolerance)),
                            std::sqrt(bend / (kShareOfBend * tolerance))));
}

/// The offset for which opposite edges of a slice differ least: the edges of a circle face those of
/// the same direction, which may be far from their own images. That of an outline with corners is
/// 0.
size_t offset_of(const TwistedLayers& layers, int slices, const Polygon& polygon) {
  const TwistedLayers turning{0, 1, layers.twist / slices};
  const TwistedLayer top = turning.at(1);
  const size_t count = polygon.size();
  std::vector<Vec2> below, above;
  visit_edges(polygon, [&](const Vec2& a, const Vec2& b) {
    below.push_back(b - a);
    above.push_back(top.image(b - a));
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

/// Returns by how many edges an outline may turn in a slice. The sides of a slice lie between edges
/// of one direction, whose distances from the axis must change evenly on the way.
size_t most_edges_turned(const Polygon& polygon, double tolerance) {
  std::vector<double> distances;
  visit_edges(polygon, [&](const Vec2& a, const Vec2& b) {
    distances.push_back((a.x * b.y - a.y * b.x) / glm::length(b - a));
  });
  const size_t count = distances.size();
  const auto is_even = [&](size_t edges) {
    for (size_t i = 0; i < count; ++i) {
      const double ends = (distances[i] + distances[(i + edges) % count]) / 2;
      const double middle =
          (distances[(i + edges / 2) % count] + distances[(i + (edges + 1) / 2) % count]) / 2;
      if (!(std::abs(middle - ends) <= tolerance)) return false;
    }
    return true;
  };
  size_t result = 1;
  while (8 * result < count && is_even(result + 1)) ++result;
  return result;
}

/// The sides of an outline without corners. A slice turns by as much as some of its edges do, or by
/// a little more or less, so that each edge meets one of its own direction.
std::optional<Slicing> round_slicing(const TwistedLayers& layers, double slices,
                                     const SimplePolygons& outline) {
  const double tolerance = smooth_tolerance(layers, reach_of(outline));
  double in_a_turn = 0;
  for (const Polygon& polygon : outline) {
    in_a_turn = std::max(in_a_turn, static_cast<double>(polygon.size()) /
                                        static_cast<double>(most_edges_turned(polygon, tolerance)));
  }
  const double edges = layers.turn() / kTurn * in_a_turn;
  Slicing result;
  result.slices = affordable_slices(std::max(slices, std::round(edges)), edge_count(outline));
  for (const Polygon& polygon : outline) {
    result.offsets.push_back(offset_of(layers, result.slices, polygon));
    if (result.offsets.back() == 0) return std::nullopt;
  }
  result.outline = outline;
  return result;
}

Slicing between_images(const TwistedLayers& layers, double slices, SimplePolygons outline) {
  const double reach = reach_of(outline) * layers.largest_scale();
  const double least = smooth_tolerance(layers, reach_of(outline));
  outline = with_fewer_corners(std::move(outline), least);
  const size_t edges = edge_count(outline);
  const double most = std::max(kMostSmoothTriangles,
                               2 * static_cast<double>(edges) * affordable_slices(slices, edges));
  for (double tolerance = least; tolerance <= reach; tolerance *= 2) {
    const double wanted = std::max(slices, slices_within(layers, outline, reach, tolerance));
    Pieces pieces;
    for (const Polygon& polygon : outline) {
      pieces.push_back(smooth_pieces(layers, polygon, wanted, tolerance));
    }
    if (2 * piece_count(pieces) * wanted > most) continue;
    for (size_t i = 0; i < outline.size(); ++i) outline[i] = cut(outline[i], pieces[i]);
    return openscad_slicing(wanted, std::nullopt, std::move(outline));
  }
  return openscad_slicing(slices, std::nullopt, std::move(outline));
}

}  // namespace

double smooth_tolerance(const TwistedLayers& layers, double reach) {
  return kSmoothTolerance * std::max(reach * layers.largest_scale(), layers.height() / 2);
}

bool has_flat_sides(const TwistedLayers& layers, double reach) {
  constexpr double kLeastMotion = 4;
  return reach * layers.turn() > kLeastMotion * layers.height();
}

Slicing smooth_slicing(const TwistedLayers& layers, double slices, SimplePolygons outline) {
  if (!has_flat_sides(layers, reach_of(outline))) {
    return between_images(layers, slices, std::move(outline));
  }
  std::optional<Slicing> result = round_slicing(layers, slices, outline);
  return result ? std::move(*result) : openscad_slicing(slices, std::nullopt, std::move(outline));
}

}  // namespace frontend
