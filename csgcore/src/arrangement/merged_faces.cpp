#include "arrangement/merged_faces.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "arrangement/disjoint_sets.hpp"
#include "arrangement/planar_subdivision.hpp"
#include "arrangement/sorted_by_key.hpp"
#include "csgcore/stop_scope.hpp"

namespace csgcore {
namespace {

/// An edge of a kept piece, from point `from` to point `to`.
struct FaceEdge {
  uint32_t from;
  uint32_t to;
  uint32_t piece;  // a place among the kept ones

  std::pair<uint32_t, uint32_t> ends() const { return std::minmax(from, to); }
  bool operator<(const FaceEdge& other) const {
    return std::pair(ends(), piece) < std::pair(other.ends(), other.piece);
  }
};

/// What meets in a point: the edges between faces.
struct FaceCorner {
  std::array<uint32_t, 2> neighbors{kNoPlace, kNoPlace};
  uint32_t count = 0;
};

/// Only the outline of an open surface crosses itself.
struct OutlineCrosses {};

class FaceMerger {
 public:
  FaceMerger(const Pieces& pieces, const std::vector<KeptPiece>& kept)
      : pieces_(pieces),
        kept_(kept),
        faces_(kept.size()),
        is_of_facet_(pieces.point_count(), false),
        corner_at_(pieces.point_count(), kNoPlace) {}

  std::vector<FaceTriangle> run() {
    std::vector<FaceTriangle> result;
    for (uint32_t i = 0; i < kept_.size(); ++i) {
      if (is_merged(i)) {
        merged_.push_back(i);
      } else {
        result.push_back(kept_[i].triangle);
        for (const uint32_t point : kept_[i].triangle.points) is_of_facet_[point] = true;
      }
    }
    if (merged_.empty()) return result;
    find_edges();
    find_corners();
    const auto face_of = [&](uint32_t piece) { return faces_.find(piece); };
    sort_by_key(merged_, kept_.size(), face_of);
    sort_by_key(edges_, kept_.size(), [&](const FaceEdge& edge) { return face_of(edge.piece); });
    struct Face {
      std::span<const uint32_t> pieces;
      std::span<const FaceEdge> edges;
      std::vector<FaceTriangle> triangles;  // empty: its pieces' triangles
    };
    std::vector<Face> faces;
    size_t edge = 0;
    for (size_t begin = 0; begin < merged_.size();) {
      const uint32_t face = face_of(merged_[begin]);
      size_t end = begin;
      while (end < merged_.size() && face_of(merged_[end]) == face) ++end;
      const size_t first_edge = edge;
      while (edge < edges_.size() && face_of(edges_[edge].piece) == face) ++edge;
      faces.push_back({std::span(merged_).subspan(begin, end - begin),
                       std::span(edges_).subspan(first_edge, edge - first_edge),
                       {}});
      begin = end;
    }
    const std::stop_token* const stop = stop_of_work;
    tbb::parallel_for(size_t{0}, faces.size(), [&](size_t i) {
      const StopScope scope(stop);
      stop_point();
      faces[i].triangles = triangles_of(faces[i].pieces, faces[i].edges);
    });
    for (const Face& face : faces) {
      result.insert(result.end(), face.triangles.begin(), face.triangles.end());
      if (!face.triangles.empty()) continue;
      for (const uint32_t i : face.pieces) result.push_back(kept_[i].triangle);
    }
    return result;
  }

 private:
  const Piece& piece(uint32_t i) const { return pieces_.all()[kept_[i].piece]; }
  /// A facet that has no corner in a sheet is as far from what is divided as one that is alone.
  bool is_merged(uint32_t i) const {
    return pieces_.is_compared(kept_[i].piece) &&
           std::ranges::any_of(kept_[i].triangle.points,
                               [&](uint32_t point) { return pieces_.is_in_sheet(point); });
  }

  bool are_one_face(uint32_t a, uint32_t b) const {
    if (kept_[a].triangle.operand != kept_[b].triangle.operand) return false;
    const bool is_one_sheet = piece(a).sheet == piece(b).sheet && piece(a).sheet != kNoPlace;
    return is_one_sheet || pieces_.are_in_one_plane(piece(a), piece(b));
  }

