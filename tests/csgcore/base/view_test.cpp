#include "csgcore/view.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "checks.hpp"

namespace csgcore {
namespace {

TEST(PixelRay, PerspectiveGoesThroughThePixelsCentre) {
  View view;
  view.eye = {1, 2, 3};
  view.half_height = 0.5;
  view.width_px = 4;
  view.height_px = 2;
  const Ray ray = pixel_ray(view, 0, 0);  // the top left pixel
  EXPECT_EQ(ray.origin, view.eye);
  EXPECT_EQ(ray.direction, Vec3(-1.5 * 0.5, 0.5 * 0.5, -1));
  EXPECT_EQ(pixel_ray(view, 3, 1).direction, Vec3(0.75, -0.25, -1));
  EXPECT_EQ(pixel_ray(view, 1.5, 0.5).direction, Vec3(0, 0, -1));  // the picture's middle
}

TEST(PixelRay, OrthographicMovesTheOrigin) {
  View view;
  view.projection = Projection::kOrthographic;
  view.eye = {1, 2, 3};
  view.half_height = 10;
  view.width_px = 4;
  view.height_px = 2;
  const Ray ray = pixel_ray(view, 3, 0);
  EXPECT_EQ(ray.origin, Vec3(1 + 15, 2 + 5, 3));
  EXPECT_EQ(ray.direction, Vec3(0, 0, -1));
}

/// Returns the larger side, in pixels, of the rectangle around the projections of points in the
/// box.
double sampled_size(const View& view, const Box& box, int steps) {
  double min_x = 1e300, max_x = -1e300, min_y = 1e300, max_y = -1e300;
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; j <= steps; ++j) {
      for (int k = 0; k <= steps; ++k) {
        const Vec3 offset = box.min + box.size() * Vec3(i, j, k) / double(steps) - view.eye;
        const double depth = glm::dot(offset, view.forward);
        const double scale = (view.projection == Projection::kPerspective ? 1 / depth : 1.0) *
                             view.height_px / (2 * view.half_height);
        const double x = glm::dot(offset, view.right) * scale;
        const double y = glm::dot(offset, view.up) * scale;
        min_x = std::min(min_x, x);
        max_x = std::max(max_x, x);
        min_y = std::min(min_y, y);
        max_y = std::max(max_y, y);
      }
    }
  }
  return std::max(max_x - min_x, max_y - min_y);
}

TEST(ProjectedSize, IsThatOfSampledPoints) {
  std::mt19937 random(1);
  for (int round = 0; round < 200; ++round) {
    Box box;
    box.merge(checks::random_point(random, {Vec3(-1.0), Vec3(1.0)}));
    box.merge(checks::random_point(random, {Vec3(-1.0), Vec3(1.0)}));
    View view = checks::view_of(box, checks::random_direction(random), 3);
    if (round % 2 == 0) view.projection = Projection::kOrthographic;
    const double expected = sampled_size(view, box, 5);
    EXPECT_NEAR(projected_size_px(view, box), expected, 1e-9 * expected);
    EXPECT_TRUE(projects_below(view, box, (1 + 1e-9) * expected));
    EXPECT_FALSE(projects_below(view, box, (1 - 1e-9) * expected));
  }
}

TEST(ProjectedSize, AtTheEyesPlaneAndBehind) {
  View view;  // looks along −z
  const Box in_front{{-1, -1, -3}, {1, 1, -2}};
  const Box around{{-1, -1, -3}, {1, 1, 2}};
  const Box behind{{-1, -1, 2}, {1, 1, 3}};
  EXPECT_DOUBLE_EQ(projected_size_px(view, in_front), 256);
  EXPECT_EQ(projected_size_px(view, around), std::numeric_limits<double>::infinity());
  EXPECT_EQ(projected_size_px(view, behind), 0);
  EXPECT_FALSE(projects_below(view, around, 1e9));
  EXPECT_TRUE(projects_below(view, behind, 1));
  view.projection = Projection::kOrthographic;
  EXPECT_DOUBLE_EQ(projected_size_px(view, behind), 512);
  EXPECT_DOUBLE_EQ(projected_size_px(view, around), 512);
}

}  // namespace
}  // namespace csgcore
