// Tests the oracle itself against hits computed by hand and against point membership.
#include "reference.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <random>

#include "evaluate_tree.hpp"
#include "full_run.hpp"
#include "kinds/test_kind.hpp"

namespace csgcore {
namespace {

constexpr uint32_t kCenter = 32 * 65 + 32;  // the middle pixel of a 65×65 picture

Primitive sphere(double radius, Vec3 at = Vec3(0.0), uint32_t id = 0) {
  Primitive p = make_sphere(radius, {Mat3(1.0), at});
  p.id = id;
  return p;
}

Primitive frustum(double z_min, double z_max, double r_bottom, double r_top, uint32_t id = 0) {
  Primitive p = make_frustum(z_min, z_max, r_bottom, r_top);
  p.id = id;
  return p;
}

Scene scene_of(Op op, std::vector<Primitive> primitives) {
  Scene scene;
  CsgTreeBuilder builder;
  builder.open(op);
  for (uint32_t i = 0; i < primitives.size(); ++i) builder.primitive(i);
  builder.close();
  scene.model = builder.finish();
  scene.primitives = std::move(primitives);
  return scene;
}

/// Looks from (0, 0, height) straight down; y is up in the picture.
View from_above(double height, Projection projection = Projection::kPerspective) {
  View view;
  view.projection = projection;
  view.eye = {0, 0, height};
  view.half_height = projection == Projection::kPerspective ? 0.5 : 2;
  view.width_px = view.height_px = 65;
  return view;
}

/// Returns the middle row as text: `#` is a hit.
std::string middle_row(const Image& image) {
  std::string row;
  for (uint32_t x = 0; x < image.width_px; ++x) {
    row += image.id[32 * image.width_px + x] == kNoPrimitive ? '.' : '#';
  }
  return row;
}

TEST(Reference, SphereFromOutside) {
  const Image image =
      reference_render(scene_of(Op::kUnion, {sphere(1, {0, 0, 0}, 7)}), from_above(5));
  EXPECT_FLOAT_EQ(image.z[kCenter], 4);
  EXPECT_FLOAT_EQ(image.normal[kCenter].z, 1);
  EXPECT_FLOAT_EQ(image.position[kCenter].z, 1);
  EXPECT_EQ(image.id[kCenter], 7u);
  EXPECT_EQ(image.rgb[kCenter][0], 255);
  // The tangent of the silhouette's angle is 1/√24, and a pixel is 1/65 wide: half of the radius is
  // 26.5 pixels.
  const double radius_px = 65 / std::sqrt(24.0);
  const std::string row = middle_row(image);
  EXPECT_EQ(std::count(row.begin(), row.end(), '#'), 2 * std::floor(radius_px) + 1);
  EXPECT_EQ(image.id[0], kNoPrimitive);
  EXPECT_TRUE(std::isinf(image.z[0]));
}

TEST(Reference, EyeInsideSeesTheBackFaceWithItsOutwardNormal) {
  const Image image = reference_render(scene_of(Op::kUnion, {sphere(1)}), from_above(0.25));
  EXPECT_FLOAT_EQ(image.z[kCenter], 1.25);
  EXPECT_FLOAT_EQ(image.normal[kCenter].z, -1);
}

TEST(Reference, PerspectiveSeesNothingBehindTheEyeAndOrthographicDoes) {
  const Scene scene = scene_of(Op::kUnion, {sphere(1)});
  EXPECT_EQ(reference_render(scene, from_above(-5)).id[kCenter], kNoPrimitive);
  const Image image = reference_render(scene, from_above(-5, Projection::kOrthographic));
  EXPECT_FLOAT_EQ(image.z[kCenter], -6);
  EXPECT_FLOAT_EQ(image.normal[kCenter].z, 1);
  const std::string row = middle_row(image);  // radius 1 of a half height of 2
  EXPECT_EQ(std::count(row.begin(), row.end(), '#'), 33);
}

TEST(Reference, ASubtractedFaceShowsTheCuttersInside) {
  const Scene scene = scene_of(Op::kDifference, {sphere(1), sphere(0.5, {0, 0, 1}, 3)});
  const Image image = reference_render(scene, from_above(5));
  EXPECT_FLOAT_EQ(image.z[kCenter], 4.5);
  EXPECT_FLOAT_EQ(image.normal[kCenter].z, 1);
  EXPECT_EQ(image.id[kCenter], 3u);
  EXPECT_THAT(subtracted_primitives(scene), testing::ElementsAre(false, true));
}

TEST(Reference, EyeInsideACutSeesItsWalls) {
  const Scene scene = scene_of(Op::kDifference, {sphere(1), sphere(0.5, {0, 0, 0}, 3)});
  const Image image = reference_render(scene, from_above(0.25));
  EXPECT_FLOAT_EQ(image.z[kCenter], 0.75);
  EXPECT_FLOAT_EQ(image.normal[kCenter].z, 1);
  EXPECT_EQ(image.id[kCenter], 3u);
}

TEST(Reference, ConeAlongAndAcrossItsAxis) {
  const Scene scene = scene_of(Op::kUnion, {frustum(0, 2, 1, 0)});
  const Image above = reference_render(scene, from_above(5, Projection::kOrthographic));
  EXPECT_FLOAT_EQ(above.z[kCenter], 3);
  // 8 pixels to the right, x = 8·4/65; there the cone is 2·(1 − x) high and its normal is (2, 0,
  // 1)/√5.
  const double x = 8 * 4.0 / 65;
  EXPECT_NEAR(above.position[kCenter + 8].z, 2 * (1 - x), 1e-6);
  EXPECT_NEAR(above.normal[kCenter + 8].x, 2 / std::sqrt(5.0), 1e-6);
  EXPECT_NEAR(above.normal[kCenter + 8].z, 1 / std::sqrt(5.0), 1e-6);
  const Image below = reference_render(scene, [] {
    View view = from_above(-5, Projection::kPerspective);
    view.up = -view.up;
    view.forward = -view.forward;
    return view;
  }());
  EXPECT_FLOAT_EQ(below.z[kCenter], 5);
  EXPECT_FLOAT_EQ(below.normal[kCenter].z, -1);
}

TEST(Reference, CoincidentFacesLeaveNoSkin) {
  // Both caps and a part of the walls coincide, up to rounding in differently rotated frames.
  Primitive outer = frustum(0, 1, 1, 1), inner = frustum(0, 1, 0.5, 0.5, 1);
  const double angle = 0.3;
  const Mat3 turn(1, 0, 0, 0, std::cos(angle), std::sin(angle), 0, -std::sin(angle),
                  std::cos(angle));
  outer.local_to_world.linear = inner.local_to_world.linear = turn;
  inner.local_to_world.translation = Vec3(1e-13, -1e-13, 1e-12);
  View view = from_above(5);
  const Image ring = reference_render(scene_of(Op::kDifference, {outer, inner}), view);
  EXPECT_EQ(ring.id[kCenter], kNoPrimitive);
  EXPECT_NE(ring.id[kCenter + 10], kNoPrimitive);
  const Image nothing = reference_render(scene_of(Op::kDifference, {outer, outer}), view);
  EXPECT_THAT(nothing.id, testing::Each(kNoPrimitive));
  // This shell is thicker than the tolerance, and so exists.
  inner.local_to_world.translation = Vec3(0, 0, -1e-6);
  const Image shell = reference_render(scene_of(Op::kDifference, {outer, inner}), view);
  EXPECT_EQ(shell.id[kCenter], 0u);
}

TEST(Reference, NormalsUnderAShear) {
  // x' = x + z/2: points of the ellipsoid satisfy (x − z/2)² + y² + z² = 1.
  Primitive ball = sphere(1);
  ball.local_to_world.linear[2] = {0.5, 0, 1};
  const Image image =
      reference_render(scene_of(Op::kUnion, {ball}), from_above(5, Projection::kOrthographic));
  const glm::vec3 at = image.position[kCenter + 5];
  const float x = at.x - at.z / 2;
  const glm::vec3 gradient = glm::normalize(glm::vec3(x, at.y, at.z - x / 2));
  EXPECT_NEAR(image.normal[kCenter + 5].x, gradient.x, 1e-6);
  EXPECT_NEAR(image.normal[kCenter + 5].z, gradient.z, 1e-6);
}

TEST(Reference, AGapOfRoundingIsClosed) {
  const Scene scene = scene_of(Op::kUnion, {frustum(0, 1, 1, 1), frustum(1 + 1e-12, 2, 1, 1, 1)});
  const Image image = reference_render(scene, from_above(1.5));  // inside the upper one
  EXPECT_FLOAT_EQ(image.z[kCenter], 1.5);                        // sees the lower one's far cap
  EXPECT_EQ(image.id[kCenter], 0u);
}

TEST(Reference, FarEyeKeepsPrecision) {
  const Scene scene = scene_of(Op::kUnion, {frustum(0, 2, 1, 0)});
  View view = from_above(1e9);
  view.half_height = 2e-9;
  const Image image = reference_render(scene, view);
  const double x = 8 * 4.0 / 65;
  EXPECT_NEAR(image.position[kCenter + 8].z, 2 * (1 - x), 1e-5);
}

TEST(Reference, PhongColoursOfFrontAndCutFaces) {
  Scene scene = scene_of(Op::kDifference, {sphere(1), sphere(0.5, {0, 0, 1}, 1)});
  const View view = from_above(5);
  Image image = reference_render(scene, view);
  const PhongLight light{view.eye};
  const ReferenceColors colors{.background = {0, 0, 1}, .front = {1, 0, 0}, .back = {0, 0.5, 0}};
  reference_shade_phong(image, scene, view, light, colors);
  // Light, eye and normal are in line: 0.2 + 0.7 of the colour, plus 0.3.
  EXPECT_THAT(image.rgb[kCenter], testing::ElementsAre(77, 191, 77));
  EXPECT_THAT(image.rgb[0], testing::ElementsAre(0, 0, 255));
  scene.primitives[1].color = Color{1, 1, 1, 1};
  reference_shade_phong(image, scene, view, light, colors);
  EXPECT_THAT(image.rgb[kCenter], testing::ElementsAre(255, 255, 255));
}

TEST(PhongLight, StandsLeftOfAndAboveTheEye) {
  Box box;
  box.merge(Vec3(-1.0));
  box.merge(Vec3(1.0));
  EXPECT_EQ(phong_light(from_above(10), box).position_world, Vec3(-5, 5, 10));
  EXPECT_EQ(phong_light(from_above(-10), box).position_world, Vec3(-5, 5, -10));
  EXPECT_EQ(phong_light(from_above(10), Box{}).position_world, Vec3(0, 0, 10));
}

TEST(Reference, BoxOfTheModelFollowsTheOperations) {
  const Box cut = reference_box(scene_of(Op::kDifference, {sphere(1), sphere(9)}));
  EXPECT_EQ(cut.max, Vec3(1.0));
  const Box both = reference_box(scene_of(Op::kUnion, {sphere(1), sphere(1, {3, 0, 0})}));
  EXPECT_EQ(both.max, Vec3(4, 1, 1));
  const Box common = reference_box(scene_of(Op::kIntersection, {sphere(1), sphere(1, {1, 0, 0})}));
  EXPECT_EQ(common.min, Vec3(0, -1, -1));
  EXPECT_EQ(common.max, Vec3(1, 1, 1));
}

// --- Random trees against point membership ---

bool contains(const Scene& scene, const Vec3& point) {
  return test_support::evaluate_tree(scene.model.tokens(), [&](uint32_t i) {
    return test_support::holds(scene.primitives[i], point);
  });
}

class RandomScene {
 public:
  explicit RandomScene(uint32_t seed) : random_(seed) {}