  /// Joins pieces to faces, and keeps the edges between faces.
  void find_edges() {
    std::vector<FaceEdge> all;
    for (const uint32_t i : merged_) {
      const auto& points = kept_[i].triangle.points;
      for (size_t j = 0; j < 3; ++j) all.push_back({points[j], points[(j + 1) % 3], i});
    }
    sort_by_key(all, pieces_.point_count(), [](const FaceEdge& edge) { return edge.ends().first; });
    for (size_t begin = 0; begin < all.size();) {
      size_t end = begin + 1;
      while (end < all.size() && all[end].ends() == all[begin].ends()) ++end;
      const bool is_inner = end - begin == 2 && all[begin].from == all[begin + 1].to &&
                            are_one_face(all[begin].piece, all[begin + 1].piece);
      if (is_inner) {
        faces_.join(all[begin].piece, all[begin + 1].piece);
      } else {
        edges_.insert(edges_.end(), all.begin() + static_cast<std::ptrdiff_t>(begin),
                      all.begin() + static_cast<std::ptrdiff_t>(end));
      }
      begin = end;
    }
  }

  void find_corners() {
    for (size_t i = 0; i < edges_.size(); ++i) {
      if (i > 0 && edges_[i].ends() == edges_[i - 1].ends()) continue;
      const auto [a, b] = edges_[i].ends();
      for (const auto& [point, neighbor] : {std::pair(a, b), std::pair(b, a)}) {
        if (corner_at_[point] == kNoPlace) {
          corner_at_[point] = static_cast<uint32_t>(corners_.size());
          corners_.emplace_back();
          // A facet is not triangulated anew: its corners stay.
          if (is_of_facet_[point]) corners_.back().count = 2;
        }
        FaceCorner& corner = corners_[corner_at_[point]];
        if (corner.count < 2) corner.neighbors[corner.count] = neighbor;
        ++corner.count;
      }
    }
    // Two edges may run straight on.
    for (const FaceEdge& edge : edges_) {
      FaceCorner& corner = corners_[corner_at_[edge.from]];
      if (corner.count != 2) continue;
      const int axis = pieces_.axis(piece(edge.piece));
      const bool is_straight =
          turn(pieces_.all_facets(), pieces_.point(corner.neighbors[0]), pieces_.point(edge.from),
               pieces_.point(corner.neighbors[1]), axis) == 0;
      corner.count = is_straight ? 0 : 3;
    }
  }

  bool runs_straight(uint32_t point) const { return corners_[corner_at_[point]].count == 0; }

  /// Returns the points that a face with these edges leaves out: where its outline runs straight
  /// on. At the end of a cut into it, it turns back, though other faces may run on.
  std::unordered_set<uint32_t> left_out(std::span<const FaceEdge> edges) const {
    std::unordered_map<uint32_t, uint32_t> neighbor_of;
    std::unordered_set<uint32_t> result;
    for (const FaceEdge& edge : edges) {
      for (const auto& [point, neighbor] :
           {std::pair(edge.from, edge.to), std::pair(edge.to, edge.from)}) {
        if (!runs_straight(point)) continue;
        if (neighbor_of.emplace(point, neighbor).first->second != neighbor) result.insert(point);
      }
    }
    return result;
  }

  /// Returns where the edge ends if points that are left out are passed.
  uint32_t end_of(const FaceEdge& edge, const std::unordered_set<uint32_t>& passed) const {
    uint32_t from = edge.from;
    uint32_t to = edge.to;
    while (passed.contains(to)) {
      const auto& neighbors = corners_[corner_at_[to]].neighbors;
      const uint32_t next = neighbors[0] == from ? neighbors[1] : neighbors[0];
      from = std::exchange(to, next);
    }
    return to;
  }

  /// Returns whether all corners of the pieces are on the outline, which has these edges.
  bool are_on_outline(std::span<const uint32_t> pieces, std::span<const FaceEdge> edges) const {
    std::vector<uint32_t> outline;
    outline.reserve(edges.size());
    for (const FaceEdge& edge : edges) outline.push_back(edge.from);
    std::ranges::sort(outline);
    return std::ranges::all_of(pieces, [&](uint32_t i) {
      return std::ranges::all_of(kept_[i].triangle.points, [&](uint32_t point) {
        return std::ranges::binary_search(outline, point);
      });
    });
  }

