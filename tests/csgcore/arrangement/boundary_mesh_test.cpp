// Tests the mesh kernel: small solids whose meshes are known, random trees of polyhedra that touch
// (the full run has 10,000 of them; SCADRAY_TEST_TREES sets another number), and surfaces of
// coordinates that no design has.
#include "csgcore/boundary_mesh.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <limits>
#include <random>
#include <stop_token>

#include "arrangement/needed_facets.hpp"
#include "arrangement/separate_parts.hpp"
#include "arrangement/simple_surfaces.hpp"
#include "base/worker_threads.hpp"
#include "csgcore/facets.hpp"
#include "csgcore/stop_scope.hpp"
#include "support/full_run.hpp"
#include "support/mesh_judge.hpp"
#include "support/random_solids.hpp"
#include "support/test_meshes.hpp"

namespace {

using csgcore::BoundaryMesh;
using csgcore::CsgTree;
using csgcore::CsgTreeBuilder;
using csgcore::Op;
using csgcore::TriangleSet;
using csgcore::Vec3;
using test_support::box_parts;
using test_support::MeshParts;
using test_support::RandomSolid;

/// Returns what is wrong with a result as a mesh, or "".
std::string mesh_flaw(const BoundaryMesh& mesh) {
  if (mesh.operands.size() != mesh.triangles.size()) return "not every triangle has an operand";
  std::string flaw = test_support::manifold_flaw(mesh);
  if (flaw.empty() && test_support::flat_triangles(mesh) > 0) flaw = "a triangle has no area";
  if (flaw.empty()) flaw = test_support::crossing_flaw(mesh);
  return flaw;
}

std::vector<TriangleSet> surfaces_of(const std::vector<MeshParts>& operands) {
  std::vector<TriangleSet> surfaces;
  for (const MeshParts& operand : operands) surfaces.push_back(test_support::surface_of(operand));
  return surfaces;
}

/// Makes the mesh, and expects it to be sound and to be that of the tree along 300 lines.
BoundaryMesh sound_mesh(const std::vector<MeshParts>& operands, const CsgTree& tree,
                        double input_rounding = 0) {
  const std::vector<TriangleSet> surfaces = surfaces_of(operands);
  BoundaryMesh mesh = csgcore::boundary_mesh(surfaces, tree);
  EXPECT_EQ(mesh_flaw(mesh), "");
  if (testing::Test::HasFailure()) return mesh;
  test_support::LineTotals totals;
  const test_support::LineJudge judge(surfaces, tree, mesh, input_rounding);
  EXPECT_EQ(judge.flaw(300, 1, totals), "");
  return mesh;
}

/// One operation on all operands.
CsgTree flat_tree(Op op, uint32_t operands) {
  CsgTreeBuilder builder;
  builder.open(op);
  for (uint32_t i = 0; i < operands; ++i) builder.primitive(i);
  builder.close();
  return builder.finish();
}

/// Makes the mesh of it.
BoundaryMesh sound_mesh(Op op, const std::vector<MeshParts>& operands, double input_rounding = 0) {
  return sound_mesh(operands, flat_tree(op, uint32_t(operands.size())), input_rounding);
}

MeshParts box(const Vec3& min, const Vec3& size) { return box_parts(min, min + size); }
MeshParts cube(const Vec3& min, double side) { return box(min, Vec3(side)); }

struct Expected {
  size_t triangles, vertices;
  double volume, area;
};

void expect_mesh(const BoundaryMesh& mesh, const Expected& expected) {
  EXPECT_EQ(mesh.triangles.size(), expected.triangles);
  EXPECT_EQ(mesh.vertices.size(), expected.vertices);
  EXPECT_NEAR(double(test_support::volume_of(mesh)), expected.volume, 1e-12 * expected.volume);
  EXPECT_NEAR(double(test_support::area_of(mesh)), expected.area, 1e-12 * expected.area);
}

size_t triangles_of(const BoundaryMesh& mesh, uint32_t operand) {
  return size_t(std::count(mesh.operands.begin(), mesh.operands.end(), operand));
}

TEST(BoundaryMesh, OfACubeIsTheCube) {
  const BoundaryMesh mesh = sound_mesh(Op::kUnion, {cube({1, 2, 3}, 2)});
  expect_mesh(mesh, {12, 8, 8, 24});
  EXPECT_THAT(mesh.operands, testing::Each(0u));
  for (const Vec3& vertex : mesh.vertices) {
    EXPECT_THAT(cube({1, 2, 3}, 2).vertices, testing::Contains(vertex));
  }
}

TEST(BoundaryMesh, OfNothingIsEmpty) {
  const BoundaryMesh of_no_operand = csgcore::boundary_mesh({}, CsgTree());
  EXPECT_TRUE(of_no_operand.triangles.empty() && of_no_operand.vertices.empty());
  const std::vector<TriangleSet> cubes = surfaces_of({cube({0, 0, 0}, 1)});
  EXPECT_TRUE(csgcore::boundary_mesh(cubes, CsgTree()).triangles.empty());
}

TEST(BoundaryMesh, TakesOperandsWithoutTriangles) {
  expect_mesh(sound_mesh(Op::kUnion, {MeshParts(), cube({0, 0, 0}, 1)}), {12, 8, 1, 6});
  expect_mesh(sound_mesh(Op::kDifference, {cube({0, 0, 0}, 1), MeshParts()}), {12, 8, 1, 6});
  EXPECT_TRUE(sound_mesh(Op::kIntersection, {MeshParts(), cube({0, 0, 0}, 1)}).triangles.empty());
  EXPECT_TRUE(sound_mesh(Op::kUnion, {MeshParts(), MeshParts()}).vertices.empty());
}

TEST(BoundaryMesh, LeavesOutOperandsThatTheTreeDoesNotName) {
  CsgTreeBuilder builder;
  builder.primitive(1);
  const BoundaryMesh mesh =
      sound_mesh({cube({0, 0, 0}, 8), cube({0, 0, 0}, 1), cube({0, 0, 0}, 2)}, builder.finish());
  expect_mesh(mesh, {12, 8, 1, 6});
  EXPECT_THAT(mesh.operands, testing::Each(1u));
}

TEST(BoundaryMesh, FlushCubesShareNoFace) {
  const BoundaryMesh mesh = sound_mesh(Op::kUnion, {cube({0, 0, 0}, 1), cube({1, 0, 0}, 1)});
  expect_mesh(mesh, {20, 12, 2, 10});
  EXPECT_EQ(triangles_of(mesh, 0), 10u);
  EXPECT_EQ(triangles_of(mesh, 1), 10u);
}

TEST(BoundaryMesh, ASmallerFlushCubeOpensAFace) {
  expect_mesh(sound_mesh(Op::kUnion, {cube({0, 0, 0}, 3), cube({1, 1, 3}, 1)}), {28, 16, 28, 58});
  // Its side is flush as well.
  const BoundaryMesh corner = sound_mesh(Op::kUnion, {cube({0, 0, 0}, 2), cube({0, 0, 2}, 1)});
  EXPECT_EQ(double(test_support::volume_of(corner)), 9);
  EXPECT_EQ(double(test_support::area_of(corner)), 28);
}

TEST(BoundaryMesh, AFlushCutIsOpen) {
  const BoundaryMesh half =
      sound_mesh(Op::kDifference, {cube({0, 0, 0}, 2), box({1, 0, 0}, {1, 2, 2})});
  expect_mesh(half, {12, 8, 4, 16});
  EXPECT_EQ(triangles_of(half, 0), 10u);
  EXPECT_EQ(triangles_of(half, 1), 2u);
  // A hole from one side to the other.
  expect_mesh(sound_mesh(Op::kDifference, {cube({0, 0, 0}, 3), box({1, 1, 0}, {1, 1, 3})}),
              {32, 16, 24, 64});
}

TEST(BoundaryMesh, CubesThatTouchStaySeparate) {
  // At an edge, at a part of an edge, and at a vertex.
  expect_mesh(sound_mesh(Op::kUnion, {cube({0, 0, 0}, 1), cube({1, 1, 0}, 1)}), {24, 16, 2, 12});
  const BoundaryMesh longer =
      sound_mesh(Op::kUnion, {cube({0, 0, 0}, 1), box({1, 1, -1}, {1, 1, 3})});
  EXPECT_EQ(double(test_support::volume_of(longer)), 4);
  EXPECT_EQ(double(test_support::area_of(longer)), 20);
  expect_mesh(sound_mesh(Op::kUnion, {cube({0, 0, 0}, 1), cube({1, 1, 1}, 1)}), {24, 16, 2, 12});
}

TEST(BoundaryMesh, OpposedCornersOfACubeTouch) {
  // What is left of a cube touches itself along an edge that ends within the solid.
  const BoundaryMesh mesh =
      sound_mesh(Op::kDifference, {cube({0, 0, 0}, 4), cube({0, 0, 2}, 2), cube({2, 2, 2}, 2)});
  EXPECT_EQ(double(test_support::volume_of(mesh)), 48);
  EXPECT_EQ(double(test_support::area_of(mesh)), 96);
}

TEST(BoundaryMesh, AnApexTouchesAFace) {
  const MeshParts pyramid{{{1, 1, 1}, {0, 0, 3}, {2, 0, 3}, {2, 2, 3}, {0, 2, 3}},
                          {{0, 2, 1}, {0, 3, 2}, {0, 4, 3}, {0, 1, 4}, {1, 2, 3}, {1, 3, 4}}};
  const BoundaryMesh mesh = sound_mesh(Op::kUnion, {box({-1, -1, 0}, {4, 4, 1}), pyramid});
  EXPECT_NEAR(double(test_support::volume_of(mesh)), 16 + 8 / 3.0, 1e-12);
}

TEST(BoundaryMesh, OfEqualCubes) {
  const std::vector<MeshParts> cubes{cube({0, 0, 0}, 1), cube({0, 0, 0}, 1)};
  for (const Op op : {Op::kUnion, Op::kIntersection}) {
    const BoundaryMesh mesh = sound_mesh(op, cubes);
    expect_mesh(mesh, {12, 8, 1, 6});
    EXPECT_THAT(mesh.operands, testing::Each(1u));
  }
  const BoundaryMesh difference = sound_mesh(Op::kDifference, cubes);
  EXPECT_TRUE(difference.triangles.empty());
  EXPECT_TRUE(difference.vertices.empty());
}

TEST(BoundaryMesh, LeavesNothingOfWhatRoundingFlattens) {
  constexpr double kThin = 1e-13;
  const MeshParts prism =
      test_support::fan_prism_parts({{-2, 0}, {-1, -2}, {1, -2}, {2, 0}, {1, 2}, {-1, 2}}, 2);
  const MeshParts plate = box_parts({-1, 0, 2}, {-1 + kThin, 1, 3});
  MeshParts roof = box_parts({0, 1, 1}, {3, 4, 1 + kThin});
  for (Vec3& vertex : roof.vertices) {  // its sides are in the same plane, too
    if (vertex.z > 1) vertex = {1 + vertex.x / 3, 2 + vertex.y / 3, vertex.z};
  }
  for (const MeshParts& thin : {plate, roof}) {
    std::vector<TriangleSet> surfaces = surfaces_of({prism, thin});
    surfaces[1].is_simple = true;
    expect_mesh(csgcore::boundary_mesh(surfaces, flat_tree(Op::kUnion, 2)),
                {20, 12, 24, 24 + 2 * (4 + 4 * std::sqrt(5.0))});
  }
}

TEST(BoundaryMesh, OfFacesThatTouchIntersectedIsEmpty) {
  EXPECT_TRUE(
      sound_mesh(Op::kIntersection, {cube({0, 0, 0}, 1), cube({1, 0, 0}, 1)}).triangles.empty());
}

TEST(BoundaryMesh, KeepsNestedCavities) {
  CsgTreeBuilder builder;
  builder.open(Op::kDifference);
  builder.open(Op::kUnion);
  builder.open(Op::kDifference);
  builder.primitive(0);
  builder.primitive(1);
  builder.close();
  builder.primitive(2);
  builder.close();
  builder.primitive(3);
  builder.close();
  const BoundaryMesh mesh =
      sound_mesh({cube(Vec3(-5), 10), cube(Vec3(-4), 8), cube(Vec3(-2), 4), cube(Vec3(-1), 2)},
                 builder.finish());
  expect_mesh(mesh, {48, 32, 1000 - 512 + 64 - 8, 6 * (100 + 64 + 16 + 4)});
  for (uint32_t operand = 0; operand < 4; ++operand) EXPECT_EQ(triangles_of(mesh, operand), 12u);
}

TEST(BoundaryMesh, TurnsAnOperandThatIsInsideOut) {
  expect_mesh(sound_mesh(Op::kUnion, {cube({0, 0, 0}, 1).inside_out()}), {12, 8, 1, 6});
  expect_mesh(sound_mesh(Op::kDifference, {cube({0, 0, 0}, 4), cube({1, 1, 1}, 2).inside_out()}),
              {24, 16, 56, 120});
}

TEST(BoundaryMesh, OfAnOperandThatCrossesItselfIsWhereItWinds) {
  // An hourglass, whose halves turn in different directions and meet in an edge.
  const BoundaryMesh hourglass = sound_mesh(
      Op::kUnion, {test_support::fan_prism_parts({{-2, -2}, {2, 2}, {2, -2}, {-2, 2}}, 1)});
  expect_mesh(hourglass, {16, 12, 8, 16 + 8 + 8 * std::sqrt(2.0)});
  // A loop that surrounds a square twice.
  const BoundaryMesh loop = sound_mesh(
      Op::kUnion, {test_support::fan_prism_parts(
                      {{-2, -2}, {4, -2}, {4, 4}, {0, 4}, {0, 0}, {2, 0}, {2, 2}, {-2, 2}}, 1)});
  expect_mesh(loop, {20, 12, 32, 64 + 24});
}

TEST(BoundaryMesh, UnitesTheShellsOfAnOperand) {
  const MeshParts apart = test_support::joined({cube({0, 0, 0}, 2), cube({1, 1, 1}, 2)});
  EXPECT_NEAR(double(test_support::volume_of(sound_mesh(Op::kUnion, {apart}))), 15, 1e-12);
  const MeshParts twice = test_support::joined({cube({0, 0, 0}, 2), cube({0, 0, 0}, 2)});
  expect_mesh(sound_mesh(Op::kUnion, {twice}), {12, 8, 8, 24});
  const MeshParts none =
      test_support::joined({cube({0, 0, 0}, 2), cube({0, 0, 0}, 2).inside_out()});
  EXPECT_TRUE(sound_mesh(Op::kUnion, {none}).triangles.empty());
}

/// Three cubes in each direction, side by side.
std::vector<MeshParts> cubes_of_a_grid() {
  std::vector<MeshParts> cubes;
  for (int i = 0; i < 27; ++i) cubes.push_back(cube(Vec3(i % 3, i / 3 % 3, i / 9), 1));
  return cubes;
}

TEST(BoundaryMesh, AGridOfFlushShellsIsABox) {
  MeshParts grid;
  for (const MeshParts& one : cubes_of_a_grid()) grid.add(one);
  expect_mesh(sound_mesh(Op::kUnion, {grid}), {12, 8, 27, 54});
}

TEST(BoundaryMesh, AGridOfFlushCubesIsABoxOfTheirFaces) {
  const BoundaryMesh mesh = sound_mesh(Op::kUnion, cubes_of_a_grid());
  expect_mesh(mesh, {108, 56, 27, 54});
  EXPECT_EQ(triangles_of(mesh, 13), 0u);  // the one in the middle
  EXPECT_EQ(triangles_of(mesh, 0), 6u);
}

TEST(BoundaryMesh, KeepsPartsThatAreApart) {
  std::vector<MeshParts> cubes;
  for (int i = 0; i < 1000; ++i) {
    cubes.push_back(cube(2.0 * Vec3(i % 10, i / 10 % 10, i / 100), 1));
  }
  expect_mesh(sound_mesh(Op::kUnion, cubes), {12'000, 8'000, 1'000, 6'000});
}

TEST(BoundaryMesh, RoundsPartsThatAreApartByThemselves) {
  // On a grid for all of them the small ones would be off by a thousandth of their size.
  constexpr double kSide = 1e-3;
  CsgTreeBuilder builder;
  builder.primitive(0);
  builder.open(Op::kDifference);
  builder.primitive(1);
  builder.primitive(2);
  builder.close();
  const std::vector<MeshParts> operands{cube({0, 0, 0}, 1e6), cube({-2, 0.3, 0.7}, kSide),
                                        cube({-2 + kSide / 3, 0.3, 0.7}, kSide)};
  BoundaryMesh mesh = csgcore::boundary_mesh(surfaces_of(operands), builder.finish());
  EXPECT_EQ(test_support::manifold_flaw(mesh), "");
  TriangleSet small{mesh.vertices, {}};
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (mesh.operands[t] != 0) small.triangles.push_back(mesh.triangles[t]);
  }
  EXPECT_EQ(small.triangles.size(), 12u);
  const double volume = kSide * kSide * kSide / 3;
  EXPECT_NEAR(double(test_support::volume_of(small)), volume, 1e-9 * volume);
}

