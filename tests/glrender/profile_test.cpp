// Tests extrusions and revolutions by OpenGL against the CPU tracer's picture.
#include "csgcore/profile.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <memory>

#include "agreement.hpp"
#include "csgcore/polyhedron.hpp"
#include "support/models.hpp"
#include "support/test_meshes.hpp"

namespace {

using csgcore::Affine;
using csgcore::FillRule;
using csgcore::Image;
using csgcore::make_extrusion;
using csgcore::make_frustum;
using csgcore::make_polyhedron;
using csgcore::make_revolution;
using csgcore::make_sphere;
using csgcore::Mat3;
using csgcore::Op;
using csgcore::Polyhedron;
using csgcore::Primitive;
using csgcore::Profile;
using csgcore::ProfileEdge;
using csgcore::ProfileLoop;
using csgcore::Projection;
using csgcore::Scene;
using csgcore::Vec2;
using csgcore::Vec3;
using csgcore::View;
using gl_test::at;
using gl_test::cube;
using gl_test::LoadedScene;
using gl_test::skewed;
using gl_test::Way;

using Figure = std::shared_ptr<const Profile>;

/// Normals of one face are equal up to rounding.
constexpr gl_test::EdgeLimits kEdges{.face_distance = 1e-3, .hits_per_edge_pixel = 1000};
/// For views along an axis, where rays lie in edges.
constexpr gl_test::EdgeLimits kAlongAnAxis{.face_distance = 1e-3, .hits_per_edge_pixel = 200};

ProfileEdge line(const Vec2& end) { return {ProfileEdge::Kind::kLine, true, end, {}}; }
ProfileEdge bezier(const Vec2& control, const Vec2& end) {
  return {ProfileEdge::Kind::kBezier, true, end, control};
}
ProfileEdge arc(const Vec2& center, const Vec2& end, bool is_counterclockwise = true) {
  return {ProfileEdge::Kind::kArc, is_counterclockwise, end, center};
}

ProfileLoop polygon(const std::vector<Vec2>& points) {
  ProfileLoop loop;
  for (const Vec2& point : points) loop.push_back(line(point));
  return loop;
}
ProfileLoop rectangle(const Vec2& min, const Vec2& max) {
  return polygon({min, {max.x, min.y}, max, {min.x, max.y}});
}
ProfileLoop circle(const Vec2& center, double radius) {
  const Vec2 right{radius, 0};
  return {arc(center, center + right), arc(center, center - right)};
}
/// A star of points at two distances.
ProfileLoop star(int points, double outer, double inner) {
  std::vector<Vec2> corners;
  for (int i = 0; i < 2 * points; ++i) {
    const double around = glm::pi<double>() * i / points;
    corners.push_back((i % 2 == 0 ? outer : inner) * Vec2{std::cos(around), std::sin(around)});
  }
  return polygon(corners);
}
ProfileLoop translated(ProfileLoop loop, const Vec2& by) {
  for (ProfileEdge& edge : loop) {
    edge.end += by;
    edge.control += by;
  }
  return loop;
}
/// A leaf and a stem, as fonts have them.
ProfileLoop leaf() {
  return {line({0.2, 0}), line({0.2, 1}), bezier({1.5, 1}, {1.5, 2.5}), bezier({0.1, 2.4}, {0, 1})};
}
/// An L with rounded corners, without and within.
ProfileLoop rounded_l() {
  return {line({3, 0}),   line({3, 1}),          arc({3, 0}, {2, 0}, false) /* no quarter */,
          line({1.5, 0}), line({1.5, 0.5}),      arc({1.5, 1}, {1, 1}, false),
          line({1, 3}),   arc({0.5, 3}, {0, 3}), line({0, 0})};
}

Figure figure(std::vector<ProfileLoop> loops, FillRule fill_rule = FillRule::kEvenOdd) {
  return std::make_shared<const Profile>(std::move(loops), fill_rule);
}

struct NamedScene {
  std::string name;
  Scene scene;
};

/// Prints the scene for the test's name, which must not contain an address.
void PrintTo(const NamedScene& one, std::ostream* out) { *out << one.name; }

std::vector<NamedScene> scenes() {
  const Figure l = figure({polygon({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}})});
  const Figure plate = figure({rectangle({-2, -1}, {2, 1}), circle({-1, 0}, 0.6),
                               rectangle({0.3, -0.5}, {1.5, 0.5}), circle({0.9, 0}, 0.3)});
  const Figure overlapping =
      figure({rectangle({-1, -1}, {1, 1}), rectangle({0, 0}, {2, 2}), circle({-1, 1}, 0.8)},
             FillRule::kNonZero);
  const Figure leaves = figure({leaf(), circle({-1, 1}, 0.5)});
  std::vector<NamedScene> all;
  const auto add = [&](const char* name, Op op, std::vector<Primitive> primitives) {
    all.push_back({name, test_support::scene_of(op, std::move(primitives))});
  };
  add("LPrism", Op::kUnion, {make_extrusion(l, 0, 1)});
  add("SkewedLPrism", Op::kUnion, {make_extrusion(l, 0, 1, 1, 1, skewed())});
  add("PlateWithHoles", Op::kUnion, {make_extrusion(plate, 0, 0.7)});
  add("SkewedPlate", Op::kUnion, {make_extrusion(plate, 0, 2.5, 1, 0.5, skewed())});
  add("FarFromTheOrigin", Op::kUnion, {make_extrusion(plate, 0, 1, 1, 1, at(1000, -2000, 500))});
  add("OverlappingLoops", Op::kUnion, {make_extrusion(overlapping, 0, 1)});
  add("CrossedLoops", Op::kUnion,
      {make_extrusion(figure({rectangle({-1, -1}, {1, 1}), rectangle({0, 0}, {2, 2})}), 0, 1)});
  add("RoundedL", Op::kUnion, {make_extrusion(figure({rounded_l()}, FillRule::kNonZero), -1, 1)});
  add("Leaves", Op::kUnion, {make_extrusion(leaves, 0, 0.5)});
  add("TaperedLeaves", Op::kUnion, {make_extrusion(leaves, 0, 1.5, 1, 0.4)});
  add("StarToAPoint", Op::kUnion, {make_extrusion(figure({star(5, 2, 0.8)}), 0, 2, 1, 0)});
  add("PlateFromAPoint", Op::kUnion, {make_extrusion(plate, 0, 2, 0, 1)});
  add("PointBesideTheAxis", Op::kUnion,
      {make_extrusion(figure({circle({3, 1}, 1)}), 0, 3, 1, 0, at(0, 0, 1))});
  add("PlateLessCylinders", Op::kDifference,
      {make_extrusion(plate, 0, 0.7), make_frustum(-1, 2, 0.3, 0.3, at(0, 0, 0)),
       make_extrusion(leaves, 0.3, 2, 1, 1, at(0.1, -0.4, 0)),
       make_sphere(0.5, at(-1.5, -0.8, 0.7))});
  add("BallAndStar", Op::kIntersection,
      {make_sphere(1.5), make_extrusion(figure({star(7, 2, 1)}), -1.6, 1.6, 1, 0.5)});
  add("CubeWithFacesOfAnExtrusion", Op::kUnion,
      {cube({0, 0, 0}, {1, 1, 1}), make_extrusion(l, 0, 1), cube({1, 1, 0}, {2, 2, 1})});
  add("ExtrusionWithFacesOfACube", Op::kUnion,
      {make_extrusion(l, 0, 1), cube({0, 0, 0}, {1, 1, 1})});
  add("FlushCuts", Op::kDifference,
      {make_extrusion(l, 0, 2), cube({0, 0, 1}, {1, 1, 2}),
       make_extrusion(l, 0, 1, 1, 1, at(1, 0, 0)),
       make_extrusion(figure({circle({0.5, 1.5}, 0.4)}), 1, 2)});
  add("CylinderWithFacesOfAnExtrusion", Op::kUnion,
      {make_frustum(0, 1, 1, 0.5), make_extrusion(figure({circle({0, 0}, 1)}), 0, 1, 1, 0.5),
       make_extrusion(figure({circle({0, 0}, 0.5)}), 1, 2)});
  add("EqualExtrusions", Op::kIntersection,
      {make_extrusion(plate, 0, 1), make_extrusion(plate, 0, 1), make_extrusion(plate, 0, 2)});
  const Figure cone = figure({polygon({{0, 0}, {2, 0}, {0, 3}})});
  const Figure vase = figure({polygon({{0, 0},
                                       {1.5, 0},
                                       {2, 1},
                                       {0.8, 2.2},
                                       {1.2, 3},
                                       {1, 3},
                                       {0.6, 2.2},
                                       {1.7, 1},
                                       {1.3, 0.2},
                                       {0, 0.2}})});
  const Figure ring = figure({circle({3, 0}, 1)});
  const Figure bowl = figure({{line({1, 0}), bezier({3, 0.2}, {2.5, 2}), line({2.3, 2}),
                               bezier({2.6, 0.4}, {0, 0.4}), line({0, 0})}});
  add("Torus", Op::kUnion, {make_revolution(ring)});
  add("SkewedTorus", Op::kUnion, {make_revolution(figure({circle({2.2, 0}, 2)}), skewed())});
  add("Bowl", Op::kUnion, {make_revolution(bowl)});
  add("BowlFarFromTheOrigin", Op::kUnion, {make_revolution(bowl, at(1000, -2000, 500))});
  add("HollowTorusCutOpen", Op::kDifference,
      {make_revolution(figure({circle({3, 0}, 1), circle({3.2, 0}, 0.7)})),
       cube({-1, -5, 0.2}, {5, 5, 2})});
  add("BallOfAnArc", Op::kUnion,
      {make_revolution(figure({{arc({0, 0}, {0, 2}), line({0, -2})}})),
       make_sphere(1.5, at(1.5, 0, 0))});
  add("Cone", Op::kUnion, {make_revolution(cone)});
  add("SkewedVase", Op::kUnion, {make_revolution(vase, skewed())});
  add("VaseFarFromTheOrigin", Op::kUnion, {make_revolution(vase, at(1000, -2000, 500))});
  add("VaseCutOpen", Op::kDifference, {make_revolution(vase), cube({0, -3, -1}, {3, 0, 4})});
  add("OverlappingRings", Op::kUnion,
      {make_revolution(figure({rectangle({1, 0}, {2, 1}), rectangle({1.5, 0.5}, {3, 1.2})},
                              FillRule::kNonZero))});
  add("CrossedRings", Op::kUnion,
      {make_revolution(figure({rectangle({1, 0}, {2, 1}), rectangle({1.5, 0.5}, {3, 1.2})}))});
  add("StarRing", Op::kIntersection,
      {make_revolution(figure({translated(star(5, 1, 0.5), {2.5, 0})})),
       cube({-4, -2, -2}, {4, 4, 2})});
  add("ConeWithFacesOfAFrustum", Op::kUnion,
      {make_revolution(cone), make_frustum(0, 3, 2, 0), make_frustum(-1, 0, 2, 2)});
  add("FrustumWithFacesOfACone", Op::kUnion, {make_frustum(0, 3, 2, 0), make_revolution(cone)});
  add("BallLessRings", Op::kDifference,
      {make_sphere(3), make_revolution(vase, at(0, 0, 1)), make_revolution(cone, at(1, 0, -2)),
       make_extrusion(leaves, -4, 4)});
  return all;
}

