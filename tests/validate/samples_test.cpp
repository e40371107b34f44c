// Tests random rays, views and points, and planted errors.
#include "samples.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>

#include "csgcore/polyhedron.hpp"
#include "csgcore/solid.hpp"
#include "frontend/error.hpp"
#include "planted_error.hpp"

namespace validation {
namespace {

using csgcore::Op;
using csgcore::Projection;
using csgcore::Vec3;
using csgcore::View;

const csgcore::Box kBox{{1, 2, 3}, {3, 5, 9}};  // of diagonal 7

TEST(Samples, NumbersAreUniformAndEachHasItsOwn) {
  double sum = 0, squares = 0;
  constexpr int kCount = 100000;
  for (int i = 0; i < kCount; ++i) {
    const double x = Random(3, Random::Use::kRays, uint64_t(i)).uniform();
    ASSERT_TRUE(x >= 0 && x < 1);
    sum += x;
    squares += x * x;
  }
  EXPECT_NEAR(sum / kCount, 1.0 / 2, 0.005);
  EXPECT_NEAR(squares / kCount, 1.0 / 3, 0.005);
  const uint64_t number = Random(3, Random::Use::kRays, 5).next();
  EXPECT_EQ(number, Random(3, Random::Use::kRays, 5).next());
  EXPECT_NE(number, Random(4, Random::Use::kRays, 5).next());
  EXPECT_NE(number, Random(3, Random::Use::kViews, 5).next());
  EXPECT_NE(number, Random(3, Random::Use::kRays, 6).next());
  EXPECT_NEAR(glm::length(Random(3, Random::Use::kRays, 6).direction()), 1, 1e-15);
}

void expect_orthonormal(const View& view) {
  EXPECT_NEAR(glm::length(view.forward), 1, 1e-15);
  EXPECT_NEAR(glm::length(view.right), 1, 1e-15);
  EXPECT_NEAR(glm::length(glm::cross(view.right, view.up) + view.forward), 0, 1e-15);
}

TEST(Samples, RaysRunThroughTheBox) {
  int perspectives = 0, through = 0;
  for (uint64_t i = 0; i < 1000; ++i) {
    const View view = random_ray_view(kBox, 1, i);
    expect_orthonormal(view);
    ASSERT_EQ(view.width_px * view.height_px, 1u);
    const csgcore::Ray ray = csgcore::pixel_ray(view, 0, 0);
    EXPECT_EQ(ray.direction, view.forward);
    perspectives += view.projection == Projection::kPerspective;
    const Vec3 nearest =
        ray.origin + glm::dot(kBox.center() - ray.origin, ray.direction) * ray.direction;
    through += glm::length(nearest - kBox.center()) < 3.5;
  }
  EXPECT_EQ(perspectives, 500);
  EXPECT_GT(through, 950);
}

TEST(Samples, ViewsHoldTheBoxAndFillThePicture) {
  for (uint64_t i = 0; i < 20; ++i) {
    const View view = random_view(kBox, 1, i);
    expect_orthonormal(view);
    const double size_px = csgcore::projected_size_px(view, kBox);
    EXPECT_GT(size_px, view.height_px / 4.0);
    EXPECT_LT(size_px, 1.5 * view.height_px);
  }
}

TEST(Samples, PixelsAreAllVisitedAndScattered) {
  View view;
  for (const uint32_t width : {1u, 2u, 7u, 160u}) {
    view.width_px = width;
    view.height_px = 120;
    std::vector<uint32_t> pixels = scattered_pixels(view);
    // The first pixels are spread evenly over all eighths of the picture.
    std::vector<int> eighths(8, 0);
    for (size_t i = 0; i < pixels.size() / 2; ++i) ++eighths[8 * pixels[i] / pixels.size()];
    const auto [least, most] = std::minmax_element(eighths.begin(), eighths.end());
    EXPECT_LE(*most - *least, int(pixels.size() / 100 + 2)) << width;
    std::sort(pixels.begin(), pixels.end());
    std::vector<uint32_t> all(size_t{width} * 120);
    std::iota(all.begin(), all.end(), 0u);
    EXPECT_EQ(pixels, all);
  }
}

TEST(Samples, PointsNearSurfacesAndEdges) {
  const PointSampler points(kBox, csgcore::box_mesh(kBox), 1);
  const double diagonal = kBox.diagonal();
  const auto height = [](const Vec3& p) {  // height above the surface, in the largest coordinate
    const Vec3 above = glm::max(kBox.min - p, p - kBox.max);
    return std::max({above.x, above.y, above.z});
  };
  int inside = 0, near_edge_inside = 0, tiny = 0;
  for (uint64_t i = 0; i < 2000; ++i) {
    const double h = height(points.near_surface(i));
    EXPECT_LE(std::abs(h), 1.001 * PointSampler::kFurthest * diagonal);
    EXPECT_GE(std::abs(h), 0.5 * PointSampler::kNearest * diagonal);
    inside += h < 0;
    tiny += std::abs(h) < 1e-4 * diagonal;
    near_edge_inside += height(points.near_edge(i)) < 0;
    EXPECT_LT(height(points.in_box(i)), 0.021 * diagonal);
  }
  EXPECT_NEAR(inside, 1000, 150);
  EXPECT_GT(near_edge_inside, 300);
  EXPECT_NEAR(tiny, 1200, 150);  // 3 of 5 orders of magnitude
  // Without a boundary the points are anywhere.
  EXPECT_EQ(PointSampler(kBox, {}, 1).near_edge(4), points.in_box(4));
}

/// 0 − (1 ∪ (2 − 3)), boxes along x: 0 is [0, 8]; from 2 on, i is [i, i + 2] with half the height.
csgcore::Scene nested() {
  csgcore::Scene scene;
  const auto add = [&](double x_min, double x_max, double height) {
    scene.primitives.push_back(
        csgcore::make_polyhedron(csgcore::Polyhedron::box({{x_min, 0, 0}, {x_max, 1, height}})));
    scene.primitives.back().id = 10 + uint32_t(scene.primitives.size()) - 1;
  };
  add(0, 8, 2);
  add(1, 2, 1);
  add(2, 4, 1);
  add(3, 5, 1);
  csgcore::CsgTreeBuilder builder;
  builder.open(Op::kDifference);
  builder.primitive(0);
  builder.primitive(1);
  builder.open(Op::kDifference);
  builder.primitive(2);
  builder.primitive(3);
  builder.close();
  builder.close();
  scene.model = builder.finish();
  return scene;
}

/// Shows where the scene is solid at z = ½, in steps along x.
std::string profile(const csgcore::Scene& scene) {
  const csgcore::Solid solid(csgcore::canonical_primitives(scene), scene.model);
  std::string text;
  for (int x = 0; x < 8; ++x) text += solid.contains({x + 0.5, 0.5, 0.5}) ? '#' : '.';
  return text;
}

TEST(PlantedError, FlipsASign) {
  EXPECT_EQ(profile(nested()), "#..#####");
  EXPECT_EQ(profile(with_planted_error(nested(), "flip:10")), "........");
  EXPECT_EQ(profile(with_planted_error(nested(), "flip:11")), "##.#####");  // 1 was cut away
  EXPECT_EQ(profile(with_planted_error(nested(), "flip:12")), "#.######");
  EXPECT_EQ(profile(with_planted_error(nested(), "flip:13")), "#....###");  // 3 was added
}

TEST(PlantedError, MovesAPrimitive) {
  EXPECT_EQ(profile(with_planted_error(nested(), "move:11:4")), "##.##.##");
  for (const char* error : {"", "flip", "flip:14", "move:10", "turn:10:1"}) {
    EXPECT_THROW(with_planted_error(nested(), error), frontend::Error) << error;
  }
}

}  // namespace
}  // namespace validation