/// Returns the operands of each part of the union.
std::vector<std::vector<uint32_t>> parts_of_union(const std::vector<MeshParts>& operands) {
  CsgTreeBuilder builder;
  for (uint32_t i = 0; i < operands.size(); ++i) builder.primitive(i);
  std::vector<std::vector<uint32_t>> result;
  for (const auto& part : csgcore::separate_parts(surfaces_of(operands), builder.finish())) {
    EXPECT_EQ(part.tokens.size(), part.operands.size() + (part.operands.size() > 1 ? 1 : 0));
    result.push_back(part.operands);
  }
  return result;
}

TEST(SeparateParts, AreFoundAlongEachAxis) {
  using testing::ElementsAre;
  // The long box bars the way along x until y has parted it from the others.
  EXPECT_THAT(parts_of_union({cube({4, 0, 0}, 1), box({0, 5, 0}, {9, 1, 1}), cube({1, 0, 0}, 1),
                              cube({1, 0, 3}, 1), cube({1.5, 0.5, 3.5}, 1)}),
              ElementsAre(ElementsAre(0u), ElementsAre(1u), ElementsAre(2u), ElementsAre(3u, 4u)));
}

TEST(SeparateParts, OfBoxesThatTouchAreOne) {
  using testing::ElementsAre;
  const double gap = 0x1p-40;
  EXPECT_THAT(parts_of_union({cube({0, 0, 0}, 1), cube({1, 0, 0}, 1)}),
              ElementsAre(ElementsAre(0u, 1u)));
  EXPECT_THAT(parts_of_union({cube({0, 0, 0}, 1), cube({1 + gap, 0, 0}, 1)}),
              ElementsAre(ElementsAre(0u, 1u)));
}

