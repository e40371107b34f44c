#include "csgcore/boundary_mesh.hpp"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "arrangement/facet_pairs.hpp"
#include "arrangement/facets.hpp"
#include "arrangement/pieces.hpp"
#include "arrangement/sheets.hpp"
#include "arrangement/tree_sides.hpp"
#include "arrangement/windings.hpp"
#include "csgcore/stop_scope.hpp"

namespace csgcore {
namespace {

/// What is kept of a patch.
struct Kept {
  /// 1: the solid is behind the patch's first facet, as it is behind that facet's operand; -1: it
  /// is before it; 0: on both sides or on none, and nothing is kept.
  int sign = 0;
  uint32_t operand = 0;  // whose face it shows
};

class BoundaryMaker {
 public:
  BoundaryMaker(const Facets& facets, const Pieces& pieces, const CsgTree& tree,
                size_t operand_count)
      : facets_(facets), pieces_(pieces), tree_(tree), operand_count_(operand_count) {}

  BoundaryMesh run() {
    judge_patches();
    return mesh();
  }

 private:
  double area_of(const Piece& piece) const {
    std::array<Vec3, 3> corners;
    for (size_t i = 0; i < 3; ++i) {
      const uint32_t point = piece.points[i];
      corners[i] = point < pieces_.corner_count() ? to_vec3(facets_.points[point])
                                                  : pieces_.point(point).position;
    }
    const Vec3 area = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    return glm::dot(area, area);
  }

  /// Judges each patch at its largest piece, the first of several.
  void judge_patches() {
    const std::vector<Piece>& pieces = pieces_.all();
    std::vector<double> areas(pieces.size());
    tbb::parallel_for(tbb::blocked_range<size_t>(0, pieces.size(), 1024), [&](const auto& range) {
      for (size_t i = range.begin(); i < range.end(); ++i) areas[i] = area_of(pieces[i]);
    });
    std::vector<uint32_t> largest(pieces.size(), kNoPlace);  // by a patch's first piece
    std::vector<uint32_t> patches;
    for (uint32_t i = 0; i < pieces.size(); ++i) {
      const uint32_t patch = pieces_.patches()[i];
      if (is_divided(i)) continue;
      if (largest[patch] == kNoPlace) patches.push_back(patch);
      if (largest[patch] == kNoPlace || areas[i] > areas[largest[patch]]) largest[patch] = i;
    }
    const Windings windings(facets_);
    kept_.resize(pieces.size());
    tbb::enumerable_thread_specific<TreeSides> sides(tree_, operand_count_);
    const std::stop_token* const stop = stop_of_work;
    tbb::parallel_for(size_t{0}, patches.size(), [&](size_t i) {
      const StopScope scope(stop);
      stop_point();
      kept_[patches[i]] = judged(pieces[largest[patches[i]]], windings, sides.local());
    });
  }

  bool is_divided(uint32_t piece) const { return pieces_.is_divided(piece); }

  /// Returns 1 if the facet faces along the axis, -1 if against it.
  int facing(uint32_t facet, int axis) const {
    const auto [a, b, c] = facets_.corners(facet);
    return turn(a, b, c, axis);
  }

  Kept judged(const Piece& piece, const Windings& windings, TreeSides& sides) const {
    const int axis = pieces_.axis(piece);
    const std::array<ArrangedPoint, 3> points{pieces_.point(piece.points[0]),
                                              pieces_.point(piece.points[1]),
                                              pieces_.point(piece.points[2])};
    const std::span<const uint32_t> over = pieces_.facets(piece);
    Windings::Numbers ahead =
        windings.at({&points[0], &points[1], &points[2]}, axis, over);  // along the axis
    Windings::Numbers behind = ahead;
    for (const uint32_t facet : over) {
      const uint32_t operand = facets_.facets[facet].operand;
      const auto place =
          std::ranges::lower_bound(behind, operand, {}, &std::pair<uint32_t, int>::first);
      const int crossed = facing(facet, axis);
      if (place != behind.end() && place->first == operand) {
        place->second += crossed;
      } else {
        behind.insert(place, {operand, crossed});
      }
    }
    std::erase_if(behind, [](const auto& number) { return number.second == 0; });
    const auto operands = [](const Windings::Numbers& numbers) {
      std::vector<uint32_t> result;
      for (const auto& [operand, number] : numbers) result.push_back(operand);
      return result;
    };
    const std::vector<uint32_t> held_ahead = operands(ahead);
    const std::vector<uint32_t> held_behind = operands(behind);
    std::vector<uint32_t> changed;
    std::ranges::set_symmetric_difference(held_ahead, held_behind, std::back_inserter(changed));
    const TreeSides::Face face = sides.face(held_ahead, held_behind, changed);
    if (face.is_inside_front == face.is_inside_back) return {};
    return {(face.is_inside_back ? 1 : -1) * facing(over.front(), axis), face.shown};
  }

  BoundaryMesh mesh() const {
    BoundaryMesh result;
    std::vector<uint32_t> number_of(pieces_.point_count(), kNoPlace);
    const auto number = [&](uint32_t point) {
      if (number_of[point] == kNoPlace) {
        number_of[point] = static_cast<uint32_t>(result.vertices.size());
        result.vertices.push_back(facets_.to_world(pieces_.point(point).position));
      }
      return number_of[point];
    };
    const std::vector<Piece>& pieces = pieces_.all();
    for (uint32_t i = 0; i < pieces.size(); ++i) {
      const Kept& kept = kept_[pieces_.patches()[i]];
      if (kept.sign == 0 || is_divided(i)) continue;
      const Piece& piece = pieces[i];
      // A facet turns as itself, a triangle of a sheet to the left in the drawing.
      const int turns =
          piece.sheet == kNoPlace ? 1 : facing(pieces_.facets(piece).front(), pieces_.axis(piece));
      auto [a, b, c] = piece.points;
      if (turns * kept.sign < 0) std::swap(b, c);
      result.triangles.push_back({number(a), number(b), number(c)});
      result.operands.push_back(kept.operand);
    }
    return result;
  }

  const Facets& facets_;
  const Pieces& pieces_;
  const CsgTree& tree_;
  size_t operand_count_;
  std::vector<Kept> kept_;  // by a patch's first piece
};

}  // namespace

BoundaryMesh boundary_mesh(std::span<const TriangleSet> operands, const CsgTree& tree) {
  const Facets facets = facets_on_grid(operands);
  std::vector<bool> may_cross_itself;
  for (const TriangleSet& operand : operands) may_cross_itself.push_back(!operand.is_simple);
  const FacetPairs pairs = facet_pairs(facets, may_cross_itself);
  const Sheets sheets = sheets_of(facets, pairs);
  const Pieces pieces(facets, pairs, sheets);
  return BoundaryMaker(facets, pieces, tree, operands.size()).run();
}

size_t open_edges(const TriangleSet& surface) {
  std::vector<std::pair<uint64_t, int>> edges;
  for (const auto& triangle : surface.triangles) {
    for (size_t i = 0; i < 3; ++i) {
      const uint32_t a = triangle[i];
      const uint32_t b = triangle[(i + 1) % 3];
      edges.emplace_back(uint64_t{std::min(a, b)} << 32 | std::max(a, b), a < b ? 1 : -1);
    }
  }
  std::ranges::sort(edges);
  size_t result = 0;
  for (size_t i = 0; i < edges.size();) {
    const uint64_t edge = edges[i].first;
    int sum = 0;
    for (; i < edges.size() && edges[i].first == edge; ++i) sum += edges[i].second;
    if (sum != 0) ++result;
  }
  return result;
}

}  // namespace csgcore
