#include "solids/sliced_solid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <numbers>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "csgcore/stop_scope.hpp"
#include "csgcore/triangle_mesh.hpp"
#include "language/degrees.hpp"
#include "meshes/triangulation.hpp"

namespace frontend {
namespace {

using csgcore::Vec3;

/// A polygon of the outline by the numbers of its points; points at one place have one number.
struct Loop {
  std::vector<uint32_t> points;
  size_t offset = 0;  // Slicing::offsets
  bool is_hole = false;
};

/// Two corners of a layer, and the two that they are joined to in the next one, by their places
/// among all corners.
struct Side {
  size_t p1, q1, p2, q2;
};

class SlicedMesh {
 public:
  SlicedMesh(const TwistedLayers& layers, const Slicing& slicing)
      : layers_(layers), slices_(static_cast<uint32_t>(slicing.slices)) {
    for (size_t i = 0; i < slicing.outline.size(); ++i) {
      add_loop(slicing.outline[i], slicing.offsets[i]);
    }
  }

  csgcore::Primitive make() {
    const bool has_top = this->has_top();
    add_layers(has_top);
    for (const Loop& loop : loops_) add_sides(loop, has_top);
    add_cap(0);
    add_cap(slices_);
    return csgcore::make_mesh(
        std::make_shared<csgcore::TriangleMesh>(std::move(vertices_), std::move(triangles_)));
  }

  std::vector<csgcore::Primitive> folded_sides() {
    std::vector<csgcore::Primitive> result;
    add_layers(has_top());
    for (const Loop& loop : loops_) {
      for (uint32_t layer = 0; layer < slices_; ++layer) {
        for (size_t i = 0; i < loop.points.size(); ++i) {
          const Side side = side_of(loop, layer, i);
          const bool takes_p1_q2 = is_p1_q2(side, loop.is_hole);
          const size_t last_of_first = takes_p1_q2 ? side.q2 : side.p2;
          const size_t first_of_second = takes_p1_q2 ? side.p1 : side.q1;
          // Each triangle is a mesh of its own: in one they would be turned to agree across the
          // edge that they share, and cancel out where they overlap.
          for (const auto& triangle : {std::array{side.p1, side.q1, last_of_first},
                                       std::array{first_of_second, side.q2, side.p2}}) {
            std::vector<Vec3> corners;
            for (const size_t place : triangle) corners.push_back(vertices_[vertex_[place]]);
            result.push_back(csgcore::make_mesh(std::make_shared<csgcore::TriangleMesh>(
                std::move(corners), std::vector<csgcore::TriangleMesh::Triangle>{{0, 1, 2}})));
          }
        }
      }
    }
    return result;
  }

 private:
  double height() const { return layers_.z_max - layers_.z_min; }
  bool has_top() const { return layers_.top_scale.x > 0 && layers_.top_scale.y > 0; }

  void add_loop(const Polygon& polygon, size_t offset) {
    Loop& loop = loops_.emplace_back();
    loop.offset = offset;
    loop.is_hole = signed_area(polygon) < 0;
    for (const Vec2& point : polygon) {
      const auto [entry, is_new] =
          number_of_.try_emplace({point.x, point.y}, static_cast<uint32_t>(points_.size()));
      if (is_new) points_.push_back(point);
      loop.points.push_back(entry->second);
    }
  }

  void add_layers(bool has_top) {
    const size_t count = points_.size();
    plan_.reserve(count * (slices_ + 1));
    for (uint32_t layer = 0; layer <= slices_; ++layer) {
      csgcore::stop_point();
      const TwistedLayer at = layers_.at(static_cast<double>(layer) / slices_);
      for (const Vec2& point : points_) plan_.push_back(at.image(point));
    }
    for (uint32_t layer = 0; layer <= slices_; ++layer) {
      const double z =
          layer == slices_ ? layers_.z_max : layers_.z_min + height() * layer / slices_;
      if (layer == slices_ && !has_top) {
        add_flat_top(z);
        return;
      }
      for (size_t i = 0; i < count; ++i) {
        vertex_.push_back(static_cast<uint32_t>(vertices_.size()));
        vertices_.emplace_back(plan_[layer * count + i], z);
      }
    }
  }

  /// Points of a top without an area may fall together.
  void add_flat_top(double z) {
    std::map<std::pair<double, double>, uint32_t> at;
    for (size_t i = slices_ * points_.size(); i < plan_.size(); ++i) {
      const auto [entry, is_new] =
          at.try_emplace({plan_[i].x, plan_[i].y}, static_cast<uint32_t>(vertices_.size()));
      if (is_new) vertices_.emplace_back(plan_[i], z);
      vertex_.push_back(entry->second);
    }
  }