TEST(SeparateParts, HaveTheBoxOfWhatIsNotSubtracted) {
  CsgTreeBuilder builder;
  builder.open(Op::kDifference);
  builder.primitive(0);
  builder.primitive(1);
  builder.close();
  builder.open(Op::kIntersection);
  builder.primitive(2);
  builder.primitive(1);
  builder.close();
  builder.open(Op::kIntersection);
  builder.primitive(0);
  builder.primitive(2);
  builder.close();
  const auto parts = csgcore::separate_parts(
      surfaces_of({cube({0, 0, 0}, 1), cube({-9, -9, -9}, 99), cube({5, 0, 0}, 1)}),
      builder.finish());
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_THAT(parts[0].operands, testing::ElementsAre(0u, 1u));
  EXPECT_THAT(parts[1].operands, testing::ElementsAre(1u, 2u));
  EXPECT_EQ(parts[1].tokens[0].value, 1u);
  EXPECT_EQ(parts[1].tokens[1].value, 0u);
  EXPECT_EQ(parts[1].tokens[2].op, Op::kIntersection);
}

/// Operands on the grid, and what of them is found before any two facets are compared.
struct Placed {
  Placed(const std::vector<MeshParts>& operands, const CsgTree& tree)
      : surfaces(surfaces_of(operands)),
        facets(csgcore::facets_on_grid(pointers())),
        may_cross(csgcore::find_simple_surfaces(pointers(), facets)),
        trees(facets, operands.size()),
        covers(facets, trees, tree.tokens(), may_cross) {}

