// Tests the Nef oracle's solids: volumes, areas, boundaries, files and limits.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <sstream>

#include "csgcore/polyhedron.hpp"
#include "nef_scenes.hpp"
#include "support/test_meshes.hpp"

namespace oracle {
namespace {

using csgcore::Affine;
using csgcore::Mat3;
using csgcore::Mesh;
using csgcore::Op;
using csgcore::Vec3;
using testing::ElementsAre;

NefScene lone(FacetedSolid polyhedron) { return scene_of(Op::kUnion, {std::move(polyhedron)}); }

TEST(NefSolid, VolumesAreExact) {
  const FacetedSolid unit = box(Vec3(0), Vec3(1));
  EXPECT_EQ(build(lone(unit))->volume(), 1);
  EXPECT_EQ(build(lone(box(Vec3(-1, 0, 2), Vec3(2, 0.5, 6))))->volume(), 6);
  // A sheared and mirrored map: |det|. 0.1 stands for the double next to it.
  const Affine map{Mat3(Vec3(-2, 0, 0), Vec3(5, 3, 0), Vec3(0.1, 7, 0.1)), Vec3(9, 8, 7)};
  EXPECT_EQ(build(lone(box(Vec3(0), Vec3(1), map)))->volume(), Rational(6) * Rational(0.1));
  // Octahedron, in half-spaces that meet four by four.
  FacetedSolid octahedron;
  for (int i = 0; i < 8; ++i) {
    octahedron.half_spaces.push_back({{i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1}, 1});
  }
  EXPECT_EQ(build(lone(octahedron))->volume(), Rational(4, 3));
  // Square pyramid: a cone of four fragments.
  EXPECT_EQ(build(lone(frustum(0, 4, 2, 0, 4)))->volume(), Rational(32, 3));

  const FacetedSolid half_beside = box(Vec3(0), Vec3(1), shift(Vec3(0.5, 0.5, 0.5)));
  EXPECT_EQ(build(scene_of(Op::kUnion, {unit, half_beside}))->volume(), Rational(15, 8));
  EXPECT_EQ(build(scene_of(Op::kIntersection, {unit, half_beside}))->volume(), Rational(1, 8));
  EXPECT_EQ(build(scene_of(Op::kDifference, {unit, half_beside}))->volume(), Rational(7, 8));
}

// At first a point inside is sought with some of many planes; here another plane cuts away the
// middle.
TEST(NefSolid, OfManyPlanes) {
  FacetedSolid whole = sphere(3.7, 24), cut = whole, rest = whole;
  cut.half_spaces.push_back({{1, 0, 0}, -2.5});
  rest.half_spaces.push_back({{-1, 0, 0}, 2.5});
  const Rational volume = build(lone(cut))->volume();
  EXPECT_GT(volume, 0);
  EXPECT_EQ(volume + build(lone(rest))->volume(), build(lone(whole))->volume());
}

TEST(NefSolid, FacetedPrimitivesHaveTheMeshesVolume) {
  for (const int fragments : {3, 4, 5, 6, 7, 8, 13, 24}) {
    const auto ball = build(lone(sphere(3.7, fragments)));
    const double expected = volume_of(csgcore::sphere_mesh(3.7, fragments));
    EXPECT_NEAR(ball->volume().get_d(), expected, 1e-13 * expected) << fragments;
    // Trapezoids and two caps, exactly plane: no facet is split into triangles.
    const auto rings = static_cast<size_t>(csgcore::ring_count(fragments));
    EXPECT_EQ(ball->planes().size(), (rings - 1) * static_cast<size_t>(fragments) + 2);
    EXPECT_EQ(ball->mesh().vertices.size(), rings * static_cast<size_t>(fragments));

    const auto cone = build(lone(frustum(-1, 2, 1.5, 0.5, fragments)));
    const double cone_volume = volume_of(csgcore::frustum_mesh(-1, 2, 1.5, 0.5, fragments));
    EXPECT_NEAR(cone->volume().get_d(), cone_volume, 1e-14 * cone_volume) << fragments;
    EXPECT_EQ(build(lone(frustum(-1, 2, 0, 0.5, fragments)))->planes().size(),
              static_cast<size_t>(fragments) + 1);
  }
}

TEST(NefSolid, OfASceneWithPolyhedra) {
  using csgcore::Polyhedron;
  const Affine map{Mat3(Vec3(1, 0.5, 0), Vec3(0, -2, 0), Vec3(0.1, 0, 1)), Vec3(0.3, 0, 0)};
  csgcore::Scene scene;
  scene.model = scene_of(Op::kDifference, {{}, {}, {}}).tree;
  scene.primitives = {csgcore::make_sphere(2, map),
                      csgcore::make_polyhedron(Polyhedron::box({Vec3(0), Vec3(1, 2, 3)}), map),
                      csgcore::make_polyhedron(Polyhedron::frustum(-1, 2, 1, 0.5, 6), map)};
  const NefScene same = scene_of(
      Op::kDifference,
      {sphere(2, 9, map), box(Vec3(0), Vec3(1, 2, 3), map), frustum(-1, 2, 1, 0.5, 6, map)});
  EXPECT_EQ(NefSolid::build(scene, 9).solid->volume(), build(same)->volume());
  EXPECT_LT(NefSolid::build(scene, 4).solid->volume(), build(same)->volume());
}

// The vertices by which the exact ray oracle bounds polyhedra.
FacetedSolid mesh(const test_support::MeshParts& parts, const csgcore::Affine& map = {}) {
  return {{}, map, parts.mesh()};
}

TEST(NefSolid, OfMeshes) {
  using test_support::box_parts;
  const Rational l_prism = build(lone(mesh(test_support::l_prism_parts(4, 1, 2))))->volume();
  EXPECT_EQ(l_prism, 14);
  const csgcore::Affine mirrored{csgcore::Mat3(-1, 0, 0, 0, 2, 0, 0, 0, 1), Vec3(1, 2, 3)};
  EXPECT_EQ(build(lone(mesh(test_support::l_prism_parts(4, 1, 2), mirrored)))->volume(), 28);
  // Its solid is where the winding number is not 0.
  test_support::MeshParts parts = box_parts(Vec3(0), Vec3(4));
  EXPECT_EQ(build(lone(mesh(parts.inside_out())))->volume(), 64);
  parts.add(box_parts(Vec3(1), Vec3(2)).inside_out());
  EXPECT_EQ(build(lone(mesh(parts)))->volume(), 63);
  parts.add(box_parts(Vec3(3), Vec3(5)));
  EXPECT_EQ(build(lone(mesh(parts)))->volume(), 63 + 7);
  parts.add(box_parts(Vec3(3), Vec3(5)).inside_out());
  EXPECT_EQ(build(lone(mesh(parts)))->volume(), 63);
  // Faces that a mesh shares with a polyhedron are both's.
  const FacetedSolid half = box(Vec3(0), Vec3(4, 4, 2));
  const auto shared = build(scene_of(Op::kUnion, {half, mesh(box_parts(Vec3(0), Vec3(4)))}));
  for (const FacetPlane& plane : shared->planes()) {
    const bool is_top = plane.unit_normal.z > 0;
    EXPECT_EQ(plane.polyhedra.size(), is_top ? 1u : 2u);
  }
}

TEST(NefSolid, RefusesMeshesThatBoundNoSolid) {
  const auto expect_refused = [](const test_support::MeshParts& parts, const char* reason) {
    const NefScene scene = lone(mesh(parts));
    const NefBuild result = NefSolid::build(scene.tree, scene.polyhedra);
    EXPECT_EQ(result.status, NefStatus::kFailed);
    EXPECT_EQ(result.reason, reason);
  };
  test_support::MeshParts open = test_support::box_parts(Vec3(0), Vec3(1));
  open.triangles.pop_back();
  expect_refused(open, "a mesh is not closed");
  expect_refused(test_support::box_parts({0, 0, 0}, {1, 1, 0}), "a triangle of a mesh has no area");
  test_support::MeshParts crossed = test_support::l_prism_parts(4, 1, 2);
  crossed.vertices[3] = {5, 5, 0};
  expect_refused(crossed, "a shell of a mesh intersects itself");
}

TEST(NefSolid, PolyhedraHaveTheirVertices) {
  using csgcore::Polyhedron;
  std::vector<std::shared_ptr<const Polyhedron>> solids{
      Polyhedron::box({Vec3(-1, 0, 2), Vec3(1e-7, 1.0 / 3, 1e6)}),
      Polyhedron::from(csgcore::sphere_mesh(1, 5)),
      Polyhedron::from(csgcore::frustum_mesh(0, 1, 2, 0, 7))};
  for (const int fragments : {3, 6, 7, 24}) {
    solids.push_back(Polyhedron::sphere(1.0 / 3, fragments));
    solids.push_back(Polyhedron::frustum(1.0 / 3, 0.4, 1.1, 0.9, fragments));
    solids.push_back(Polyhedron::frustum(-1, 0.4, 0, 0.9, fragments));
  }
  for (const auto& solid : solids) {
    csgcore::Box box;
    for (const Vec3& vertex : solid->vertices()) box.merge(vertex);
    const auto exact = build(lone({solid->half_spaces(), {}}));
    const double rounding = 1e-13 * box.diagonal();
    EXPECT_LE(glm::length(exact->bounds().min - box.min), rounding);
    EXPECT_LE(glm::length(exact->bounds().max - box.max), rounding);
    for (const Vec3& vertex : exact->mesh().vertices) {
      const auto is_near = [&](const Vec3& v) { return glm::length(v - vertex) <= rounding; };
      EXPECT_TRUE(std::any_of(solid->vertices().begin(), solid->vertices().end(), is_near));
    }
  }
}

TEST(NefSolid, Regularised) {
  const FacetedSolid unit = box(Vec3(0), Vec3(1));
  const FacetedSolid beside = box(Vec3(1, 0, 0), Vec3(2, 1, 1));
  // A shared face leaves no skin, and their common part is empty.
  const auto both = build(scene_of(Op::kUnion, {unit, beside}));
  EXPECT_EQ(both->volume(), 2);
  EXPECT_DOUBLE_EQ(both->area(), 10);
  EXPECT_EQ(both->planes().size(), 6u);
  EXPECT_EQ(both->locate(Vec3(1, 0.5, 0.5)), Place::kInside);
  EXPECT_TRUE(build(scene_of(Op::kIntersection, {unit, beside}))->empty());
  EXPECT_EQ(build(scene_of(Op::kDifference, {unit, beside}))->area(), 6);

  // A part that is cut off and put back leaves no crack.
  csgcore::CsgTreeBuilder builder;
  builder.open(Op::kDifference);
  builder.primitive(0);
  builder.primitive(1);
  builder.close();
  builder.primitive(1);
  const NefScene whole{builder.finish(),
                       {box(Vec3(0), Vec3(2)), box(Vec3(0.5, 0, 0.5), Vec3(1, 1, 1))}};
  EXPECT_EQ(build(whole)->area(), 24);
  EXPECT_EQ(build(whole)->planes().size(), 6u);

  // A flush hole is open.
  const auto hole =
      build(scene_of(Op::kDifference, {unit, box(Vec3(0.25, 0.25, 0), Vec3(0.75, 0.75, 1))}));
  EXPECT_EQ(hole->volume(), Rational(3, 4));
  EXPECT_EQ(hole->area(), 6 - 2 * 0.25 + 4 * 0.5);
  // Faces 1e-30 apart do not coincide.
  const auto gap = build(scene_of(
      Op::kUnion, {box(Vec3(-1, 0, 0), Vec3(0, 1, 1)), box(Vec3(1e-30, 0, 0), Vec3(1, 1, 1))}));
  EXPECT_EQ(gap->area(), 12);
}

// An edge of the solid that is inside a facet, or enters it from its border: the facet is on both
// of its sides, and its cycle runs along the edge in both directions.
TEST(NefSolid, RidgesInAFacet) {
  const FacetedSolid block = box(Vec3(0), Vec3(4));
  // A prism along y, with the section of a square of diagonal 2 that stands on its corner.
  const auto prism = [](double y_min, double y_max, double x, double z) {
    return frustum(y_min, y_max, 1, 1, 4,
                   {Mat3(Vec3(1, 0, 0), Vec3(0, 0, 1), Vec3(0, 1, 0)), Vec3(x, 0, z)});
  };
  const auto expect = [](const std::string& what, const NefScene& scene, const Rational& volume) {
    const auto solid = build(scene);
    ASSERT_EQ(solid->volume(), volume) << what << ": " << solid->volume().get_d();
    EXPECT_NEAR(volume_of(solid->mesh()), volume.get_d(), 1e-12) << what;
    EXPECT_EQ(solid->locate(Vec3(2, 2, 4)), Place::kBoundary) << what;
    EXPECT_EQ(solid->locate(Vec3(0.5, 0.5, 3.875)), Place::kInside) << what;
    EXPECT_EQ(solid->locate(Vec3(0.5, 0.5, 4.125)), Place::kOutside) << what;
  };
  const auto without = [&](std::vector<FacetedSolid> holes) {
    holes.insert(holes.begin(), block);
    return scene_of(Op::kDifference, std::move(holes));
  };
  const FacetedSolid across =
      frustum(1, 3, 1, 1, 4, {Mat3(Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(1, 0, 0)), Vec3(0, 2, 3)});
  expect("within", without({prism(1, 3, 2, 3)}), 60);
  expect("from one border", without({prism(-1, 3, 2, 3)}), 58);
  expect("from border to border", without({prism(0, 4, 2, 3)}), 56);
  expect("from a hole", without({prism(1, 3, 2, 3), box(Vec3(1.5, 3, -1), Vec3(2.5, 3.5, 5))}), 58);
  expect("a cross", without({prism(1, 3, 2, 3), across}), 64 - Rational(16, 3));
  expect("a T", without({prism(2, 3, 2, 3), across}), 64 - Rational(14, 3));
  expect("a vertex", without({frustum(2, 4, 1, 0, 4, shift(Vec3(2, 2, 0)))}), 64 - Rational(4, 3));
  // A box that only touches: its edge passes the vertex, and is no edge of the solid.
  expect("a vertex below an edge",
         without({box(Vec3(2, 0, 4), Vec3(4, 4, 6)), frustum(2, 4, 1, 0, 4, shift(Vec3(2, 2, 0)))}),
         64 - Rational(4, 3));
  expect("from outside", scene_of(Op::kUnion, {block, prism(1, 3, 2, 5)}), 68);
}

TEST(NefSolid, Empty) {
  const auto nothing = build({});
  EXPECT_TRUE(nothing->empty());
  EXPECT_EQ(nothing->volume(), 0);
  EXPECT_EQ(nothing->area(), 0);
  EXPECT_TRUE(nothing->bounds().empty());
  EXPECT_TRUE(nothing->mesh().faces.empty());
  EXPECT_EQ(nothing->locate(Vec3(0)), Place::kOutside);
  EXPECT_TRUE(nothing->crossings({Vec3(0), Vec3(0, 0, 1)}).empty());
  const FacetedSolid ball = sphere(1, 8);
  EXPECT_TRUE(build(scene_of(Op::kDifference, {ball, ball}))->empty());
}

TEST(NefSolid, SmallestBox) {
  const auto both = build(
      scene_of(Op::kUnion, {box(Vec3(0), Vec3(1)), box(Vec3(0), Vec3(0.1), shift(Vec3(3, 0, 0)))}));
  const csgcore::Box bounds = both->bounds();
  EXPECT_EQ(bounds.min, Vec3(0));
  EXPECT_EQ(bounds.max.y, 1);
  // 3 + the double 0.1 is not a double: it is rounded outwards.
  EXPECT_GT(Rational(bounds.max.x), Rational(3) + Rational(0.1));
  EXPECT_LT(Rational(std::nextafter(bounds.max.x, 0)), Rational(3) + Rational(0.1));
}

TEST(NefSolid, PlanesNameTheirPolyhedra) {
  const auto cut =
      build(scene_of(Op::kDifference, {box(Vec3(0), Vec3(4)), box(Vec3(1, 1, 3), Vec3(2, 2, 4)),
                                       box(Vec3(1, 3, 2), Vec3(2, 4, 5))}));
  const auto polyhedra_of = [&](const Vec3& normal, double offset) {
    for (const FacetPlane& plane : cut->planes()) {
      if (plane.unit_normal != normal) continue;
      const Rational length = abs(plane.normal[0]) + abs(plane.normal[1]) + abs(plane.normal[2]);
      if (plane.offset == offset * length) return plane.polyhedra;
    }
    return std::vector<uint32_t>{99};
  };
  EXPECT_THAT(polyhedra_of(Vec3(-1, 0, 0), 0), ElementsAre(0));
  EXPECT_THAT(polyhedra_of(Vec3(0, 0, 1), 4), ElementsAre(0, 1));  // a face of both
  EXPECT_THAT(polyhedra_of(Vec3(1, 0, 0), 1), ElementsAre(1, 2));  // of two holes, turned round
  EXPECT_THAT(polyhedra_of(Vec3(0, -1, 0), -2), ElementsAre(1));
  EXPECT_THAT(polyhedra_of(Vec3(0, 0, 1), 3), ElementsAre(1));   // a hole's floor
  EXPECT_THAT(polyhedra_of(Vec3(0, 0, 1), 5), ElementsAre(99));  // cut through
}

TEST(NefSolid, Files) {
  const auto cut = build(
      scene_of(Op::kDifference, {sphere(1, 8), box(Vec3(-2, -0.3, -0.3), Vec3(2, 0.3, 0.3))}));
  const Mesh mesh = cut->mesh();
  EXPECT_NEAR(volume_of(mesh), cut->volume().get_d(), 1e-14);

  std::stringstream off;
  write_off(off, mesh);
  std::string magic;
  size_t vertices, faces, edges;
  off >> magic >> vertices >> faces >> edges;
  EXPECT_EQ(magic, "OFF");
  Mesh read;
  read.vertices.resize(vertices);
  read.faces.resize(faces, std::vector<uint32_t>(3));
  for (Vec3& v : read.vertices) off >> v.x >> v.y >> v.z;
  for (auto& face : read.faces) {
    size_t corners;
    off >> corners >> face[0] >> face[1] >> face[2];
    EXPECT_EQ(corners, 3u);
  }
  EXPECT_TRUE(off);
  EXPECT_EQ(read.vertices, mesh.vertices);  // all digits
  EXPECT_EQ(read.faces, mesh.faces);

  std::stringstream stl;
  write_stl(stl, mesh);
  std::string word;
  double six_times = 0;
  size_t facets = 0;
  for (std::vector<Vec3> corners; stl >> word;) {
    if (word == "facet") {
      ++facets;
      Vec3 normal;
      EXPECT_TRUE(stl >> word >> normal.x >> normal.y >> normal.z);
      EXPECT_NEAR(glm::length(normal), 1, 1e-15);
    } else if (word == "vertex") {
      Vec3& v = corners.emplace_back();
      stl >> v.x >> v.y >> v.z;
    } else if (word == "endfacet") {
      ASSERT_EQ(corners.size(), 3u);
      six_times += glm::dot(corners[0], glm::cross(corners[1], corners[2]));
      corners.clear();
    }
  }
  EXPECT_EQ(word, "scadray");
  EXPECT_EQ(facets, mesh.faces.size());
  EXPECT_NEAR(six_times / 6, cut->volume().get_d(), 1e-14);
}

/// A scene that takes minutes.
NefScene large_scene() {
  std::vector<FacetedSolid> balls;
  for (int i = 0; i < 30; ++i) {
    balls.push_back(sphere(3, 60, shift(Vec3(0.1 * i, 0.07 * i * i, 0.3 * std::sin(i)))));
  }
  return scene_of(Op::kUnion, std::move(balls));
}

TEST(NefSolid, KeepsTheDeadline) {
  using Clock = std::chrono::steady_clock;
  const NefScene scene = large_scene();
  const auto start = Clock::now();
  const NefBuild late =
      NefSolid::build(scene.tree, scene.polyhedra, {start + std::chrono::milliseconds(200)});
  const auto taken = Clock::now() - start;
  EXPECT_EQ(late.status, NefStatus::kDeadline);
  EXPECT_EQ(late.solid, nullptr);
  EXPECT_GE(taken, std::chrono::milliseconds(200));
  EXPECT_LT(taken, std::chrono::seconds(2));
}

TEST(NefSolid, CanBeCancelled) {
  using Clock = std::chrono::steady_clock;
  const NefScene scene = large_scene();
  const auto start = Clock::now();
  int asked = 0;
  NefLimits limits;
  limits.keep_waiting = [&asked] { return ++asked < 4; };
  EXPECT_EQ(NefSolid::build(scene.tree, scene.polyhedra, limits).status, NefStatus::kCancelled);
  EXPECT_EQ(asked, 4);
  EXPECT_LT(Clock::now() - start, std::chrono::seconds(2));
}

TEST(NefSolid, RefusesWhatIsNoSolid) {
  FacetedSolid wedge = box(Vec3(0), Vec3(1));
  wedge.half_spaces.pop_back();  // now it is unbounded
  FacetedSolid nothing = box(Vec3(0), Vec3(1));
  nothing.half_spaces.push_back({{1, 0, 0}, -1});
  FacetedSolid flat = box(Vec3(0), Vec3(1));
  flat.half_spaces.push_back({{1, 0, 0}, 0});
  for (const FacetedSolid& polyhedron : {wedge, nothing, flat, FacetedSolid{}}) {
    const NefScene scene = lone(polyhedron);
    const NefBuild result = NefSolid::build(scene.tree, scene.polyhedra);
    EXPECT_EQ(result.status, NefStatus::kFailed);
    EXPECT_THAT(result.reason, testing::HasSubstr("bound no solid"));
  }
}

}  // namespace
}  // namespace oracle
