// Tests the edges of solids against counts by hand, and of random boxes on a lattice against the
// lattice's cells.
#include "frontend/solid_edges.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <map>
#include <random>
#include <set>
#include <string>

#include "csgcore/facets.hpp"
#include "edges/tree_value.hpp"
#include "frontend/importer.hpp"
#include "frontend/parser.hpp"
#include "support/full_run.hpp"

namespace frontend {
namespace {

using csgcore::Vec3;

const ImportOptions kWithMeshes{
    .facets = Facets::kAll, .picture = PictureKind::kRendered, .keeps_meshes = true};

SolidEdges edges_of(const std::string& text) {
  return solid_edges(import_design(parse(text, "a.csg"), kWithMeshes));
}

double total_length(const SolidEdges& solid) {
  double length = 0;
  for (const SolidEdges::Edge& edge : solid.edges) length += glm::distance(edge.from, edge.to);
  return length;
}

std::string moved(double x, double y, double z, const std::string& text) {
  return "multmatrix([[1,0,0," + std::to_string(x) + "],[0,1,0," + std::to_string(y) + "],[0,0,1," +
         std::to_string(z) + "],[0,0,0,1]]) { " + text + " }";
}
std::string box(double x, double y, double z) {
  return "cube(size = [" + std::to_string(x) + ", " + std::to_string(y) + ", " + std::to_string(z) +
         "]);";
}

TEST(SolidEdgesOf, ACornerCutOutOfACube) {
  const SolidEdges solid =
      edges_of("difference() { cube(size = 10); " + moved(5, 5, 5, "cube(size = 10);") + " }");
  EXPECT_EQ(solid.edges.size(), 21u);
  EXPECT_EQ(solid.vertices.size(), 14u);
  size_t cut_edges = 0, cut_vertices = 0;
  for (const auto& edge : solid.edges) cut_edges += edge.is_cut ? 1 : 0;
  for (const auto& vertex : solid.vertices) cut_vertices += vertex.is_cut ? 1 : 0;
  EXPECT_EQ(cut_edges, 9u) << "those of the notch";
  EXPECT_EQ(cut_vertices, 7u);
  EXPECT_TRUE(solid.is_complete);
}

TEST(SolidEdgesOf, FlushFacesHaveNone) {
  const SolidEdges longer = edges_of("cube(size = 10);" + moved(10, 0, 0, "cube(size = 10);"));
  EXPECT_DOUBLE_EQ(total_length(longer), 4 * (20 + 10 + 10));
  EXPECT_EQ(longer.vertices.size(), 8u) << "none within an edge";
  const SolidEdges halved = edges_of("difference() { cube(size = 10); " + box(10, 10, 5) + " }");
  EXPECT_DOUBLE_EQ(total_length(halved), 4 * (10 + 10 + 5));
  EXPECT_EQ(halved.vertices.size(), 8u);
}

TEST(SolidEdgesOf, CrossingEdgesThatTouchFromOutside) {
  // Two cubes that share an edge only: it is one of the solid, listed for each of them.
  const SolidEdges solid = edges_of("cube(size = 10);" + moved(10, 10, 0, "cube(size = 10);"));
  EXPECT_EQ(solid.edges.size(), 24u);
  EXPECT_EQ(solid.vertices.size(), 14u);
}

TEST(SolidEdgesOf, FacesThatCrossAslant) {
  // A square bar, turned by 45° about z, through a cube: a star of eight corners.
  const SolidEdges solid = edges_of(
      "cube(size = 10, center = true);"
      "multmatrix([[0.70710678,-0.70710678,0,0],[0.70710678,0.70710678,0,0],[0,0,1,0],[0,0,0,1]])"
      " cube(size = [10, 10, 10], center = true);");
  EXPECT_EQ(solid.vertices.size(), 2 * 16u);
  // Each cube has four upright edges, and each side's rims give two points.
  const double tip = 10 / std::sqrt(2.0) - 5;  // from the cube's side out to the bar's edge
  const double rims = 2 * 16 * tip * std::sqrt(2.0);
  EXPECT_NEAR(total_length(solid), rims + 16 * 10, 1e-5);
}

TEST(SolidEdgesOf, DiagonalsAreEdgesWhereTheGridBendsThem) {
  EXPECT_EQ(edges_of("cylinder($fn = 4, h = 1, r1 = 2, r2 = 1);").edges.size(), 12u)
      << "whole numbers stay in a plane";
  EXPECT_EQ(edges_of("cylinder($fn = 7, h = 1, r1 = 2, r2 = 2);").edges.size(), 21u)
      << "a cylinder has none";
  const size_t bent = edges_of("cylinder($fn = 7, h = 1, r1 = 2.1, r2 = 1.3);").edges.size();
  EXPECT_GT(bent, 21u);
  EXPECT_LE(bent, 28u);
}

TEST(SolidEdgesOf, TheDiagonalThatRunsFurtherOutIsTheEdge) {
  constexpr uint32_t kSides = 7;
  const std::vector<Vec3> corners = csgcore::frustum_mesh(0, 1, 2.1, 1.3, kSides).vertices;
  const auto cut = [&](uint32_t corner) {
    return glm::trunc(corners[corner] * double(1 << 20)) / double(1 << 20);
  };
  const auto index_of = [&](const Vec3& position) {
    uint32_t nearest = 0;
    for (uint32_t i = 1; i < corners.size(); ++i) {
      if (glm::distance(corners[i], position) < glm::distance(corners[nearest], position)) {
        nearest = i;
      }
    }
    return nearest;
  };
  int diagonals = 0;
  for (const auto& edge : edges_of("cylinder($fn = 7, h = 1, r1 = 2.1, r2 = 1.3);").edges) {
    const auto [below, above] = std::minmax({index_of(edge.from), index_of(edge.to)});
    if (below >= kSides || above < kSides || above - kSides == below) continue;
    const Vec3 middle = (cut(below) + cut(above)) / 2.0;
    const Vec3 other = (cut(above - kSides) + cut(below + kSides)) / 2.0;
    const Vec3 both = middle + other;
    const Vec3 outwards(both.x, both.y, 0.8 * std::hypot(both.x, both.y));
    EXPECT_GT(glm::dot(middle - other, outwards), 0);
    ++diagonals;
  }
  EXPECT_GT(diagonals, 2);
}

TEST(SolidEdgesOf, BodiesOfManyFaces) {
  // The faces of a large mesh are looked up. 10 rings of 20 corners.
  const SolidEdges sphere = edges_of("sphere($fn = 20, r = 3);");
  EXPECT_EQ(sphere.vertices.size(), 200u);
  EXPECT_GE(sphere.edges.size(), 200u + 180u);
  EXPECT_LE(sphere.edges.size(), 200u + 360u);
  // A plate through its middle, whose rims have a corner for each of the ring's and the diagonals'
  // lines that they cross.
  const SolidEdges cut = edges_of("difference() { sphere($fn = 20, r = 3);" +
                                  moved(-5, -5, -0.1, box(10, 10, 0.2)) + " }");
  EXPECT_EQ(std::count_if(cut.vertices.begin(), cut.vertices.end(),
                          [](const auto& vertex) { return !vertex.is_cut; }),
            200);
  EXPECT_GE(std::count_if(cut.vertices.begin(), cut.vertices.end(),
                          [](const auto& vertex) { return vertex.is_cut; }),
            40);
}

TEST(SolidEdgesOf, AnEndlessSearchEnds) {
  const ImportedDesign design = import_design(
      parse("difference() { sphere($fn = 30, r = 3); cube(size = 9); }", "a.csg"), kWithMeshes);
  EXPECT_FALSE(solid_edges(design, 1000).is_complete);
  EXPECT_TRUE(solid_edges(design).is_complete);
}

// Boxes with whole corners from 0 to 4: a solid is a set of the lattice's unit cells.
constexpr int kCells = 4;
struct LatticeBox {
  std::array<int, 3> min, max;
  bool holds_cell(int x, int y, int z) const {
    const std::array<int, 3> c = {x, y, z};
    for (size_t i = 0; i < 3; ++i) {
      if (c[i] < min[i] || c[i] >= max[i]) return false;
    }
    return true;
  }
};

/// A piece of an edge from a point of the lattice one unit along an axis.
using Piece = std::array<int, 4>;  // x, y, z, axis

/// ((a op b) op c) op d
struct LatticeSolid {
  std::array<LatticeBox, 4> boxes;
  std::array<int, 3> operations;  // 0: union, 1: intersection, 2: difference