  std::vector<const TriangleSet*> pointers() const {
    std::vector<const TriangleSet*> result;
    for (const TriangleSet& surface : surfaces) result.push_back(&surface);
    return result;
  }

  std::vector<TriangleSet> surfaces;
  csgcore::Facets facets;
  std::vector<bool> may_cross;
  csgcore::FacetTrees trees;
  csgcore::Covers covers;
};

struct Needed {
  std::vector<size_t> facets;   // by operand
  std::vector<size_t> patches;  // by operand
};

Needed patches_of(const std::vector<MeshParts>& operands, const CsgTree& tree) {
  const Placed placed(operands, tree);
  const csgcore::NeededFacets needed =
      csgcore::needed_facets(placed.facets, placed.trees, placed.covers, placed.may_cross);
  Needed result{std::vector<size_t>(operands.size()), std::vector<size_t>(operands.size())};
  for (uint32_t i = 0; i < needed.first_of.size(); ++i) {
    if (needed.first_of[i] != csgcore::kNoPlace) ++result.facets[placed.facets.facets[i].operand];
  }
  for (const uint32_t first : needed.firsts) ++result.patches[placed.facets.facets[first].operand];
  return result;
}

/// Returns how many facets of each operand are needed.
std::vector<size_t> needed_of(const std::vector<MeshParts>& operands, const CsgTree& tree) {
  return patches_of(operands, tree).facets;
}

