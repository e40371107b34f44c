// Tests GL pictures against a brute-force evaluation in double per pixel.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "csgcore/phong.hpp"
#include "fixture.hpp"
#include "support/models.hpp"

namespace {

using csgcore::Affine;
using csgcore::CsgTreeBuilder;
using csgcore::Image;
using csgcore::make_frustum;
using csgcore::make_sphere;
using csgcore::Mat3;
using csgcore::Op;
using csgcore::Primitive;
using csgcore::Projection;
using csgcore::Scene;
using csgcore::SubdivisionOptions;
using csgcore::Vec3;
using csgcore::View;
using gl_test::draw;
using gl_test::expect_right;
using gl_test::leaves_of;
using gl_test::LoadedScene;
using gl_test::view_from;
using test_support::scene_of;

Affine at(double x, double y, double z) { return {Mat3{1.0}, {x, y, z}}; }

/// The parameter: tiles, or the leaf size of cells, and the projection. Every test of the suite
/// runs over all.
constexpr uint32_t kTiles = 0;
class PictureTest : public testing::TestWithParam<std::tuple<uint32_t, Projection>> {
 protected:
  gl_test::Way options() const {
    const uint32_t leaf_primitives = std::get<0>(GetParam());
    return leaf_primitives == kTiles ? gl_test::by_tiles() : leaves_of(leaf_primitives);
  }
  Projection projection() const { return std::get<1>(GetParam()); }
  void expect_right_around(const Scene& scene) const {
    expect_right(scene, view_from(scene, projection(), 25, 35), options());
    expect_right(scene, view_from(scene, projection(), 200, -20, 1.2), options());
    // Along an axis, rays lie in the planes of the cells.
    expect_right(scene, view_from(scene, projection(), 0, 90), options());
  }
};

INSTANTIATE_TEST_SUITE_P(
    , PictureTest,
    testing::Combine(testing::Values(2u, 4u, 8u, kTiles),
                     testing::Values(Projection::kPerspective, Projection::kOrthographic)),
    [](const auto& instance) {
      const uint32_t leaf_primitives = std::get<0>(instance.param);
      return (leaf_primitives == kTiles ? "Tiles" : "K" + std::to_string(leaf_primitives)) +
             (std::get<1>(instance.param) == Projection::kPerspective ? "Perspective"
                                                                      : "Orthographic");
    });

TEST_P(PictureTest, SinglePrimitives) {
  expect_right_around(scene_of(Op::kUnion, {make_sphere(3)}));
  expect_right_around(scene_of(Op::kUnion, {make_frustum(0, 5, 2, 2)}));
  expect_right_around(scene_of(Op::kUnion, {make_frustum(-1, 5, 3, 0)}));
  expect_right_around(scene_of(Op::kUnion, {make_frustum(-1, 5, 0, 3)}));
  expect_right_around(scene_of(Op::kUnion, {make_frustum(-1, 5, 1, 3)}));
  const Mat3 sheared_mirror{Vec3{-1, 0.3, 0}, Vec3{0.5, 2, 0.1}, Vec3{0, 0.7, 1}};
  expect_right_around(scene_of(Op::kUnion, {make_frustum(-1, 5, 1, 3, {sheared_mirror, Vec3{7}})}));
  expect_right_around(scene_of(Op::kUnion, {make_sphere(2, {sheared_mirror, Vec3{7, 8, 9}})}));
}

TEST_P(PictureTest, PairsOfEveryKind) {
  const Primitive ball = make_sphere(3);
  const Primitive rod = make_frustum(-5, 5, 1, 1.5, at(1, 0.5, 0));
  expect_right_around(scene_of(Op::kUnion, {ball, rod}));
  expect_right_around(scene_of(Op::kIntersection, {ball, rod}));
  expect_right_around(scene_of(Op::kDifference, {ball, rod}));
  expect_right_around(scene_of(Op::kDifference, {rod, ball}));
  // Two complements: a block with two holes, its walls far away.
  expect_right_around(
      scene_of(Op::kDifference, {make_frustum(-4, 4, 9, 9), make_sphere(2, at(3, 0, 3)),
                                 make_frustum(-9, 9, 1, 1, at(2, 1, 0))}));
}

TEST_P(PictureTest, RandomTrees) {
  for (uint32_t seed = 1; seed <= 4; ++seed) {
    const Scene scene = test_support::random_tree(4 + 5 * seed, seed);
    if (csgcore::reference_box(scene).empty()) continue;
    SCOPED_TRACE(seed);
    expect_right(scene, view_from(scene, projection(), 40.0 * seed, 30), options());
  }
}

TEST_P(PictureTest, CylinderMinusMany) {
  const Scene spheres = test_support::cylinder_minus_spheres(300);
  expect_right(spheres, view_from(spheres, projection(), 25, 35), options());
  const Scene cones = test_support::cylinder_minus_cones(100);
  expect_right(cones, view_from(cones, projection(), 25, 35), options());
}

TEST_P(PictureTest, EyeInsideTheModelACellAndACut) {
  const Scene scene = scene_of(
      Op::kDifference, {make_frustum(-5, 5, 6, 6), make_sphere(3, at(2, 0, 0)),
                        make_frustum(-9, 9, 1, 1, at(-3, 0, 0)), make_sphere(1, at(0, 4, 0))});
  View view = view_from(scene, projection(), 30, 20);
  if (projection() == Projection::kPerspective) view.half_height = 0.7;
  for (const Vec3& eye : {Vec3{2, 0, 0} /* in a cut */, Vec3{0, -4, 1} /* in the solid */,
                          Vec3{-3, 0, 8} /* in the box */, Vec3{-3, 0, 4.9}}) {
    view.eye = eye;
    expect_right(scene, view, options());
  }
}

TEST_P(PictureTest, PixelsOnTheMiddlePlanes) {
  // The number of pixels is odd: the middle rays lie exactly in the planes that divide the model.
  const Scene scene = test_support::cylinder_minus_spheres(60);
  View view = view_from(scene, projection(), 0, 90);
  view.width_px = 241;
  view.height_px = 181;
  gl_test::Way middle = options();
  middle.options.split = csgcore::SplitRule::kCyclic;
  expect_right(scene, view, middle);
}

TEST_P(PictureTest, FarFromTheOrigin) {
  Scene scene = test_support::cylinder_minus_spheres(50);
  for (Primitive& primitive : scene.primitives) {
    primitive.local_to_world.translation += Vec3{1e7, -1e7, 1e7};
  }
  expect_right(scene, view_from(scene, projection(), 25, 35), options());
}

TEST_P(PictureTest, FarEye) {
  const Scene scene = test_support::cylinder_minus_spheres(50);
  expect_right(scene, view_from(scene, projection(), 25, 35, 10000), options());
}

TEST_P(PictureTest, MoreThanKSurfacesThroughOnePointAndCoincidentOnes) {
  // 12 cylinders through the origin, and 12 equal spheres around it.
  std::vector<Primitive> primitives{make_sphere(5)};
  for (int i = 0; i < 12; ++i) {
    const double angle = i * std::numbers::pi / 12;
    const Mat3 turned{Vec3{std::cos(angle), 0, std::sin(angle)}, Vec3{0, 1, 0},
                      Vec3{-std::sin(angle), 0, std::cos(angle)}};
    primitives.push_back(make_frustum(0, 9, 1, 1, {turned, Vec3{0}}));
  }
  expect_right_around(scene_of(Op::kDifference, primitives));
  const Scene equal = scene_of(Op::kIntersection, std::vector<Primitive>(12, make_sphere(4)));
  const View view = view_from(equal, projection(), 25, 35);
  const auto result =
      gl_test::compare(draw(equal, view, options()), csgcore::reference_render(equal, view), 8);
  EXPECT_GT(result.hits, 1000u);
  EXPECT_EQ(result.wrong(), 0u) << result.first;  // any of the twelve may be hit
}

TEST_P(PictureTest, EmptyAndInvisible) {
  const Scene nothing = scene_of(Op::kIntersection, {make_sphere(1), make_sphere(1, at(5, 0, 0))});
  View view;
  view.projection = projection();
  view.eye = {0, 0, 20};
  view.half_height = 0.5;
  for (const float z : draw(nothing, view, options()).z) ASSERT_TRUE(std::isinf(z));
  const Scene behind = scene_of(Op::kUnion, {make_sphere(1, at(0, 0, 50))});
  const Image image = draw(behind, view, options());
  const bool any =
      std::any_of(image.z.begin(), image.z.end(), [](float z) { return std::isfinite(z); });
  // An orthographic picture also shows what lies behind the eye.
  EXPECT_EQ(any, projection() == Projection::kOrthographic);
}

TEST(RendererTest, MeasuredChannelsAgreeWithEachOther) {
  const Scene scene = test_support::cylinder_minus_spheres(40);
  const View view = view_from(scene, Projection::kPerspective, 25, 35);
  const Image image = draw(scene, view, leaves_of(8));
  for (uint32_t y = 0; y < view.height_px; ++y) {
    for (uint32_t x = 0; x < view.width_px; ++x) {
      const size_t i = size_t{y} * view.width_px + x;
      if (std::isinf(image.z[i])) {
        ASSERT_EQ(image.id[i], csgcore::kNoPrimitive);
        ASSERT_EQ(image.normal[i], glm::vec3(0.0f));
        continue;
      }
      const csgcore::Ray ray = csgcore::pixel_ray(view, x, y);
      const Vec3 expected = ray.origin + double(image.z[i]) * ray.direction;
      ASSERT_LT(glm::length(Vec3(image.position[i]) - expected), 1e-5);
      ASSERT_NEAR(glm::length(image.normal[i]), 1.0, 1e-5);
      ASSERT_LT(glm::dot(Vec3(image.normal[i]), ray.direction), 1e-3);  // seen from outside
      ASSERT_LT(image.id[i], scene.primitives.size());
    }
  }
}

/// Returns the colour of the pixel in the middle.
std::array<uint8_t, 3> middle(const Image& image) {
  return image.rgb[size_t{image.height_px / 2} * image.width_px + image.width_px / 2];
}

class ColorTest : public testing::TestWithParam<gl_test::Way> {
 protected:
  Image draw_with(const Scene& scene, const View& view, glrender::Shading shading) {
    LoadedScene loaded(scene, GetParam());
    loaded.settings.background = glm::vec3(0xff, 0xff, 0xe5) / 255.0f;
    loaded.settings.front = glm::vec3(0xf9, 0xd7, 0x2c) / 255.0f;
    loaded.settings.back = glm::vec3(0x9d, 0xcb, 0x51) / 255.0f;
    loaded.settings.shading = shading;
    loaded.settings.measured_channels = false;
    return loaded.draw(view);
  }
  View from_above() {
    View view;
    view.projection = Projection::kOrthographic;
    view.eye = {0, 0, 50};
    view.half_height = 10;
    view.width_px = view.height_px = 101;
    return view;
  }
};

INSTANTIATE_TEST_SUITE_P(, ColorTest,
                         testing::Values(gl_test::Way(leaves_of(8)), gl_test::by_tiles()),
                         gl_test::test_name);

TEST_P(ColorTest, OpenScadShading) {
  // A face towards the eye: n = (0, 0, 1), rgb · (0.2 + 1/√3).
  const double light = 0.2 + 1 / std::sqrt(3.0);
  const auto lit = [&](int channel) { return std::min(255.0, channel * light); };
  const Scene plain = scene_of(Op::kUnion, {make_frustum(0, 1, 5, 5)});
  const auto front = middle(draw_with(plain, from_above(), glrender::Shading::kOpenScad));
  EXPECT_NEAR(front[0], lit(0xf9), 1);
  EXPECT_NEAR(front[1], lit(0xd7), 1);
  EXPECT_NEAR(front[2], lit(0x2c), 1);
  // A cut face has the scheme's back colour, or the cutting object's own.
  Scene cut = scene_of(Op::kDifference, {make_frustum(0, 5, 5, 5), make_frustum(2, 9, 2, 2)});
  const auto back = middle(draw_with(cut, from_above(), glrender::Shading::kOpenScad));
  EXPECT_NEAR(back[0], lit(0x9d), 1);
  cut.primitives[1].color = csgcore::Color{0, 0, 1, 1};
  const auto blue = middle(draw_with(cut, from_above(), glrender::Shading::kOpenScad));
  EXPECT_EQ(blue[0], 0);
  EXPECT_NEAR(blue[2], lit(255), 1);
  const Image image = draw_with(cut, from_above(), glrender::Shading::kOpenScad);
  EXPECT_EQ(image.rgb[0], (std::array<uint8_t, 3>{0xff, 0xff, 0xe5}));
}

TEST_P(ColorTest, PhongShading) {
  const Scene ball = scene_of(Op::kUnion, {make_sphere(5)});
  const View view = from_above();
  const Image image = draw_with(ball, view, glrender::Shading::kPhong);
  const csgcore::PhongLight light = csgcore::phong_light(view, csgcore::reference_box(ball));
  for (const int x : {30, 50, 60, 70}) {
    const csgcore::Ray ray = csgcore::pixel_ray(view, x, 45);
    const double z = std::sqrt(25 - ray.origin.x * ray.origin.x - ray.origin.y * ray.origin.y);
    const Vec3 point{ray.origin.x, ray.origin.y, z};
    const Vec3 expected = csgcore::phong_color(Vec3(0xf9, 0xd7, 0x2c) / 255.0, point, point / 5.0,
                                               ray.direction, light);
    for (int channel = 0; channel < 3; ++channel) {
      EXPECT_NEAR(image.rgb[size_t{45} * 101 + x][channel], 255 * expected[channel], 1.01) << x;
    }
  }
}

TEST(RendererTest, DrawCallsDoNotGrowWithCells) {
  const auto drawn = [](uint32_t spheres) {
    const Scene scene = test_support::cylinder_minus_spheres(spheres);
    LoadedScene loaded(scene, leaves_of(2));
    loaded.draw(view_from(scene, Projection::kPerspective, 25, 35));
    return loaded.stats;
  };
  const glrender::FrameStats few = drawn(20);
  const glrender::FrameStats many = drawn(2000);
  EXPECT_GT(many.cells_drawn, 10 * few.cells_drawn);
  EXPECT_LE(many.draw_calls, 5u);
  EXPECT_LE(few.draw_calls, 5u);
}

TEST(RendererTest, NorWithTiles) {
  const auto drawn = [](uint32_t spheres) {
    const Scene scene = test_support::cylinder_minus_spheres(spheres);
    LoadedScene loaded(scene, gl_test::by_tiles());
    loaded.draw(view_from(scene, Projection::kPerspective, 25, 35));
    return loaded.stats;
  };
  for (const uint32_t spheres : {20, 2000}) {
    const glrender::FrameStats stats = drawn(spheres);
    EXPECT_GT(stats.tiles_drawn, 100u);
    EXPECT_EQ(stats.cells_drawn, 0u);
    EXPECT_LE(stats.draw_calls, 3u);
  }
}

/// Lists of up to 120 balls, each of which is seen somewhere.
TEST(RendererTest, LongListsOfTiles) {
  // Neighbours cross at 2° and less. Along a seam, where they are within the tolerance of each
  // other, either of them may show.
  constexpr double kTolerance = 2 * 0x1p-21 * 18;
  for (const int balls : {33, 60, 120}) {
    std::vector<Primitive> primitives{make_frustum(-4, 4, 9, 9), make_frustum(-6, 4, 9, 9)};
    for (int i = 0; i < balls; ++i) {
      const double angle = 2 * std::numbers::pi * i / balls;
      primitives.push_back(make_sphere(5, at(0.8 * std::cos(angle), 0.8 * std::sin(angle), 0)));
    }
    const Scene scene = scene_of(Op::kIntersection, primitives);
    SCOPED_TRACE(balls);
    for (const Projection projection : {Projection::kPerspective, Projection::kOrthographic}) {
      const View view = view_from(scene, projection, 25, 50);
      const Image picture = draw(scene, view, gl_test::by_tiles());
      const Image oracle = csgcore::reference_render(scene, view);
      const gl_test::Comparison result = gl_test::compare(picture, oracle, 10);
      EXPECT_GT(result.hits, 10'000u);
      EXPECT_EQ(result.wrong(), 0u) << result.first;
      EXPECT_LE(result.normal * 1000, result.hits);
      for (size_t i = 0; i < picture.id.size(); ++i) {
        ASSERT_NE(picture.id[i], 0u) << i;  // its top is the second rod's, too
        if (picture.id[i] == oracle.id[i] || picture.id[i] == 1) continue;
        const Vec3 center = primitives[picture.id[i]].local_to_world.translation;
        ASSERT_NEAR(glm::length(Vec3(oracle.position[i]) - center), 5, kTolerance) << i;
      }
    }
  }
}

TEST(RendererTest, AnotherAngleNeedsNoSubdivision) {
  const Scene scene = test_support::cylinder_minus_spheres(200);
  const View far = view_from(scene, Projection::kPerspective, 25, 35, 6);
  View near = view_from(scene, Projection::kPerspective, 120, 10, 2);
  LoadedScene loaded(scene, SubdivisionOptions::paper(2, far));
  const Image oracle = csgcore::reference_render(scene, near);
  const double size = csgcore::reference_box(scene).diagonal();
  const auto before = gl_test::compare(loaded.draw(near), oracle, size);
  near.half_height /= 4;
  const Image zoomed_oracle = csgcore::reference_render(scene, near);
  const auto zoomed = gl_test::compare(loaded.draw(near), zoomed_oracle, size);
  // Cells that were dropped for the old view are subdivided further if the new view shows them
  // larger.
  EXPECT_TRUE(loaded.subdivision.refine(near));
  loaded.renderer.load(loaded.subdivision);
  const auto refined = gl_test::compare(loaded.draw(near), zoomed_oracle, size);
  EXPECT_LT(before.wrong() * 20, before.hits);
  EXPECT_LT(refined.wrong() * 4, zoomed.wrong());
}

TEST(RendererTest, DrawsWhatLiesBehindAFront) {
  const Scene scene = scene_of(Op::kUnion, {make_sphere(5), make_sphere(5, at(3, 0, 0))});
  View view;
  view.projection = Projection::kOrthographic;
  view.eye = {0, 0, 50};
  view.half_height = 10;
  view.width_px = view.height_px = 64;
  for (const gl_test::Way& way : {gl_test::Way(leaves_of(8)), gl_test::by_tiles()}) {
    SCOPED_TRACE(gl_test::name_of(way));
    LoadedScene loaded(scene, way);
    const Image front = loaded.draw(view);
    const Image behind = loaded.renderer.draw_behind(view, loaded.settings, loaded.stats);
    for (size_t i = 0; i < front.z.size(); ++i) {
      ASSERT_EQ(std::isinf(front.z[i]), std::isinf(behind.z[i])) << i;
      // The model is symmetric about z = 0, which is at depth 50.
      if (!std::isinf(front.z[i])) {
        ASSERT_NEAR(front.z[i] + behind.z[i], 100, 1e-3) << i;
      }
    }
  }
}

TEST(RendererTest, RefusesWhatAShaderCannotEvaluate) {
  std::vector<Primitive> spheres;
  for (int i = 0; i < 40000; ++i) spheres.push_back(make_sphere(1 + 1e-6 * i));  // none are equal
  const Scene scene = scene_of(Op::kIntersection, std::move(spheres));
  const View view = view_from(scene, Projection::kPerspective, 0, 0);
  EXPECT_THROW(draw(scene, view, leaves_of(8)), glrender::GlError);
  EXPECT_THROW(draw(scene, view, gl_test::by_tiles()), glrender::ListsTooLong);
}

TEST(RendererTest, RefusesPicturesThatTheDriverCannotMake) {
  const Scene scene = scene_of(Op::kUnion, {make_sphere(1)});
  View view = view_from(scene, Projection::kPerspective, 0, 0);
  view.width_px = 1'000'000;
  EXPECT_THROW(draw(scene, view, leaves_of(8)), glrender::GlError);
}

}  // namespace