  Side side_of(const Loop& loop, uint32_t layer, size_t edge) const {
    const size_t below = layer * points_.size();
    const size_t above = below + points_.size();
    const size_t count = loop.points.size();
    return {below + loop.points[edge], below + loop.points[(edge + 1) % count],
            above + loop.points[(edge + loop.offset) % count],
            above + loop.points[(edge + loop.offset + 1) % count]};
  }

  void add_sides(const Loop& loop, bool has_top) {
    const size_t count = loop.points.size();
    for (uint32_t layer = 0; layer < slices_; ++layer) {
      csgcore::stop_point();
      for (size_t i = 0; i < count; ++i) {
        const Side side = side_of(loop, layer, i);
        bool takes_p1_q2 = is_p1_q2(side, loop.is_hole);
        // OpenSCAD chooses the other one where the extrusion ends in a line or a point.
        if (!has_top && layer + 1 == slices_) takes_p1_q2 = !takes_p1_q2;
        const uint32_t p1 = vertex_[side.p1], q1 = vertex_[side.q1];
        const uint32_t p2 = vertex_[side.p2], q2 = vertex_[side.q2];
        triangles_.push_back({p1, q1, takes_p1_q2 ? q2 : p2});
        triangles_.push_back({takes_p1_q2 ? p1 : q1, q2, p2});
      }
    }
  }

  /// Returns whether the diagonal from p1 to q2 is OpenSCAD's: it takes the shorter one.
  bool is_p1_q2(const Side& side, bool is_hole) const {
    // As OpenSCAD compares them.
    constexpr double kEqual = 0.5e-5;
    const double rising = glm::length(plan_[side.p1] - plan_[side.q2]);
    const double falling = glm::length(plan_[side.q1] - plan_[side.p2]);
    if (std::abs(rising - falling) <= kEqual * (rising + falling)) {
      return (layers_.twist > 0) != is_hole;
    }
    return rising < falling;
  }

  /// Closes the mesh at the first or the last layer.
  void add_cap(uint32_t layer) {
    std::vector<uint32_t> corners, ends;
    std::vector<Vec2> places;
    for (const Loop& loop : loops_) {
      for (const uint32_t point : loop.points) {
        corners.push_back(vertex_[layer * points_.size() + point]);
        places.push_back(plan_[layer * points_.size() + point]);
      }
      ends.push_back(static_cast<uint32_t>(corners.size()));
    }
    const auto close = layer == 0 ? triangulate_all_reversed : triangulate_all;
    close(corners, ends, places, triangles_);
  }