TEST(NeededFacets, AreThoseThatNoOtherOperandDecides) {
  using testing::ElementsAre;
  // A cube; a ball whose half is outside; one within that ball; one away from the cube.
  const std::vector<MeshParts> parts{cube(Vec3(-5), 10),
                                     test_support::icosphere_parts(3, 3).moved({5, 0.1, 0.2}),
                                     test_support::icosphere_parts(1, 1).moved({4, 0.1, 0.2}),
                                     test_support::icosphere_parts(1, 1).moved({9, 0.1, 0.2})};
  const size_t all = parts[1].triangles.size();
  const std::vector<size_t> minus = needed_of(parts, flat_tree(Op::kDifference, 4));
  EXPECT_THAT(
      minus,
      ElementsAre(12u, testing::AllOf(testing::Gt(all / 2), testing::Lt(all * 2 / 3)), 0u, 0u));
  const std::vector<size_t> together = needed_of(parts, flat_tree(Op::kUnion, 4));
  EXPECT_EQ(together[1], minus[1]);
  EXPECT_EQ(together[2], 0u);
  EXPECT_EQ(together[3], parts[3].triangles.size());
  EXPECT_THAT(needed_of(parts, flat_tree(Op::kIntersection, 4)), ElementsAre(0u, 0u, 0u, 0u));
}

TEST(NeededFacets, AreOnePatchWhereNoOtherSurfaceComesNear) {
  using testing::ElementsAre;
  // A ball that a thin board divides: both halves, and each facet near the board by itself.
  const std::vector<MeshParts> parts{test_support::icosphere_parts(3, 4),
                                     box(Vec3(-5, -5, 0.1), Vec3(10, 10, 0.1)), cube(Vec3(20), 1)};
  const Needed needed = patches_of(parts, flat_tree(Op::kUnion, 3));
  EXPECT_EQ(needed.facets[0], parts[0].triangles.size());
  EXPECT_GT(needed.patches[0], 2u);
  EXPECT_LT(needed.patches[0], needed.facets[0] / 4);
  EXPECT_EQ(needed.patches[2], 1u);
  // None of a surface that may cross itself.
  const std::vector<MeshParts> twice{
      test_support::joined({test_support::icosphere_parts(3, 1),
                            test_support::icosphere_parts(3, 1).moved({1, 0.1, 0.2})})};
  const Needed crossing = patches_of(twice, flat_tree(Op::kUnion, 1));
  EXPECT_EQ(crossing.patches[0], twice[0].triangles.size());
}

TEST(NeededFacets, AreThoseOfOperandsThatTheTreeHasTwice) {
  // What is within the ball that is subtracted is added, too.
  CsgTreeBuilder builder;
  builder.open(Op::kUnion);
  builder.primitive(2);
  builder.open(Op::kDifference);
  builder.primitive(0);
  builder.primitive(1);
  builder.primitive(2);
  builder.close();
  builder.close();
  const BoundaryMesh mesh =
      sound_mesh({cube(Vec3(-5), 10), cube(Vec3(-3), 6), cube(Vec3(-1), 2)}, builder.finish());
  EXPECT_EQ(double(test_support::volume_of(mesh)), 1000 - 216 + 8);
}

/// A solid of twenty faces. One is at (1, 1, 1)·0.46·radius, and the origin is in its box's corner.
MeshParts icosahedron(const Vec3& center, double radius) {
  return test_support::icosphere_parts(radius, 0).moved(center);
}

TEST(NeededFacets, AreNotThoseBehindAllFacesOfAnother) {
  // The box of a face of the large one holds the small one.
  const std::vector<MeshParts> parts{icosahedron(Vec3(0), 9), icosahedron(Vec3(3.2), 1)};
  EXPECT_THAT(needed_of(parts, flat_tree(Op::kUnion, 2)), testing::ElementsAre(20u, 0u));
  EXPECT_THAT(needed_of(parts, flat_tree(Op::kDifference, 2)), testing::ElementsAre(20u, 20u));
}

TEST(NeededFacets, AreNotThoseBesideTheFacesOfAnother) {
  // The box of a face of the large one holds the small one, which lies beyond the face's plane.
  const std::vector<MeshParts> parts{icosahedron(Vec3(0), 9), icosahedron(Vec3(4.8), 0.3)};
  EXPECT_THAT(needed_of(parts, flat_tree(Op::kDifference, 2)), testing::ElementsAre(20u, 0u));
}

