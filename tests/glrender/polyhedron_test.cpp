// Tests convex polyhedra by OpenGL against the CPU tracer's picture.
#include "csgcore/polyhedron.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "agreement.hpp"
#include "support/models.hpp"

namespace {

using csgcore::Affine;
using csgcore::Box;
using csgcore::Image;
using csgcore::make_frustum;
using csgcore::make_polyhedron;
using csgcore::make_sphere;
using csgcore::Mat3;
using csgcore::Op;
using csgcore::Polyhedron;
using csgcore::Primitive;
using csgcore::Projection;
using csgcore::Scene;
using csgcore::Vec3;
using csgcore::View;
using gl_test::at;
using gl_test::cube;
using gl_test::leaves_of;
using gl_test::LoadedScene;
using gl_test::Way;

/// Normals of faces are exact up to rounding; those next to the pole of a sphere with 200 fragments
/// are 5e-4 apart.
constexpr double kOtherFace = 1e-4;
constexpr gl_test::EdgeLimits kEdges{.face_distance = kOtherFace};
/// For designs with an edge every few pixels.
constexpr gl_test::EdgeLimits kManyEdges{.face_distance = kOtherFace, .hits_per_edge_pixel = 1000};
/// For views along an axis, where some of the rays lie in edges.
constexpr gl_test::EdgeLimits kAlongAnAxis{.face_distance = kOtherFace, .hits_per_edge_pixel = 500};

Primitive ball(double radius, int fragments, const Affine& place = {}) {
  return make_polyhedron(Polyhedron::sphere(radius, fragments), place);
}

Primitive prism(double from, double to, double radius, int fragments, const Affine& place = {}) {
  return make_polyhedron(Polyhedron::frustum(from, to, radius, radius, fragments), place);
}

Primitive dodecahedron(const Affine& place = {}) {
  constexpr double kGolden = std::numbers::phi;
  std::vector<csgcore::HalfSpace> faces;
  std::vector<Vec3> vertices;
  for (int signs = 0; signs < 8; ++signs) {
    const double x = signs & 1 ? -1 : 1, y = signs & 2 ? -1 : 1, z = signs & 4 ? -1 : 1;
    vertices.push_back({x, y, z});
    if (signs & 4) continue;
    for (int turn = 0; turn < 3; ++turn) {
      const auto turned = [&](double a, double b, double c) {
        return turn == 0 ? Vec3{a, b, c} : turn == 1 ? Vec3{c, a, b} : Vec3{b, c, a};
      };
      faces.push_back({turned(x, 0, y * kGolden), kGolden * kGolden});
      vertices.push_back(turned(0, x / kGolden, y * kGolden));
    }
  }
  return make_polyhedron(std::make_shared<const Polyhedron>(faces, vertices), place);
}

/// A sheared, mirrored, uneven map.
Affine skewed() { return {Mat3{Vec3{-1, 0.3, 0}, Vec3{0.5, 2, 0.1}, Vec3{0, 0.7, 1}}, {7, 8, 9}}; }

struct NamedScene {
  std::string name;
  Scene scene;
};

/// Prints the scene for the test's name, which must not contain an address.
void PrintTo(const NamedScene& one, std::ostream* out) { *out << one.name; }

NamedScene combine(std::string name, Op op, std::vector<Primitive> primitives) {
  return {std::move(name), test_support::scene_of(op, std::move(primitives))};
}

Primitive mapped(Primitive primitive, const Affine& map) {
  primitive.local_to_world = csgcore::compose(map, primitive.local_to_world);
  return primitive;
}

std::vector<NamedScene> scenes() {
  const Primitive block = cube({-4, -3, -2}, {4, 3, 2});
  std::vector<NamedScene> all;
  const auto add = [&](const char* name, Op op, std::vector<Primitive> primitives) {
    all.push_back(combine(name, op, std::move(primitives)));
  };
  add("Cube", Op::kUnion, {block});
  add("Dodecahedron", Op::kUnion, {dodecahedron()});
  add("SkewedDodecahedron", Op::kUnion, {dodecahedron(skewed())});
  add("BallOf48", Op::kUnion, {ball(3, 48)});
  add("BallOf200", Op::kUnion, {ball(3, 200)});
  add("SkewedBallOf48", Op::kUnion, {ball(3, 48, skewed())});
  add("ConeOf48", Op::kUnion, {make_polyhedron(Polyhedron::frustum(-1, 4, 3, 0, 48))});
  add("Plate", Op::kUnion, {cube({-50, -50, 0}, {50, 50, 0.01})});
  add("Needles", Op::kUnion,
      {prism(-50, 50, 4, 6),
       mapped(prism(-50, 50, 4, 5),
              {Mat3{Vec3{0, 0, 1}, Vec3{0, 1, 0}, Vec3{-1, 0, 0}}, {0, 5, 0}})});
  add("CubeWithHoles", Op::kDifference,
      {block, make_frustum(-3, 3, 1, 1), prism(-3, 3, 0.8, 30, at(2.5, 0, 0)),
       make_sphere(1, at(-2, 1, 2)),
       mapped(prism(-9, 9, 0.5, 8),
              {Mat3{Vec3{0, 0, 1}, Vec3{0, 1, 0}, Vec3{-1, 0, 0}}, {0, -1, 0}})});
  add("NutTrap", Op::kDifference,
      {make_frustum(0, 4, 6, 6), prism(2, 4, 3.2, 6), make_frustum(0, 4, 1.5, 1.5)});
  add("BallOf48LessBalls", Op::kDifference,
      {ball(3, 48), ball(1.2, 48, at(2, 1, 1)), make_sphere(1.2, at(2, -1, 1)),
       make_frustum(-4, 4, 0.7, 0.7)});
  add("BallOf200AndDodecahedron", Op::kIntersection,
      {ball(1.5, 200), dodecahedron(), cube({-2, -2, -2}, {1, 1, 1})});
  add("BallLessItsFacets", Op::kDifference, {make_sphere(3), ball(3, 12)});
  add("FlushCubes", Op::kUnion,
      {cube({0, 0, 0}, {2, 2, 2}), cube({2, 0, 0}, {4, 2, 2}), cube({1, 2, 0}, {3, 4, 2})});
  add("FlushCuts", Op::kDifference,
      {block, cube({-4, -1, 0}, {4, 1, 2}), prism(-2, 0, 1, 6), make_frustum(0, 2, 2, 2)});
  add("InnerCubes", Op::kUnion,
      {cube({-1, -1, 0}, {1, 1, 2}), block, make_frustum(0, 2, 2.9, 2.9), prism(-2, 2, 2.5, 48)});
  return all;
}

View view_of(const LoadedScene& loaded, Projection projection, double around_deg, double above_deg,
             double distance = 3) {
  return gl_test::view_from(loaded.solid.bounds(), projection, around_deg, above_deg, distance);
}

void expect_agreement(LoadedScene& loaded, const View& view, const std::string& name,
                      const gl_test::EdgeLimits& edges = kEdges) {
  gl_test::expect_agreement(loaded.draw(view), gl_test::draw_by_cpu(loaded, view), view,
                            loaded.solid.bounds().diagonal(), edges, name);
}

class PolyhedronTest : public testing::TestWithParam<NamedScene> {};

INSTANTIATE_TEST_SUITE_P(, PolyhedronTest, testing::ValuesIn(scenes()),
                         [](const auto& instance) { return instance.param.name; });

TEST_P(PolyhedronTest, EveryChannelIsTheTracers) {
  for (const Way& way : gl_test::all_ways()) {
    LoadedScene loaded(GetParam().scene, way);
    for (const Projection projection : {Projection::kPerspective, Projection::kOrthographic}) {
      expect_agreement(loaded, view_of(loaded, projection, 25, 35), GetParam().name);
      expect_agreement(loaded, view_of(loaded, projection, 200, -20, 1.2), GetParam().name);
      expect_agreement(loaded, view_of(loaded, projection, 0, 90), GetParam().name, kAlongAnAxis);
    }
  }
}

NamedScene cube_with_rooms() {
  return combine("rooms", Op::kDifference,
                 {cube({-5, -5, -5}, {5, 5, 5}), cube({-4, -4, -4}, {1, 4, 4}),
                  ball(1.5, 48, at(3, 0, 0)), prism(-9, 9, 0.5, 6, at(3, 3, 0))});
}

TEST(PolyhedronPictureTest, EyeInsideTheSolidACellAndACut) {
  const NamedScene rooms = cube_with_rooms();
  for (const Way& way : gl_test::all_ways()) {
    LoadedScene loaded(rooms.scene, way);
    View view = view_of(loaded, Projection::kPerspective, 30, 20);
    view.half_height = 0.7;
    for (const Vec3& eye : {Vec3{-1, 0, 1} /* in a room */, Vec3{2.8, 0.1, 0} /* in a ball */,
                            Vec3{4.7, 1, 1} /* in the solid */, Vec3{3, 3, 4} /* in a hole */}) {
      view.eye = eye;
      expect_agreement(loaded, view, "eye inside");
    }
  }
}

TEST(PolyhedronPictureTest, WhatLiesBehindAFront) {
  const NamedScene rooms = cube_with_rooms();
  for (const Way& way : gl_test::all_ways()) {
    LoadedScene loaded(rooms.scene, way);
    const View view = view_of(loaded, Projection::kPerspective, 25, 35);
    loaded.draw(view);
    const Image behind = loaded.renderer.draw_behind(view, loaded.settings, loaded.stats);
    const Image oracle = gl_test::draw_by_cpu(loaded, view, csgcore::Boundary::kBehind);
    gl_test::expect_agreement(behind, oracle, view, loaded.solid.bounds().diagonal(), kEdges,
                              "behind, " + name_of(way));
  }
}

TEST(PolyhedronPictureTest, Samples) {
  for (const Way& way : gl_test::all_ways()) {
    LoadedScene loaded(cube_with_rooms().scene, way);
    const View view = view_of(loaded, Projection::kPerspective, 25, 35);
    const Image plain = loaded.draw(view);
    loaded.settings.samples = 4;
    const Image gl = loaded.draw(view);
    const Image cpu = gl_test::draw_by_cpu(loaded, view);
    uint64_t blended = 0, apart = 0;
    for (size_t i = 0; i < gl.rgb.size(); ++i) {
      blended += gl_test::levels_apart(plain, cpu, i) > gl_test::kLevels;
      apart += gl_test::levels_apart(gl, cpu, i) > gl_test::kLevels;
    }
    EXPECT_GT(blended, 500u);
    EXPECT_LE(apart * 100, blended) << name_of(way);
  }
}

TEST(PolyhedronPictureTest, LongLists) {
  // Each polyhedron is needed: its faces or those of its neighbours are all that is left.
  std::vector<Primitive> turned, nested;
  for (int i = 0; i < 48; ++i) {
    const double angle = i * std::numbers::pi / 48;
    const Mat3 turn{Vec3{std::cos(angle), 0, std::sin(angle)}, Vec3{0, 1, 0},
                    Vec3{-std::sin(angle), 0, std::cos(angle)}};
    turned.push_back(mapped(cube({-3, -4 - 0.01 * i, -3}, {3, 4, 3}), {turn, Vec3{0}}));
    nested.push_back(ball(3, 6 + i, at(0.01 * i, 0, 0)));
  }
  for (const Way& way : {Way(leaves_of(32)), Way(leaves_of(64)), gl_test::by_tiles()}) {
    for (const auto& primitives : {turned, nested}) {
      const NamedScene common = combine("common", Op::kIntersection, primitives);
      LoadedScene loaded(common.scene, way);
      View view = view_of(loaded, Projection::kPerspective, 25, 35);
      view.width_px = 160;
      view.height_px = 120;
      expect_agreement(loaded, view, "common", kManyEdges);
    }
  }
}

TEST(PolyhedronPictureTest, RefusesWhatAShaderCannotEvaluate) {
  // The primitives are in one place and of almost one size: equal ones would be merged.
  const auto draw_equal = [](const Primitive& primitive, size_t count) {
    std::vector<Primitive> primitives(count, primitive);
    for (size_t i = 0; i < count; ++i) {
      primitives[i].local_to_world.linear *= 1 + 1e-9 * static_cast<double>(i);
    }
    const NamedScene equal = combine("equal", Op::kIntersection, std::move(primitives));
    LoadedScene loaded(equal.scene, leaves_of(8));
    View view = view_of(loaded, Projection::kPerspective, 25, 35);
    view.width_px = view.height_px = 16;
    loaded.draw(view);
  };
  EXPECT_NO_THROW(draw_equal(cube(Vec3(0), Vec3(1)), 300));
  EXPECT_NO_THROW(draw_equal(ball(1, 48), 50));
  EXPECT_THROW(draw_equal(cube(Vec3(0), Vec3(1)), 10000), glrender::GlError);
  EXPECT_THROW(draw_equal(ball(1, 48), 300), glrender::GlError);
}

/// A plate less hexagonal sockets and faceted holes, which share their polyhedra.
NamedScene perforated_plate(int side) {
  std::vector<Primitive> all{cube({0, 0, 0}, {double(side), double(side), 1})};
  const Primitive socket = prism(0.5, 1, 0.4, 6);
  const Primitive hole = ball(0.3, 24);
  for (int i = 0; i < side * side; ++i) {
    const Affine place = at(0.5 + i % side, 0.5 + i / side, 0);
    all.push_back(mapped(socket, place));
    all.push_back(mapped(hole, place));
  }
  return combine("plate", Op::kDifference, all);
}

TEST(PolyhedronPictureTest, BatchesAreTheWholePicture) {
  LoadedScene loaded(perforated_plate(20).scene, leaves_of(8));
  const View view = view_of(loaded, Projection::kPerspective, 25, 35);
  const Image whole = loaded.draw(view);
  gl_test::expect_agreement(whole, gl_test::draw_by_cpu(loaded, view), view,
                            loaded.solid.bounds().diagonal(), kEdges, "perforated plate");
  const Image batches =
      loaded.renderer.draw_while_subdividing(leaves_of(8), view, loaded.settings, loaded.stats);
  EXPECT_EQ(whole.rgb, batches.rgb);
  EXPECT_EQ(whole.id, batches.id);
}

TEST(PolyhedronPictureTest, RefinedCells) {
  // Three surfaces meet in many points.
  std::vector<Primitive> primitives{cube({0, 0, 0}, {20, 4, 4})};
  for (int i = 0; i < 40; ++i) primitives.push_back(prism(2, 5, 0.7, 6, at(0.5 * i, 2, 0)));
  const NamedScene row = combine("row", Op::kDifference, primitives);
  const csgcore::Solid solid(csgcore::canonical_primitives(row.scene), row.scene.model);
  const View far = gl_test::view_from(solid.bounds(), Projection::kPerspective, 25, 35, 30);
  LoadedScene loaded(row.scene, csgcore::SubdivisionOptions::paper(2, far));
  View near = view_of(loaded, Projection::kPerspective, 120, 60, 2);
  near.half_height /= 4;
  const Image oracle = gl_test::draw_by_cpu(loaded, near);
  const auto dropped = gl_test::compare(loaded.draw(near), oracle, 1);
  EXPECT_TRUE(loaded.subdivision.refine(near));
  loaded.renderer.load(loaded.subdivision);
  const auto refined = gl_test::compare(loaded.draw(near), oracle, 1);
  EXPECT_LT(refined.wrong() * 4, dropped.wrong());
}

TEST(PolyhedronPictureTest, CellsOfASolid) {
  LoadedScene loaded(cube_with_rooms().scene, leaves_of(2));
  loaded.settings.subject = glrender::Subject::kCells;
  const Image cells = loaded.draw(view_of(loaded, Projection::kPerspective, 25, 35));
  const auto shown =
      std::count_if(cells.z.begin(), cells.z.end(), [](float z) { return std::isfinite(z); });
  EXPECT_GT(shown, 1500);
}

}  // namespace