  const TwistedLayers& layers_;
  uint32_t slices_;
  std::map<std::pair<double, double>, uint32_t> number_of_;
  std::vector<Vec2> points_;
  std::vector<Loop> loops_;
  std::vector<Vec2> plan_;        // by layer and point
  std::vector<uint32_t> vertex_;  // by layer and point
  std::vector<Vec3> vertices_;
  std::vector<csgcore::TriangleMesh::Triangle> triangles_;
};

}  // namespace

csgcore::Primitive sliced_mesh(const TwistedLayers& layers, const Slicing& slicing) {
  return SlicedMesh(layers, slicing).make();
}

std::vector<csgcore::Primitive> folded_sides(const TwistedLayers& layers, const Slicing& slicing) {
  const bool is_half_turn = std::abs(std::remainder(layers.twist / slicing.slices, 360)) == 180;
  if (!is_half_turn || layers.top_scale.x != layers.top_scale.y) return {};
  return SlicedMesh(layers, slicing).folded_sides();
}

csgcore::Box sliced_box(const TwistedLayers& layers, int slices, const SimplePolygons& outline) {
  csgcore::Box box;
  for (int layer = 0; layer <= slices; ++layer) {
    const double share = static_cast<double>(layer) / slices;
    const double z = layers.z_min + (layers.z_max - layers.z_min) * share;
    const TwistedLayer at = layers.at(share);
    for (const Polygon& polygon : outline) {
      for (const Vec2& point : polygon) box.merge(Vec3(at.image(point), z));
    }
  }
  return box;
}

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
std::vector<int> segments_of(std::span<const double> length, double wanted) {
  constexpr double kAboutAsLong = 0.999;
  std::vector<int> count(length.size(), 1);
  size_t total = length.size();
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

/// The length of each edge's longest image in a layer.
std::vector<double> longest_images(const TwistedLayers& layers, int slices,
                                   const Polygon& polygon) {
  std::vector<Vec2> edges;
  visit_edges(polygon, [&](const Vec2& a, const Vec2& b) { edges.push_back(b - a); });
  std::vector<double> lengths(edges.size());
  for (int layer = 0; layer <= slices; ++layer) {
    const TwistedLayer at = layers.at(static_cast<double>(layer) / slices);
    for (size_t i = 0; i < edges.size(); ++i) {
      lengths[i] = std::max(lengths[i], glm::length(at.image(edges[i])));
    }
  }
  return lengths;
}

Slicing sliced_outline(double slices, SimplePolygons outline) {
  const int count = affordable_slices(slices, edge_count(outline));
  const size_t polygons = outline.size();
  return {count, std::move(outline), std::vector<size_t>(polygons, 0)};
}

}  // namespace

double TwistedLayers::turn() const { return std::abs(twist) * std::numbers::pi / 180; }

double TwistedLayers::largest_scale() const { return std::max({1.0, top_scale.x, top_scale.y}); }

TwistedLayer TwistedLayers::at(double share) const {
  const double angle = -share * twist;
  return {language::cosine_of_degrees(angle), language::sine_of_degrees(angle), scale_at(share)};
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
                   const csgcore::FacetSettings& facets, bool counts_scale) {
  const bool is_uneven = layers.top_scale.x != layers.top_scale.y;
  double count = 1;
  if (layers.twist != 0) count = twisted_slices(layers, reach_of(outline), facets);
  if (is_uneven && (layers.twist == 0 || counts_scale)) {
    count = std::max(count, scaled_slices(layers, outline, facets));
  }
  return count;
}

Slicing openscad_slicing(double slices, const std::optional<double>& segments,
                         SimplePolygons outline) {
  if (segments) {
    for (Polygon& polygon : outline) {
      std::vector<double> lengths;
      visit_edges(polygon,
                  [&](const Vec2& a, const Vec2& b) { lengths.push_back(glm::length(b - a)); });
      polygon = cut(polygon, segments_of(lengths, std::min(*segments, kMostSegments)));
    }
  }
  return sliced_outline(slices, std::move(outline));
}

Slicing cut_slicing(const TwistedLayers& layers, double slices,
                    const std::optional<double>& segments, const csgcore::FacetSettings& facets,
                    SimplePolygons outline) {
  constexpr double kLeastSegment = 0.01;          // OpenSCAD's limit of $fa and $fs
  constexpr double kBelowRounding = 1 - 0x1p-40;  // a turned edge is as long as it was
  const int layer_count = affordable_slices(slices, edge_count(outline));
  const std::optional<double> asked =
      segments || !(facets.fn > 0) ? segments : std::optional(facets.fn);
  const auto total_of = [](const std::vector<int>& counts) {
    return std::accumulate(counts.begin(), counts.end(), 0.0);
  };
  // A polygon has the fewer of those that $fs and $fa ask for.
  const auto segments_by_settings = [&](const std::vector<double>& lengths) {
    std::vector<int> by_size;
    for (const double length : lengths) {
      const double wanted = std::ceil(length * kBelowRounding / std::max(facets.fs, kLeastSegment));
      by_size.push_back(static_cast<int>(std::clamp(wanted, 1.0, kMostSegments)));
    }
    const double around = std::ceil(360 / std::max(facets.fa, kLeastSegment));
    const std::vector<int> by_angle = segments_of(lengths, std::min(around, kMostSegments));
    return total_of(by_size) <= total_of(by_angle) ? by_size : by_angle;
  };
  std::vector<std::vector<int>> counts;
  double total = 0;
  for (const Polygon& polygon : outline) {
    const std::vector<double> lengths = longest_images(layers, layer_count, polygon);
    counts.push_back(asked ? segments_of(lengths, std::min(*asked, kMostSegments))
                           : segments_by_settings(lengths));
    total += total_of(counts.back());
  }
  // Rather fewer segments than fewer slices.
  const double share = std::min(1.0, kMostSideTriangles / (2 * total * layer_count));
  for (size_t i = 0; i < outline.size(); ++i) {
    for (int& count : counts[i]) count = std::max(1, static_cast<int>(share * count));
    outline[i] = cut(outline[i], counts[i]);
  }
  return sliced_outline(slices, std::move(outline));
}

}  // namespace frontend