TEST(Covers, HideWhatAnOperandHoldsThatDecidesBothOthers) {
  using Ends = std::array<Vec3, 2>;
  const std::vector<MeshParts> parts{icosahedron(Vec3(0), 9), icosahedron({3, 0, 0}, 6),
                                     icosahedron({0, 3, 0}, 6),
                                     test_support::icosphere_parts(8.5, 3)};
  const auto hides = [&](const CsgTree& tree, Ends ends, uint32_t a, uint32_t b) {
    const Placed placed(parts, tree);
    for (Vec3& end : ends) end = (end - placed.facets.middle) * placed.facets.scale;
    uint32_t last = csgcore::kNoPlace;
    return placed.covers.hide(ends, a, b, last);
  };
  const Ends inside{Vec3(0.5, 0.5, -4), Vec3(1, 1, 4)};
  const Ends across{Vec3(0.5, 0.5, -4), Vec3(9, 0.5, 4)};
  const CsgTree together = flat_tree(Op::kUnion, 4);
  EXPECT_TRUE(hides(together, inside, 1, 2)) << "the first and the ball hold it";
  EXPECT_FALSE(hides(together, across, 1, 2));
  const Ends in_ball{Vec3(4.3), Vec3(4.4, 4.3, 4.2)};
  EXPECT_TRUE(hides(together, in_ball, 0, 1)) << "only the ball, of 1,280 facets, holds it";
  EXPECT_FALSE(hides(together, in_ball, 0, 3)) << "no other than these holds it";
  // (0 − 3) ∪ (1 ∩ 2): what 0 holds decides nothing.
  CsgTreeBuilder builder;
  builder.open(Op::kUnion);
  builder.open(Op::kDifference);
  builder.primitive(0);
  builder.primitive(3);
  builder.close();
  builder.open(Op::kIntersection);
  builder.primitive(1);
  builder.primitive(2);
  builder.close();
  builder.close();
  const CsgTree nested = builder.finish();
  EXPECT_FALSE(hides(nested, inside, 1, 2));
  EXPECT_FALSE(hides(nested, inside, 0, 1)) << "the ball decides the first alone";
  EXPECT_TRUE(hides(nested, inside, 0, 0));
}

TEST(BoundaryMesh, SubtractsAllFurtherOperands) {
  const BoundaryMesh mesh =
      sound_mesh(Op::kDifference, {box({0, 0, 0}, {6, 2, 2}), cube({1, 1, 1}, 1),
                                   cube({3, 1, 1}, 1), cube({4, 1, 1}, 1), cube({9, 9, 9}, 1)});
  EXPECT_EQ(double(test_support::volume_of(mesh)), 21);
  EXPECT_EQ(triangles_of(mesh, 4), 0u);
}

TEST(BoundaryMesh, NamesTheLastOfCoincidentFaces) {
  // Three boxes whose tops lie in one plane. Each overlaps the next by one unit.
  const BoundaryMesh mesh =
      sound_mesh(Op::kUnion,
                 {box({0, 0, 0}, {2, 2, 4}), box({1, 0, 1}, {2, 2, 3}), box({2, 0, 2}, {2, 2, 2})});
  double area[3] = {};
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    TriangleSet one{mesh.vertices, {mesh.triangles[t]}};
    const bool is_top = std::ranges::all_of(
        mesh.triangles[t], [&](uint32_t corner) { return mesh.vertices[corner].z == 4; });
    ASSERT_LT(mesh.operands[t], 3u);
    if (is_top) area[mesh.operands[t]] += double(test_support::area_of(one));
  }
  EXPECT_EQ(area[0], 2);
  EXPECT_EQ(area[1], 2);
  EXPECT_EQ(area[2], 4);
}

TEST(BoundaryMesh, KeepsWallsOfABillionth) {
  constexpr double kThin = 0x1p-30;
  const BoundaryMesh wall =
      sound_mesh(Op::kDifference, {cube({0, 0, 0}, 1), box({0, 0, 0}, {1 - kThin, 1, 1})});
  expect_mesh(wall, {12, 8, kThin, 2 + 4 * kThin});
  const BoundaryMesh gap = sound_mesh(Op::kUnion, {cube({0, 0, 0}, 1), cube({1 + kThin, 0, 0}, 1)});
  expect_mesh(gap, {24, 16, 2, 12});
}

TEST(BoundaryMesh, OfSpheresAndCylinders) {
  const MeshParts ball = test_support::parts_of(csgcore::sphere_mesh(10, 24));
  const MeshParts rod = test_support::parts_of(csgcore::frustum_mesh(-20, 20, 4, 4, 24));
  constexpr double kRounding = 20 * 0x1p-39;
  for (const Op op : {Op::kUnion, Op::kIntersection, Op::kDifference}) {
    EXPECT_FALSE(sound_mesh(op, {ball, rod}, kRounding).triangles.empty());
    EXPECT_FALSE(sound_mesh(op, {rod, ball}, kRounding).triangles.empty());
  }
  const BoundaryMesh moved =
      sound_mesh(Op::kDifference, {ball, ball.moved({0.001, 0, 0})}, kRounding);
  EXPECT_GT(test_support::volume_of(moved), 0);
}

