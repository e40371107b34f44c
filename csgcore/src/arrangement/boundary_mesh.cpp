#include "csgcore/boundary_mesh.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "arrangement/cell_tree.hpp"
#include "arrangement/facet_grid.hpp"
#include "arrangement/manifold_edges.hpp"
#include "arrangement/merged_faces.hpp"
#include "arrangement/pieces.hpp"
#include "arrangement/sheets.hpp"
#include "arrangement/simple_surfaces.hpp"
#include "csgcore/stop_scope.hpp"

namespace csgcore {
namespace {

class BoundaryMaker {
 public:
  BoundaryMaker(const Facets& facets, const std::vector<bool>& may_cross_itself,
                const CellTree& cells, const Pieces& pieces)
      : facets_(facets), may_cross_itself_(may_cross_itself), cells_(cells), pieces_(pieces) {}

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

  /// Judges each patch where its operand is alone, or at its largest piece, the first of several.
  void judge_patches() {
    const std::vector<Piece>& pieces = pieces_.all();
    kept_.resize(pieces.size());
    std::vector<bool> is_judged(pieces.size(), false);
    for (const CellTree::Alone& cell : cells_.alone()) {
      for (const uint32_t facet : cell.facets) {
        const uint32_t piece = pieces_.piece_of(facet);
        if (piece == kNoPlace) continue;
        const uint32_t patch = pieces_.patches()[piece];
        kept_[patch] = cell.kept;
        is_judged[patch] = true;
      }
    }
    std::vector<uint32_t> largest(pieces.size(), kNoPlace);  // by patch
    std::vector<double> areas(pieces.size());                // by patch: of that piece
    std::vector<uint32_t> open;
    for (uint32_t i = 0; i < pieces.size(); ++i) {
      const uint32_t patch = pieces_.patches()[i];
      if (is_judged[patch]) continue;
      const double area = area_of(pieces[i]);
      if (largest[patch] == kNoPlace) open.push_back(patch);
      if (largest[patch] != kNoPlace && area <= areas[patch]) continue;
      largest[patch] = i;
      areas[patch] = area;
    }
    const std::stop_token* const stop = stop_of_work;
    tbb::parallel_for(size_t{0}, open.size(), [&](size_t i) {
      const StopScope scope(stop);
      stop_point();
      kept_[open[i]] = judged(pieces[largest[open[i]]]);
    });
  }

  KeptFace judged(const Piece& piece) const {
    const std::array<ArrangedPoint, 3> points{pieces_.point(piece.points[0]),
                                              pieces_.point(piece.points[1]),
                                              pieces_.point(piece.points[2])};
    return cells_.kept({&points[0], &points[1], &points[2]}, pieces_.axis(piece),
                       pieces_.facets(piece));
  }

  /// Returns 1 if the facet faces along the axis, -1 if against it.
  int facing(uint32_t facet, int axis) const {
    const auto [a, b, c] = facets_.corners(facet);
    return turn(a, b, c, axis);
  }

  std::vector<KeptPiece> kept_pieces() const {
    std::vector<KeptPiece> result;
    const std::vector<Piece>& pieces = pieces_.all();
    for (uint32_t i = 0; i < pieces.size(); ++i) {
      const KeptFace& kept = kept_[pieces_.patches()[i]];
      if (kept.sign == 0) continue;
      const Piece& piece = pieces[i];
      // A facet turns as itself, a triangle of a sheet to the left in the drawing.
      const int turns =
          piece.sheet == kNoPlace ? 1 : facing(pieces_.facets(piece).front(), pieces_.axis(piece));
      auto [a, b, c] = piece.points;
      if (turns * kept.sign < 0) std::swap(b, c);
      result.push_back({i, {{a, b, c}, kept.operand}});
    }
    return result;
  }

  BoundaryMesh mesh() const {
    BoundaryMesh result;
    std::vector<uint32_t> number_of(pieces_.point_count(), kNoPlace);
    std::vector<bool> may_touch;  // by vertex
    const auto number = [&](uint32_t point) {
      if (number_of[point] == kNoPlace) {
        number_of[point] = static_cast<uint32_t>(result.vertices.size());
        result.vertices.push_back(facets_.to_world(pieces_.point(point).position));
        may_touch.push_back(pieces_.is_in_sheet(point));
      }
      return number_of[point];
    };
    for (const auto& [points, operand] : merged_faces(pieces_, kept_pieces())) {
      result.triangles.push_back({number(points[0]), number(points[1]), number(points[2])});
      result.operands.push_back(operand);
      if (!may_cross_itself_[operand]) continue;
      for (const uint32_t vertex : result.triangles.back()) may_touch[vertex] = true;
    }
    part_touching_faces(result, may_touch);
    return result;
  }

  const Facets& facets_;
  const std::vector<bool>& may_cross_itself_;
  const CellTree& cells_;
  const Pieces& pieces_;
  std::vector<KeptFace> kept_;  // by a patch's first piece
};

}  // namespace

BoundaryMesh boundary_mesh(std::span<const TriangleSet> operands, const CsgTree& tree) {
  Facets facets = facets_on_grid(operands);
  const std::vector<bool> may_cross_itself = find_simple_surfaces(operands, facets);
  const CellTree cells(facets, tree, may_cross_itself);
  const Sheets sheets = sheets_of(facets, cells.pairs());
  const Pieces pieces(facets, cells, sheets);
  return BoundaryMaker(facets, may_cross_itself, cells, pieces).run();
}

}  // namespace csgcore