  bool combine(const std::array<bool, 4>& in) const {
    bool value = in[0];
    for (size_t i = 0; i < 3; ++i) {
      const bool other = in[i + 1];
      value = operations[i] == 0   ? value || other
              : operations[i] == 1 ? value && other
                                   : value && !other;
    }
    return value;
  }
  bool has_cell(int x, int y, int z) const {
    std::array<bool, 4> in{};
    for (size_t i = 0; i < 4; ++i) in[i] = boxes[i].holds_cell(x, y, z);
    return combine(in);
  }
  std::string text() const {
    std::string result;
    for (size_t i = 0; i < 4; ++i) {
      const LatticeBox& b = boxes[i];
      const std::string part =
          moved(b.min[0], b.min[1], b.min[2],
                box(b.max[0] - b.min[0], b.max[1] - b.min[1], b.max[2] - b.min[2]));
      if (i == 0) {
        result = part;
        continue;
      }
      const char* names[] = {"union", "intersection", "difference"};
      result = std::string(names[operations[i - 1]]) + "() { " + result + " " + part + " }";
    }
    return result;
  }
  /// The unit pieces of edges, each with whether the operations leave its middle out.
  std::map<Piece, bool> pieces() const {
    std::map<Piece, bool> result;
    for (int axis = 0; axis < 3; ++axis) {
      for (int x = 0; x <= kCells; ++x) {
        for (int y = 0; y <= kCells; ++y) {
          for (int z = 0; z <= kCells; ++z) {
            if (is_edge({x, y, z}, axis)) result[{x, y, z, axis}] = is_cut({x, y, z}, axis);
          }
        }
      }
    }
    return result;
  }