TEST(BoundaryMesh, CountsOpenEdges) {
  const auto edges = [](const MeshParts& parts) {
    return csgcore::open_edges(test_support::surface_of(parts));
  };
  EXPECT_EQ(edges(MeshParts()), 0u);
  EXPECT_EQ(edges(cube({0, 0, 0}, 1)), 0u);
  EXPECT_EQ(edges(test_support::joined({cube({0, 0, 0}, 1), cube({0, 0, 0}, 1)})), 0u);
  EXPECT_EQ(edges(test_support::open_box_parts(Vec3(0), Vec3(1))), 4u);
  MeshParts turned = cube({0, 0, 0}, 1);
  std::swap(turned.triangles[0][1], turned.triangles[0][2]);
  EXPECT_EQ(edges(turned), 3u);
}

TEST(BoundaryMesh, StopsWhenAsked) {
  const std::vector<TriangleSet> balls = surfaces_of(
      {test_support::icosphere_parts(2, 4), test_support::icosphere_parts(2, 4).moved({1, 0, 0})});
  CsgTreeBuilder builder;
  builder.primitive(0);
  builder.primitive(1);
  std::stop_source source;
  source.request_stop();
  const std::stop_token token = source.get_token();
  const csgcore::StopScope scope(&token);
  EXPECT_THROW(csgcore::boundary_mesh(balls, builder.finish()), csgcore::Stopped);
}

bool same_bytes(const BoundaryMesh& a, const BoundaryMesh& b) {
  return a.triangles == b.triangles && a.operands == b.operands &&
         a.vertices.size() == b.vertices.size() &&
         std::memcmp(a.vertices.data(), b.vertices.data(), a.vertices.size() * sizeof(Vec3)) == 0;
}

BoundaryMesh mesh_by(unsigned threads, const std::vector<TriangleSet>& operands,
                     const CsgTree& tree) {
  BoundaryMesh mesh;
  csgcore::with_threads(threads, [&] { mesh = csgcore::boundary_mesh(operands, tree); });
  return mesh;
}

TEST(BoundaryMesh, OfAnyNumberOfThreadsIsTheSame) {
  std::vector<MeshParts> parts{test_support::icosphere_parts(10, 4)};
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-8, 8);
  for (int i = 0; i < 40; ++i) {
    parts.push_back(test_support::icosphere_parts(3, 2).moved(
        {uniform(random), uniform(random), uniform(random)}));
  }
  const std::vector<TriangleSet> operands = surfaces_of(parts);
  CsgTreeBuilder builder;
  builder.open(Op::kDifference);
  for (uint32_t i = 0; i < operands.size(); ++i) builder.primitive(i);
  builder.close();
  const CsgTree tree = builder.finish();
  const BoundaryMesh by_one = mesh_by(1, operands, tree);
  EXPECT_EQ(mesh_flaw(by_one), "");
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(same_bytes(by_one, mesh_by(2, operands, tree)));
}

// Random trees.

constexpr uint32_t kParts = 10;  // so that they run side by side
constexpr uint32_t kFullTrees = 10'000;
constexpr uint32_t kSampleTrees = 400;

uint32_t trees_of_a_part() {
  if (const char* trees = std::getenv("SCADRAY_TEST_TREES")) {
    return uint32_t(std::strtoul(trees, nullptr, 10)) / kParts;
  }
  return (test_support::full_run() ? kFullTrees : test_support::sample_size(kSampleTrees)) / kParts;
}

uint32_t lines_of_a_tree() { return test_support::full_run() ? 250 : 60; }

std::string tree_flaw(const RandomSolid& solid, uint32_t seed, test_support::LineTotals& totals) {
  const std::vector<TriangleSet> operands = solid.surfaces();
  const CsgTree tree = solid.tree();
  const BoundaryMesh mesh = csgcore::boundary_mesh(operands, tree);
  std::string flaw = mesh_flaw(mesh);
  if (!flaw.empty()) return flaw;
  flaw = test_support::LineJudge(operands, tree, mesh).flaw(lines_of_a_tree(), seed, totals);
  if (!flaw.empty()) return flaw;
  const BoundaryMesh by_one = mesh_by(1, operands, tree), by_two = mesh_by(2, operands, tree);
  if (!same_bytes(by_one, mesh) || !same_bytes(by_one, by_two)) return "threads made a difference";
  return "";
}

TEST(RandomBoundaryMesh, IsRightWhereItWasNot) {
  test_support::LineTotals totals;
  // Two shells that have edges in common; an edge that runs on past a cut into a face; needles that
  // the judge did not measure well; a face's corner on an edge of a face that nothing meets there.
  for (const uint32_t seed : {2831u, 9256u, 9194u, 2701u}) {
    EXPECT_EQ(tree_flaw(test_support::random_solid(seed), seed, totals), "") << seed;
  }
}

class RandomBoundaryMeshes : public testing::TestWithParam<uint32_t> {};