View view_of(const LoadedScene& loaded, Projection projection, double around_deg, double above_deg,
             double distance = 2) {
  View view =
      gl_test::view_from(loaded.solid.bounds(), projection, around_deg, above_deg, distance);
  view.width_px = 160;
  view.height_px = 120;
  return view;
}

void expect_agreement(LoadedScene& loaded, const View& view, const std::string& name,
                      const gl_test::EdgeLimits& edges = kEdges) {
  gl_test::expect_agreement(loaded.draw(view), gl_test::draw_by_cpu(loaded, view), view,
                            loaded.solid.bounds().diagonal(), edges, name);
}

class ProfileTest : public testing::TestWithParam<NamedScene> {};

INSTANTIATE_TEST_SUITE_P(, ProfileTest, testing::ValuesIn(scenes()),
                         [](const auto& instance) { return instance.param.name; });

TEST_P(ProfileTest, EveryChannelIsTheTracers) {
  for (const Way& way : gl_test::all_ways()) {
    LoadedScene loaded(GetParam().scene, way);
    const std::string name = GetParam().name + ", " + gl_test::name_of(way);
    const auto perspective = Projection::kPerspective, orthographic = Projection::kOrthographic;
    expect_agreement(loaded, view_of(loaded, perspective, 25, 35), name);
    expect_agreement(loaded, view_of(loaded, orthographic, 205, -22, 1.2), name);
    expect_agreement(loaded, view_of(loaded, orthographic, 10, 90), name, kAlongAnAxis);
    expect_agreement(loaded, view_of(loaded, perspective, 90, 0), name, kAlongAnAxis);
  }
}