 private:
  bool is_edge(const std::array<int, 3>& at, int axis) const {
    const auto u = static_cast<size_t>((axis + 1) % 3);
    const auto v = static_cast<size_t>((axis + 2) % 3);
    std::array<bool, 4> around{};  // in a circle
    constexpr int kSteps[4][2] = {{0, 0}, {-1, 0}, {-1, -1}, {0, -1}};
    for (size_t i = 0; i < 4; ++i) {
      std::array<int, 3> cell = at;
      cell[u] += kSteps[i][0];
      cell[v] += kSteps[i][1];
      around[i] = has_cell(cell[0], cell[1], cell[2]);
    }
    const int count = around[0] + around[1] + around[2] + around[3];
    return count == 1 || count == 3 || (count == 2 && around[0] == around[2]);
  }
  bool is_cut(const std::array<int, 3>& at, int axis) const {
    std::array<bool, 4> in{};
    for (size_t i = 0; i < 4; ++i) {
      in[i] = true;
      for (size_t k = 0; k < 3; ++k) {
        const double c = at[k] + (static_cast<int>(k) == axis ? 0.5 : 0);
        in[i] = in[i] && c >= boxes[i].min[k] && c <= boxes[i].max[k];
      }
    }
    return !combine(in);
  }
};

LatticeSolid random_solid(uint32_t seed) {
  std::mt19937 random(seed);
  LatticeSolid solid;
  for (LatticeBox& b : solid.boxes) {
    for (size_t i = 0; i < 3; ++i) {
      b.min[i] = static_cast<int>(random() % kCells);
      b.max[i] =
          b.min[i] + 1 + static_cast<int>(random() % static_cast<unsigned>(kCells - b.min[i]));
    }
  }
  for (int& operation : solid.operations) operation = static_cast<int>(random() % 3);
  return solid;
}

TEST(SolidEdgesOf, RandomBoxesOnALattice) {
  const uint32_t count = test_support::full_run() ? 5000 : 200;
  std::printf("%u solids\n", count);
  for (uint32_t seed = 0; seed < count; ++seed) {
    const LatticeSolid lattice = random_solid(seed);
    const SolidEdges solid = edges_of(lattice.text());
    std::map<Piece, bool> pieces;
    for (const SolidEdges::Edge& edge : solid.edges) {
      const Vec3 along = edge.to - edge.from;
      const double length = glm::length(along);
      const int axis = std::abs(along.x) > 0.5 ? 0 : std::abs(along.y) > 0.5 ? 1 : 2;
      const Vec3 start = glm::min(edge.from, edge.to);
      for (int i = 0; i < std::lround(length); ++i) {
        Piece piece = {int(std::lround(start.x)), int(std::lround(start.y)),
                       int(std::lround(start.z)), axis};
        piece[static_cast<size_t>(axis)] += i;
        pieces[piece] = edge.is_cut;
      }
    }
    const std::map<Piece, bool> expected = lattice.pieces();
    ASSERT_EQ(pieces, expected) << "seed " << seed << ": " << lattice.text();
    // A vertex is where edges end that do not only continue each other.
    std::map<std::array<int, 3>, std::set<int>> directions;
    for (const auto& [piece, is_cut] : expected) {
      std::array<int, 3> at = {piece[0], piece[1], piece[2]};
      directions[at].insert(2 * piece[3]);
      ++at[static_cast<size_t>(piece[3])];
      directions[at].insert(2 * piece[3] + 1);
    }
    std::set<std::array<int, 3>> vertices, found;
    for (const auto& [at, set] : directions) {
      if (set.size() != 2 || *set.begin() / 2 != *set.rbegin() / 2) vertices.insert(at);
    }
    for (const SolidEdges::Vertex& vertex : solid.vertices) {
      const Vec3& p = vertex.position;
      found.insert({int(std::lround(p.x)), int(std::lround(p.y)), int(std::lround(p.z))});
    }
    ASSERT_EQ(found, vertices) << "seed " << seed << ": " << lattice.text();
  }
}

TEST(TreeValueOf, RandomChangesAgreeWithTheWholeTree) {
  // (0 + 1) · 2 − 3 − (0 · 4), where primitive 0 is named twice.
  csgcore::CsgTreeBuilder builder;
  builder.open(csgcore::Op::kDifference);
  builder.open(csgcore::Op::kIntersection);
  builder.open(csgcore::Op::kUnion);
  builder.primitive(0);
  builder.primitive(1);
  builder.close();
  builder.primitive(2);
  builder.close();
  builder.primitive(3);
  builder.open(csgcore::Op::kIntersection);
  builder.primitive(0);
  builder.primitive(4);
  builder.close();
  builder.close();
  TreeValue tree(builder.finish(), 5);
  std::mt19937 random(1);
  std::array<bool, 5> in{};
  for (int i = 0; i < 1000; ++i) {
    const uint32_t primitive = random() % 5;
    in[primitive] = random() % 2 == 0;
    tree.set(primitive, in[primitive]);
    const bool expected = (in[0] || in[1]) && in[2] && !in[3] && !(in[0] && in[4]);
    ASSERT_EQ(tree.value(), expected) << i;
  }
}

}  // namespace
}  // namespace frontend