TEST_P(RandomBoundaryMeshes, AreSoundAndRight) {
  test_support::LineTotals totals;
  const uint32_t trees = trees_of_a_part();
  for (uint32_t i = 0; i < trees; ++i) {
    const uint32_t seed = 1 + GetParam() + kParts * i;
    const RandomSolid solid = test_support::random_solid(seed);
    const std::string flaw = tree_flaw(solid, seed, totals);
    if (flaw.empty()) continue;
    test_support::LineTotals unused;
    const RandomSolid smallest = test_support::minimised(solid, [&](const RandomSolid& smaller) {
      return !tree_flaw(smaller, seed, unused).empty();
    });
    ADD_FAILURE() << "tree " << seed << ": " << flaw
                  << "\nsmallest: " << tree_flaw(smallest, seed, unused) << "\n"
                  << smallest.as_openscad();
    if (!test_support::full_run()) return;
  }
  const auto number = [](uint64_t n) { return static_cast<unsigned long long>(n); };
  std::printf(
      "%u trees, %llu lines, %llu undecided; %llu points, %llu inside; %llu faces, %llu of them "
      "coincident, %llu not the last\n",
      trees, number(totals.lines), number(totals.undecided), number(totals.points),
      number(totals.points_inside), number(totals.faces), number(totals.coincident),
      number(totals.not_last));
  EXPECT_LE(totals.undecided, totals.lines / 100);
  EXPECT_GT(totals.points_inside, totals.lines / 20);
}

INSTANTIATE_TEST_SUITE_P(, RandomBoundaryMeshes, testing::Range(0u, kParts));

// Coordinates that no design has.

/// Returns a number that is ordinary, huge, tiny, denormal, or one of a few that come often.
double odd_number(std::mt19937& random) {
  constexpr double kOften[] = {0,      -0.0,    1,     -1,     0.5,      1e-300,
                               5e-324, -5e-324, 1e300, -1e300, 0x1p-1022};
  std::uniform_real_distribution<double> uniform(-1, 1);
  switch (random() % 6) {
    case 0:
      return uniform(random);
    case 1:
      return std::ldexp(uniform(random), int(random() % 2100) - 1070);
    case 2:
      return random() % 2 ? std::numeric_limits<double>::max()
                          : std::numeric_limits<double>::lowest();
    default:
      return kOften[random() % std::size(kOften)];
  }
}

MeshParts odd_surface(std::mt19937& random) {
  MeshParts parts;
  switch (random() % 4) {
    case 0:
      parts = cube({0, 0, 0}, 1);
      break;
    case 1:
      parts = test_support::icosphere_parts(1, random() % 2);
      break;
    case 2:
      parts = test_support::torus_parts(2, 1, 3 + random() % 3, 3);
      break;
    default:
      parts = test_support::tetrahedron_parts(1);
  }
  // Moderate numbers as well, since a single huge one rounds all others to nothing.
  const bool is_moderate = random() % 2 == 0;
  const size_t changes = random() % (parts.vertices.size() + 1);
  for (size_t i = 0; i < changes; ++i) {
    Vec3& vertex = parts.vertices[random() % parts.vertices.size()];
    if (random() % 4 == 0) {
      vertex = parts.vertices[random() % parts.vertices.size()];
      continue;
    }
    double number = odd_number(random);
    if (is_moderate && !(std::abs(number) < 1e3)) number = std::copysign(3.0, number);
    vertex[int(random() % 3)] = number;
  }
  return parts;
}

/// Returns the number of inputs, of the hundred thousand that a full run has.
uint32_t odd_inputs() {
  return test_support::full_run() ? 100'000 : test_support::sample_size(1'500);
}

TEST(BoundaryMeshOfOddNumbers, IsAClosedSurface) {
  for (uint32_t seed = 1; seed <= odd_inputs(); ++seed) {
    std::mt19937 random(seed);
    std::vector<MeshParts> parts;
    for (uint32_t i = 0, count = 1 + random() % 4; i < count; ++i) {
      parts.push_back(odd_surface(random));
    }
    const std::vector<TriangleSet> operands = surfaces_of(parts);
    CsgTreeBuilder builder;
    builder.open(random() % 2 ? Op::kDifference : Op::kUnion);
    for (uint32_t i = 0; i < operands.size(); ++i) builder.primitive(i);
    builder.close();
    const BoundaryMesh mesh = csgcore::boundary_mesh(operands, builder.finish());
    ASSERT_EQ(mesh.operands.size(), mesh.triangles.size());
    ASSERT_EQ(test_support::manifold_flaw(mesh), "") << "seed " << seed;
  }
}

TEST(BoundaryMeshOfOddNumbers, SurvivesSurfacesThatAreOpen) {
  for (uint32_t seed = 1; seed <= odd_inputs(); ++seed) {
    std::mt19937 random(seed);
    std::vector<TriangleSet> operands;
    for (uint32_t i = 0, count = 1 + random() % 3; i < count; ++i) {
      TriangleSet surface = test_support::surface_of(odd_surface(random));
      for (auto& triangle : surface.triangles) {
        if (random() % 4 == 0)
          triangle[random() % 3] = uint32_t(random() % surface.vertices.size());
      }
      if (random() % 2) surface.triangles.pop_back();
      operands.push_back(std::move(surface));
    }
    CsgTreeBuilder builder;
    builder.open(random() % 2 ? Op::kDifference : Op::kUnion);
    for (uint32_t i = 0; i < operands.size(); ++i) builder.primitive(i);
    builder.close();
    const BoundaryMesh mesh = csgcore::boundary_mesh(operands, builder.finish());
    ASSERT_EQ(mesh.operands.size(), mesh.triangles.size());
    for (const auto& triangle : mesh.triangles) {
      ASSERT_THAT(triangle, testing::Each(testing::Lt(mesh.vertices.size())));
    }
  }
}

}  // namespace