  Scene make() {
    builder_.open(Op::kUnion);
    for (int i = 0; i < 3; ++i) add(3);
    builder_.close();
    scene_.model = builder_.finish();
    return std::move(scene_);
  }

 private:
  double number(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  void add(int levels) {  // its depth is bounded by the test, not by an input's nesting
    if (levels == 0 || number(0, 1) < 0.2) return leaf();
    builder_.open(Op(random_() % 3));
    const int operands = 2 + int(random_() % 3);
    for (int i = 0; i < operands; ++i) add(levels - 1);
    builder_.close();
  }
  void leaf() {
    Affine map;
    for (int column = 0; column < 3; ++column) {
      for (int row = 0; row < 3; ++row) {
        map.linear[column][row] = number(-0.6, 0.6) + (column == row);
      }
      map.translation[column] = number(-0.7, 0.7);
    }
    test_support::Sizes sizes(random_, {.low = 0.2, .high = 1});
    Primitive p = test_support::random_primitive(sizes, map);
    p.id = uint32_t(scene_.primitives.size());
    builder_.primitive(p.id);
    scene_.primitives.push_back(p);
  }

  std::mt19937 random_;
  CsgTreeBuilder builder_;
  Scene scene_;
};

/// At the hit membership changes from outside to inside (or back, if the eye is inside), and
/// nowhere before.
void check_pixel(const Scene& scene, const Vec3& origin, const Vec3& direction, double from,
                 double z, bool eye_inside) {
  constexpr double kFar = 8;       // beyond the end of every scene
  constexpr double kNudge = 1e-5;  // distance from the hit; float's rounding of z is 1e-6
  constexpr int kSteps = 300;
  const double end = std::isinf(z) ? kFar : z - kNudge;
  for (int i = 0; i < kSteps; ++i) {
    const double s = from + (end - from) * (i + 0.5) / kSteps;
    ASSERT_EQ(contains(scene, origin + s * direction), eye_inside) << "at " << s << ", hit " << z;
  }
  if (std::isinf(z)) return;
  ASSERT_EQ(contains(scene, origin + (z + kNudge) * direction), !eye_inside) << "hit " << z;
}

TEST(Reference, AgreesWithPointMembershipOnRandomTrees) {
  int hits = 0, inside = 0;
  const uint32_t seeds = test_support::full_run() ? 60 : 12;
  for (uint32_t seed = 0; seed < seeds; ++seed) {
    const Scene scene = RandomScene(seed).make();
    View view = from_above(seed % 3 == 0 ? 0.1 : 4,
                           seed % 2 ? Projection::kPerspective : Projection::kOrthographic);
    const bool orthographic = view.projection == Projection::kOrthographic;
    const Image image = reference_render(scene, view);
    // Whether a mesh contains a point is asked of all its triangles.
    const bool is_slow = std::any_of(scene.primitives.begin(), scene.primitives.end(),
                                     [](const Primitive& p) { return p.mesh() != nullptr; });
    for (uint32_t i = 0; i < image.id.size(); i += is_slow ? 251 : 37) {
      const double u = (2 * (i % 65 + 0.5) - 65) / 65 * view.half_height;
      const double v = (65 - 2 * (i / 65 + 0.5)) / 65 * view.half_height;
      const Vec3 offset = u * view.right + v * view.up;
      const Vec3 origin = orthographic ? view.eye + offset : view.eye;
      const Vec3 direction = orthographic ? view.forward : view.forward + offset;
      const bool eye_inside = !orthographic && contains(scene, view.eye);
      SCOPED_TRACE(testing::Message() << "seed " << seed << " pixel " << i);
      check_pixel(scene, origin, direction, orthographic ? -8 : 1e-6, image.z[i], eye_inside);
      if (HasFatalFailure()) return;
      hits += image.id[i] != kNoPrimitive;
      inside += eye_inside;
    }
  }
  EXPECT_GT(hits, 60);  // the scenes must have been hit
  EXPECT_GT(inside, 8);
}

}  // namespace
}  // namespace csgcore