/// Wheels and vases: holes, curves, a scale and a revolution.
Scene parts() {
  return test_support::scene_of(
      Op::kDifference,
      {make_extrusion(figure({circle({0, 0}, 3), rectangle({-1, -1}, {1, 1}), circle({2, 0}, 0.5)}),
                      -1, 1, 1, 0.6),
       make_revolution(figure({rectangle({2.2, -0.2}, {4, 0.5})})), cube({0, -4, 0.7}, {4, 0, 2})});
}

TEST(ProfilePictureTest, EyeInsideTheSolidAHoleAndACut) {
  const Scene scene = parts();
  for (const Way& way : gl_test::all_ways()) {
    LoadedScene loaded(scene, way);
    View view = view_of(loaded, Projection::kPerspective, 30, 20);
    view.half_height = 0.7;
    for (const Vec3& eye :
         {Vec3{-1.5, 0.1, 0.2} /* in the solid */, Vec3{0.1, 0.2, 0.3} /* in the hole */,
          Vec3{-2.3, 0.1, 0.1} /* in the groove */}) {
      view.eye = eye;
      expect_agreement(loaded, view, "eye inside, " + gl_test::name_of(way));
    }
  }
}

TEST(ProfilePictureTest, WhatLiesBehindAFront) {
  for (const Way& way : gl_test::all_ways()) {
    LoadedScene loaded(parts(), way);
    const View view = view_of(loaded, Projection::kPerspective, 25, 35);
    loaded.draw(view);
    const Image behind = loaded.renderer.draw_behind(view, loaded.settings, loaded.stats);
    gl_test::expect_agreement(
        behind, gl_test::draw_by_cpu(loaded, view, csgcore::Boundary::kBehind), view,
        loaded.solid.bounds().diagonal(), kEdges, "behind, " + gl_test::name_of(way));
  }
}

