// Tests the judge of meshes on meshes that are right, and on such that are wrong in one way.
#include "mesh_judge.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <utility>

#include "random_solids.hpp"

namespace {

using csgcore::BoundaryMesh;
using csgcore::CsgTree;
using csgcore::CsgTreeBuilder;
using csgcore::Op;
using csgcore::TriangleSet;
using csgcore::Vec3;
using test_support::box_parts;
using test_support::joined;
using test_support::LineJudge;
using test_support::LineTotals;
using test_support::MeshParts;
using test_support::surface_of;
using testing::HasSubstr;

MeshParts cube(const Vec3& min, double side) { return box_parts(min, min + side); }

CsgTree tree_of_two(Op op) {
  CsgTreeBuilder builder;
  builder.open(op);
  builder.primitive(0);
  builder.primitive(1);
  builder.close();
  return builder.finish();
}

/// A mesh of some surfaces, each of which names an operand.
BoundaryMesh mesh_of(const std::vector<std::pair<MeshParts, uint32_t>>& surfaces) {
  MeshParts all;
  BoundaryMesh mesh;
  for (const auto& [parts, operand] : surfaces) {
    all.add(parts);
    mesh.operands.resize(all.triangles.size(), operand);
  }
  static_cast<TriangleSet&>(mesh) = surface_of(all);
  return mesh;
}

/// Returns what the judge says along 1,000 lines.
std::string flaw(Op op, const std::vector<MeshParts>& operands, const BoundaryMesh& mesh) {
  std::vector<TriangleSet> surfaces;
  for (const MeshParts& operand : operands) surfaces.push_back(surface_of(operand));
  const CsgTree tree = tree_of_two(op);
  LineTotals totals;
  return LineJudge(surfaces, tree, mesh).flaw(1000, 1, totals);
}

TEST(MeshJudge, SeesSurfacesThatAreNoManifold) {
  const MeshParts whole = cube(Vec3(0), 1);
  EXPECT_EQ(test_support::manifold_flaw(surface_of(whole)), "");
  EXPECT_EQ(test_support::manifold_flaw(surface_of(joined({whole, cube(Vec3(1, 1, 0), 1)}))), "");
  MeshParts open = whole;
  open.triangles.pop_back();
  EXPECT_THAT(test_support::manifold_flaw(surface_of(open)), HasSubstr("no second triangle"));
  MeshParts turned = whole;
  std::swap(turned.triangles[0][0], turned.triangles[0][1]);
  EXPECT_THAT(test_support::manifold_flaw(surface_of(turned)), HasSubstr("same direction"));
  MeshParts twice = whole;
  twice.triangles[0][0] = twice.triangles[0][1];
  EXPECT_THAT(test_support::manifold_flaw(surface_of(twice)), HasSubstr("twice"));
  // Two tetrahedra with one vertex in common.
  const MeshParts pair{
      {{0, 0, 0}, {1, 0, 1}, {0, 1, 1}, {-1, -1, 1}, {1, 0, -1}, {0, 1, -1}, {-1, -1, -1}},
      {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}, {0, 4, 5}, {0, 5, 6}, {0, 6, 4}, {4, 6, 5}}};
  EXPECT_THAT(test_support::manifold_flaw(surface_of(pair)), HasSubstr("one fan"));
}

TEST(MeshJudge, SeesSurfacesThatCross) {
  const MeshParts whole = cube(Vec3(0), 2);
  const auto crossing = [&](const MeshParts& other) {
    return test_support::crossing_flaw(surface_of(joined({whole, other})));
  };
  EXPECT_EQ(crossing(cube(Vec3(3), 1)), "");
  EXPECT_EQ(crossing(cube(Vec3(0.5), 1)), "");  // within it
  EXPECT_NE(crossing(cube(Vec3(1), 2)), "");
  EXPECT_NE(crossing(cube(Vec3(2 - 1e-9, 0.5, 0.5), 1)), "");
  EXPECT_NE(crossing(cube(Vec3(2, 0.5, 0.5), 1)), "");  // faces that overlap
  EXPECT_EQ(crossing(cube(Vec3(2, 2, 0.5), 1)), "");    // touch in an edge
  EXPECT_EQ(crossing(cube(Vec3(2, 2, 2), 1)), "");
  EXPECT_EQ(crossing(cube(Vec3(2, 2, 2 - 1e-15), 1)), "");
  EXPECT_NE(crossing(test_support::tetrahedron_parts(1).moved({1, 1, 2})), "");
  EXPECT_NE(test_support::crossing_flaw(
                surface_of(test_support::fan_prism_parts({{-2, -2}, {2, 2}, {2, -2}, {-2, 2}}, 1))),
            "");
}