  /// Returns the triangles of the face; none: it has those of its pieces.
  std::vector<FaceTriangle> triangles_of(std::span<const uint32_t> pieces,
                                         std::span<const FaceEdge> edges) const {
    const std::unordered_set<uint32_t> passed = left_out(edges);
    if (passed.empty() && are_on_outline(pieces, edges)) return {};
    const int axis = pieces_.axis(piece(pieces.front()));
    std::vector<std::pair<uint32_t, uint32_t>> outline;
    std::unordered_map<uint32_t, ArrangedPoint> points;
    GridPoint least{};
    GridPoint most{};
    for (const FaceEdge& edge : edges) {
      if (passed.contains(edge.from)) continue;
      outline.emplace_back(edge.from, end_of(edge, passed));
      // Of an open surface an end may be no start.
      for (const uint32_t end : {outline.back().first, outline.back().second}) {
        const auto& point = points.emplace(end, pieces_.point(end)).first->second;
        for (size_t i = 0; i < 3; ++i) {
          const double x = point.position[static_cast<int>(i)];
          const auto low = static_cast<int64_t>(std::floor(x)) - 1;
          const auto high = static_cast<int64_t>(std::ceil(x)) + 1;
          least[i] = points.size() == 1 ? low : std::min(least[i], low);
          most[i] = points.size() == 1 ? high : std::max(most[i], high);
        }
      }
    }
    PlanarSubdivision drawing(
        pieces_.all_facets(), axis,
        [](uint32_t, uint32_t, auto&) -> ArrangedPoint { throw OutlineCrosses(); });
    drawing.start_around(least, most);
    // By point of the drawing.
    std::vector<uint32_t> names(PlanarSubdivision::kBorderPoints, kNoPlace);
    std::unordered_map<uint32_t, uint32_t> drawn;
    for (const auto& [from, to] : outline) {
      for (const uint32_t end : {from, to}) {
        if (drawn.contains(end)) continue;
        drawn[end] = drawing.insert(points.at(end));
        names.push_back(end);
      }
    }
    try {
      for (uint32_t i = 0; i < outline.size(); ++i) {
        drawing.draw(drawn.at(outline[i].first), drawn.at(outline[i].second), i);
      }
    } catch (const OutlineCrosses&) {
      return {};
    }
    const bool is_left =
        turn(pieces_.all_facets(), pieces_.point(kept_[pieces.front()].triangle.points[0]),
             pieces_.point(kept_[pieces.front()].triangle.points[1]),
             pieces_.point(kept_[pieces.front()].triangle.points[2]), axis) > 0;
    std::vector<FaceTriangle> result;
    for (const uint32_t i : inside(drawing)) {
      auto [a, b, c] = drawing.triangles()[i].points;
      if (!is_left) std::swap(b, c);
      // The outline of an open surface need not be closed.
      if (std::min({a, b, c}) < PlanarSubdivision::kBorderPoints) return {};
      result.push_back({{names[a], names[b], names[c]}, kept_[pieces.front()].triangle.operand});
    }
    return result;
  }

  /// Returns the triangles within the outline, which each of its edges enters or leaves.
  static std::vector<uint32_t> inside(const PlanarSubdivision& drawing) {
    const auto& triangles = drawing.triangles();
    std::vector<int> is_inside(triangles.size(), -1);
    std::vector<uint32_t> open{drawing.border_triangle()};
    is_inside[open.front()] = 0;
    std::vector<uint32_t> result;
    while (!open.empty()) {
      const uint32_t at = open.back();
      open.pop_back();
      if (is_inside[at] == 1) result.push_back(at);
      for (size_t edge = 0; edge < 3; ++edge) {
        const uint32_t next = triangles[at].beyond[edge];
        if (next == kNoPlace || is_inside[next] >= 0) continue;
        int lines = 0;
        for (uint32_t link = triangles[at].lines[edge]; link != kNoPlace;
             link = drawing.links()[link].next) {
          ++lines;
        }
        is_inside[next] = (is_inside[at] + lines) % 2;
        open.push_back(next);
      }
    }
    std::ranges::sort(result);
    return result;
  }

  const Pieces& pieces_;
  const std::vector<KeptPiece>& kept_;
  DisjointSets faces_;               // of kept pieces
  std::vector<uint32_t> merged_;     // kept pieces
  std::vector<bool> is_of_facet_;    // by point: of other pieces
  std::vector<uint32_t> corner_at_;  // by point: its place in corners_
  std::vector<FaceCorner> corners_;
  std::vector<FaceEdge> edges_;  // between faces, in the order of their ends
};

}  // namespace

std::vector<FaceTriangle> merged_faces(const Pieces& pieces, const std::vector<KeptPiece>& kept) {
  return FaceMerger(pieces, kept).run();
}

}  // namespace csgcore