/// Rays along the axis through every vertex and every edge.
TEST(ProfilePictureTest, RaysThroughVerticesAndEdgesDoNotLeak) {
  std::vector<ProfileLoop> squares;
  for (int x = 0; x < 40; ++x) {
    for (int y = 0; y < 40; ++y) {
      squares.push_back(rectangle(Vec2(x, y), Vec2(x + 1, y + 1)));
    }
  }
  const Scene scene = test_support::scene_of(
      Op::kUnion, {make_extrusion(figure(std::move(squares), FillRule::kNonZero), 0, 1)});
  for (const Way& way : gl_test::all_ways()) {
    LoadedScene loaded(scene, way);
    View view = view_of(loaded, Projection::kOrthographic, 0, 90);
    view.width_px = view.height_px = 79;  // all centres at multiples of half a unit
    view.half_height = 0.25 * view.height_px;
    view.eye = {20, 20, 10};
    view.forward = {0, 0, -1};
    view.right = {0, 1, 0};
    view.up = glm::cross(view.right, view.forward);
    const Image gl = loaded.draw(view);
    EXPECT_EQ(std::ranges::count(gl.id, 0u), 79 * 79) << gl_test::name_of(way);
    EXPECT_EQ(std::ranges::count(gl.z, 9.0f), 79 * 79) << gl_test::name_of(way);
  }
}

/// A star whose lines pass near its middle, so that a ray crosses most of them.
ProfileLoop crossed_star(int points, double radius) {
  std::vector<Vec2> corners;
  for (int i = 0; i < points; ++i) {
    const double around = glm::two_pi<double>() * (points / 2) * i / points;
    corners.push_back(radius * Vec2{std::cos(around), std::sin(around)});
  }
  return polygon(corners);
}

TEST(ProfileRoundsTest, WhereLoopsEndTooSoonTheTracerDraws) {
  // A software driver ends the loops of all pixels that it runs at once: of those too whose rays
  // cross few lines.
  const Figure star = figure({translated(crossed_star(99, 10), {40, 0})}, FillRule::kNonZero);
  const auto expect_hits_of_the_tracer = [](Primitive of_star, Primitive cut, const Way& way) {
    LoadedScene loaded(
        test_support::scene_of(Op::kIntersection, {std::move(of_star), std::move(cut)}), way);
    View view = gl_test::view_from(loaded.solid.bounds(), Projection::kPerspective, 250, 20);
    view.width_px = 24;
    view.height_px = 18;
    const Image gl = loaded.draw(view), cpu = gl_test::draw_by_cpu(loaded, view);
    uint64_t other = 0;
    for (size_t i = 0; i < cpu.z.size(); ++i) other += std::isinf(gl.z[i]) != std::isinf(cpu.z[i]);
    EXPECT_EQ(other, 0u) << gl_test::name_of(way);
  };
  expect_hits_of_the_tracer(make_revolution(star), cube({0, 0, -10}, {60, 60, 10}),
                            gl_test::leaves_of(8));
  expect_hits_of_the_tracer(make_extrusion(star, 0, 30), cube({30, 0, -1}, {60, 10, 31}),
                            gl_test::by_tiles());
}

}  // namespace
