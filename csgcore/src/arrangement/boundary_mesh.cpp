#include "csgcore/boundary_mesh.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <memory>
#include <utility>

#include "arrangement/cell_tree.hpp"
#include "arrangement/facet_grid.hpp"
#include "arrangement/facet_trees.hpp"
#include "arrangement/manifold_edges.hpp"
#include "arrangement/merged_faces.hpp"
#include "arrangement/needed_facets.hpp"
#include "arrangement/pieces.hpp"
#include "arrangement/separate_parts.hpp"
#include "arrangement/sheets.hpp"
#include "arrangement/simple_surfaces.hpp"
#include "csgcore/stop_scope.hpp"

namespace csgcore {
namespace {

class BoundaryMaker {
 public:
  BoundaryMaker(const Facets& facets, const std::vector<bool>& may_cross_itself,
                const Pieces& pieces)
      : facets_(facets), may_cross_itself_(may_cross_itself), pieces_(pieces) {}

  /// Judges each patch where its operand is alone, or at its largest piece, the first of several.
  void judge_patches(const CellTree& cells) {
    const std::vector<Piece>& pieces = pieces_.all();
    kept_.resize(pieces.size());
    std::vector<bool> is_judged(pieces.size(), false);
    for (const CellTree::Alone& cell : cells.alone()) {
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
      kept_[open[i]] = judged(cells, pieces[largest[open[i]]]);
    });
  }

  BoundaryMesh mesh() const {
    BoundaryMesh result;
    std::vector<uint32_t> number_of(pieces_.point_count(), kNoPlace);
    std::vector<uint32_t> point_of;  // by vertex
    std::vector<bool> may_touch;     // by vertex
    const auto number = [&](uint32_t point) {
      if (number_of[point] == kNoPlace) {
        number_of[point] = static_cast<uint32_t>(result.vertices.size());
        result.vertices.push_back(facets_.to_world(pieces_.point(point).position));
        point_of.push_back(point);
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
    make_manifold(result, may_touch, [&](uint32_t a, uint32_t b, uint32_t c) {
      const std::array<ArrangedPoint, 3> points{
          pieces_.point(point_of[a]), pieces_.point(point_of[b]), pieces_.point(point_of[c])};
      constexpr std::array kAxes{0, 1, 2};
      return std::ranges::all_of(kAxes, [&](int axis) {
        return turn(facets_, points[0], points[1], points[2], axis) == 0;
      });
    });
    return result;
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

  KeptFace judged(const CellTree& cells, const Piece& piece) const {
    const std::array<ArrangedPoint, 3> points{pieces_.point(piece.points[0]),
                                              pieces_.point(piece.points[1]),
                                              pieces_.point(piece.points[2])};
    return cells.kept({&points[0], &points[1], &points[2]}, pieces_.axis(piece),
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

  const Facets& facets_;
  const std::vector<bool>& may_cross_itself_;
  const Pieces& pieces_;
  std::vector<KeptFace> kept_;  // by a patch's first piece
};

/// Returns the mesh of the one operand that there is, whose surface neither crosses nor touches
/// itself: it is the boundary.
BoundaryMesh mesh_of_simple(const Facets& facets) {
  BoundaryMesh result;
  std::vector<uint32_t> number_of(facets.points.size(), kNoPlace);
  for (const Facet& facet : facets.facets) {
    std::array<uint32_t, 3>& triangle = result.triangles.emplace_back();
    for (size_t i = 0; i < 3; ++i) {
      uint32_t& number = number_of[facet.corners[i]];
      if (number == kNoPlace) {
        number = static_cast<uint32_t>(result.vertices.size());
        result.vertices.push_back(facets.to_world(to_vec3(facets.points[facet.corners[i]])));
      }
      triangle[i] = number;
    }
  }
  result.operands.assign(result.triangles.size(), 0);
  return result;
}

BoundaryMesh mesh_of_part(std::span<const TriangleSet> all, const SeparatePart& part) {
  std::vector<const TriangleSet*> operands;
  for (const uint32_t operand : part.operands) operands.push_back(&all[operand]);
  Facets facets = facets_on_grid(operands);
  const std::vector<bool> may_cross_itself = find_simple_surfaces(operands, facets);
  const bool is_simple = part.tokens.size() == 1 && !may_cross_itself[0] && facets.touches.empty();
  if (is_simple) return mesh_of_simple(facets);
  auto trees = std::make_unique<const FacetTrees>(facets, operands.size());
  const Covers covers(facets, *trees, part.tokens, may_cross_itself);
  const NeededFacets needed = needed_facets(facets, *trees, covers, may_cross_itself);
  auto cells = std::make_unique<const CellTree>(facets, *trees, part.tokens, may_cross_itself,
                                                needed.firsts);
  const Sheets sheets = sheets_of(facets, cells->pairs(), covers);
  const Pieces pieces(facets, needed, *cells, sheets);
  BoundaryMaker maker(facets, may_cross_itself, pieces);
  maker.judge_patches(*cells);
  // A third of the memory, which the mesh does not need.
  cells.reset();
  trees.reset();
  return maker.mesh();
}

/// Returns all of them; the operands of each are places in those of its part.
BoundaryMesh joined(std::vector<BoundaryMesh>& meshes, std::span<const SeparatePart> parts) {
  struct Begin {
    size_t vertex = 0;
    size_t triangle = 0;
  };
  std::vector<Begin> begins{{}};
  for (const BoundaryMesh& mesh : meshes) {
    const auto& [vertex, triangle] = begins.back();
    begins.push_back({vertex + mesh.vertices.size(), triangle + mesh.triangles.size()});
  }
  BoundaryMesh result;
  result.vertices.resize(begins.back().vertex);
  result.triangles.resize(begins.back().triangle);
  result.operands.resize(begins.back().triangle);
  tbb::parallel_for(size_t{0}, meshes.size(), [&](size_t i) {
    const auto& [vertex, triangle] = begins[i];
    const BoundaryMesh mesh = std::exchange(meshes[i], {});
    std::ranges::copy(mesh.vertices, result.vertices.begin() + static_cast<std::ptrdiff_t>(vertex));
    for (size_t j = 0; j < mesh.triangles.size(); ++j) {
      for (size_t k = 0; k < 3; ++k) {
        result.triangles[triangle + j][k] = static_cast<uint32_t>(vertex) + mesh.triangles[j][k];
      }
      result.operands[triangle + j] = parts[i].operands[mesh.operands[j]];
    }
  });
  return result;
}

}  // namespace

BoundaryMesh boundary_mesh(std::span<const TriangleSet> operands, const CsgTree& tree) {
  const std::vector<SeparatePart> parts = separate_parts(operands, tree);
  std::vector<BoundaryMesh> meshes(parts.size());
  const std::stop_token* const stop = stop_of_work;
  tbb::parallel_for(size_t{0}, parts.size(), [&](size_t i) {
    const StopScope scope(stop);
    stop_point();
    meshes[i] = mesh_of_part(operands, parts[i]);
  });
  return joined(meshes, parts);
}

}  // namespace csgcore