TEST(MeshJudge, MeasuresMeshes) {
  const TriangleSet box = surface_of(box_parts({1, 2, 3}, {2, 4, 6}));
  EXPECT_EQ(double(test_support::volume_of(box)), 6);
  EXPECT_EQ(double(test_support::area_of(box)), 22);
  EXPECT_EQ(test_support::flat_triangles(box), 0u);
  TriangleSet line = box;
  line.vertices[0] = line.vertices[3];
  EXPECT_GT(test_support::flat_triangles(line), 0u);
}

TEST(MeshJudge, AcceptsWhatIsRight) {
  const MeshParts large = cube(Vec3(0), 3), small = cube(Vec3(1), 1);
  EXPECT_EQ(flaw(Op::kUnion, {large, small}, mesh_of({{large, 0}})), "");
  EXPECT_EQ(flaw(Op::kIntersection, {large, small}, mesh_of({{small, 1}})), "");
  EXPECT_EQ(flaw(Op::kDifference, {large, small}, mesh_of({{large, 0}, {small.inside_out(), 1}})),
            "");
  EXPECT_EQ(flaw(Op::kDifference, {small, large}, BoundaryMesh()), "");
  EXPECT_EQ(flaw(Op::kUnion, {large, large.inside_out()}, mesh_of({{large, 1}})), "");
  const MeshParts far = small.moved({9, 0, 0});
  EXPECT_EQ(flaw(Op::kUnion, {far, small}, mesh_of({{small, 1}, {far, 0}})), "");
}

TEST(MeshJudge, SeesWhatIsNotTheTree) {
  const MeshParts large = cube(Vec3(0), 3), small = cube(Vec3(1), 1);
  EXPECT_THAT(flaw(Op::kDifference, {large, small}, mesh_of({{large, 0}})), HasSubstr("winding"));
  EXPECT_THAT(flaw(Op::kUnion, {large, small}, BoundaryMesh()), HasSubstr("winding"));
  EXPECT_THAT(flaw(Op::kUnion, {large, small}, mesh_of({{large.inside_out(), 0}})),
              HasSubstr("winding"));
  EXPECT_THAT(flaw(Op::kUnion, {large, small}, mesh_of({{large.moved({1e-9, 0, 0}), 0}})),
              HasSubstr("winding"));
  EXPECT_EQ(flaw(Op::kUnion, {large, small}, mesh_of({{large.moved({1e-15, 0, 0}), 0}})), "");
}

TEST(MeshJudge, SeesFacesThatNameAnotherOperand) {
  const MeshParts large = cube(Vec3(0), 3), small = cube(Vec3(1), 1);
  EXPECT_THAT(flaw(Op::kUnion, {large, small}, mesh_of({{large, 1}})), HasSubstr("has no face"));
  EXPECT_THAT(flaw(Op::kUnion, {large, large}, mesh_of({{large, 0}})), HasSubstr("has a face"));
}

/// Returns whether each edge is passed as often in one direction as in the other.
bool is_closed(const TriangleSet& surface) {
  std::map<std::pair<uint32_t, uint32_t>, int> passes;
  for (const auto& triangle : surface.triangles) {
    for (size_t i = 0; i < 3; ++i) {
      const uint32_t from = triangle[i], to = triangle[(i + 1) % 3];
      passes[std::minmax(from, to)] += from < to ? 1 : -1;
    }
  }
  return std::ranges::all_of(passes, [](const auto& edge) { return edge.second == 0; });
}

TEST(RandomSolids, AreClosedAndCoincide) {
  uint32_t operands = 0, unknown = 0;
  for (uint32_t seed = 1; seed <= 500; ++seed) {
    const test_support::RandomSolid solid = test_support::random_solid(seed);
    for (const TriangleSet& surface : solid.surfaces()) {
      ++operands;
      ASSERT_TRUE(is_closed(surface)) << "seed " << seed;
    }
    for (const test_support::SolidOperand& operand : solid.operands) {
      unknown += operand.rule == test_support::SolidOperand::Rule::kUnknown;
      for (const MeshParts& shell : operand.shells) {
        ASSERT_EQ(test_support::manifold_flaw(surface_of(shell)), "") << "seed " << seed;
        ASSERT_EQ(test_support::crossing_flaw(surface_of(shell)), "") << "seed " << seed;
        ASSERT_GT(test_support::volume_of(surface_of(shell)), 0) << "seed " << seed;
      }
    }
  }
  EXPECT_GT(operands, 1500u);
  EXPECT_LT(unknown, operands / 10);
}

TEST(RandomSolids, AreMinimised) {
  // Fails as long as there are two operands.
  const auto fails = [](const test_support::RandomSolid& solid) {
    return solid.operands.size() > 1;
  };
  for (uint32_t seed = 1; seed <= 20; ++seed) {
    const test_support::RandomSolid solid = test_support::random_solid(seed);
    if (!fails(solid)) continue;
    const test_support::RandomSolid smallest = test_support::minimised(solid, fails);
    EXPECT_EQ(smallest.operands.size(), 2u);
    EXPECT_EQ(smallest.operation_count(), 0u);
  }
}

}  // namespace
