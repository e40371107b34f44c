// Tests the camera under the mouse with OpenSCAD's numbers (frontend/OPENSCAD.md, "Window"), and
// where a point is seen.
#include "navigation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

#include "projection.hpp"

namespace window {
namespace {

using csgcore::Projection;
using csgcore::Vec3;
using frontend::Camera;

constexpr Size kSize{640, 480};
constexpr Projection kProjections[] = {Projection::kPerspective, Projection::kOrthographic};

void expect_near(const Vec3& a, const Vec3& b, double error = 1e-12) {
  EXPECT_LE(glm::length(a - b), error * (1 + glm::length(b)))
      << a.x << ' ' << a.y << ' ' << a.z << " instead of " << b.x << ' ' << b.y << ' ' << b.z;
}

/// A camera whose numbers are different on all axes.
Navigation tilted(Projection projection = Projection::kPerspective) {
  return {Camera{{1, -2, 3}, {40, 10, 70}, 90}, projection};
}

TEST(Navigation, BeginsAtAPositiveDistance) {
  for (const auto& [given, taken] :
       {std::pair(-90.0, 90.0), {0.0, 140.0}, {std::numeric_limits<double>::infinity(), 1e90}}) {
    Navigation navigation({{1, -2, 3}, {40, 10, 70}, given}, Projection::kOrthographic);
    EXPECT_EQ(navigation.camera().distance, taken);
    navigation.zoom(1, 10, 20, kSize);
    navigation.pan(10, 20, kSize);
    EXPECT_GT(navigation.camera().distance, 0);
    EXPECT_TRUE(std::isfinite(navigation.camera().target.x));
  }
}

TEST(Navigation, ADragTurnsBySevenTenthsOfADegreeAPixel) {
  Navigation navigation = tilted();
  navigation.turn(10, 20, false);
  expect_near(navigation.camera().rotation_deg, {40 - 14, 10, 70 - 7});
  navigation.turn(-30, 0, true);
  expect_near(navigation.camera().rotation_deg, {26, 31, 63});
  EXPECT_EQ(navigation.camera().target, tilted().camera().target);
  EXPECT_EQ(navigation.camera().distance, 90);
}

TEST(Navigation, AnglesStayWithinAFullTurn) {
  Navigation navigation = tilted();
  navigation.turn(1000, 100, false);
  navigation.turn(-2000, 0, true);
  expect_near(navigation.camera().rotation_deg,
              {40 - 70 + 360, 10 + 1400 - 3 * 360, 70 - 700 + 2 * 360}, 1e-11);
}

TEST(Navigation, WhatIsPannedStaysUnderTheMouse) {
  for (const Projection projection : kProjections) {
    for (const double depth : {20.0, 90.0, 300.0}) {
      Navigation navigation = tilted(projection);
      const csgcore::Ray ray = csgcore::pixel_ray(navigation.view(kSize), 200.5, 100.5);
      const Vec3 point = ray.origin + depth * ray.direction;
      navigation.pan(64, -24, kSize, depth);
      const auto place = project(navigation.view(kSize), point);
      ASSERT_TRUE(place);
      EXPECT_NEAR(place->x_px, 201 + 64, 1e-9);
      EXPECT_NEAR(place->y_px, 101 - 24, 1e-9);
    }
    Navigation target = tilted(projection);
    target.pan(64, -24, kSize);
    const auto place = project(target.view(kSize), tilted().camera().target);
    ASSERT_TRUE(place);
    EXPECT_NEAR(place->x_px, 320 + 64, 1e-9);
    EXPECT_NEAR(place->y_px, 240 - 24, 1e-9);
  }
}

/// In OpenSCAD a drag across the whole picture pans by 3·0.7 of the distance.
TEST(Navigation, PansAsFarAsOpenScad) {
  for (const Projection projection : kProjections) {
    Navigation navigation = tilted(projection);
    const csgcore::View view = navigation.view(kSize);
    navigation.pan_far(64, -24, kSize);
    const Vec3 moved = navigation.camera().target - tilted().camera().target;
    expect_near(moved, 2.1 * 90 * (-0.1 * view.right - 0.05 * view.up));
    // The point that was in the middle is now to the right of it, and above.
    const auto place = project(navigation.view(kSize), tilted().camera().target);
    ASSERT_TRUE(place);
    EXPECT_GT(place->x_px, 320);
    EXPECT_LT(place->y_px, 240);
  }
}

/// The depth becomes known in the middle of the drag; and the wheel may turn meanwhile.
TEST(Pan, IsCorrectedOnceTheDepthIsKnown) {
  const Navigation start = tilted();
  Pan pan{1, start, start, 0, 0, start.camera().distance};
  Navigation now = pan.move(pan.move(start, 10, 5, kSize), 20, -8, kSize);
  pan.depth = 50;
  now = pan.move(now, 0, 0, kSize);
  Navigation wanted = start;
  wanted.pan(30, -3, kSize, 50);
  EXPECT_EQ(now, wanted);
  now.zoom(1);
  wanted = now;
  wanted.pan(7, 7, kSize, 50);
  EXPECT_EQ(pan.move(now, 7, 7, kSize), wanted);
}

TEST(Navigation, ForwardAndBack) {
  Navigation navigation = tilted();
  const Vec3 forward = navigation.view(kSize).forward;
  navigation.move_along(48, kSize);
  expect_near(navigation.camera().target, tilted().camera().target + 2.1 * 90 * 0.1 * forward);
  navigation.move_along(-48, kSize);
  expect_near(navigation.camera().target, tilted().camera().target);
  EXPECT_EQ(navigation.camera().distance, 90);
}

TEST(Navigation, ANotchOfTheWheelIsATenthOfTheDistance) {
  Navigation navigation = tilted();
  navigation.zoom(1);
  EXPECT_DOUBLE_EQ(navigation.camera().distance, 81);
  navigation.zoom(-2);
  EXPECT_DOUBLE_EQ(navigation.camera().distance, 100);
  EXPECT_EQ(navigation.camera().target, tilted().camera().target);
}

TEST(Navigation, WhatIsUnderTheCursorStaysThere) {
  for (const Projection projection : kProjections) {
    for (const double notches : {1.0, 5.0, -3.0, 0.25}) {
      Navigation navigation = tilted(projection);
      const double x = 500, y = 100;
      const csgcore::View before = navigation.view(kSize);
      const csgcore::Ray ray = csgcore::pixel_ray(before, x - 0.5, y - 0.5);
      const double depth = glm::dot(navigation.camera().target - ray.origin, before.forward);
      const Vec3 under_cursor = ray.origin + depth * ray.direction;
      navigation.zoom(notches, x, y, kSize);
      EXPECT_DOUBLE_EQ(navigation.camera().distance, 90 * std::pow(0.9, notches));
      const auto place = project(navigation.view(kSize), under_cursor);
      ASSERT_TRUE(place);
      EXPECT_NEAR(place->x_px, x, 1e-9);
      EXPECT_NEAR(place->y_px, y, 1e-9);
    }
  }
}

TEST(Navigation, ZoomingEndsWhereNumbersDo) {
  Navigation navigation = tilted();
  for (const double notches : {1e6, -1e6, 1e6}) {
    navigation.zoom(notches, 100, 100, kSize);
    const Camera& camera = navigation.camera();
    EXPECT_TRUE(std::isfinite(camera.distance) && camera.distance > 0);
    EXPECT_TRUE(std::isfinite(camera.target.x + camera.target.y + camera.target.z));
    const csgcore::View view = navigation.view(kSize);
    EXPECT_TRUE(std::isfinite(view.eye.x + view.eye.y + view.eye.z));
  }
}

TEST(Navigation, StandardViews) {
  const struct {
    StandardView view;
    Vec3 rotation_deg, forward, up;
  } kViews[] = {
      {StandardView::kTop, {0, 0, 0}, {0, 0, -1}, {0, 1, 0}},
      {StandardView::kBottom, {180, 0, 0}, {0, 0, 1}, {0, -1, 0}},
      {StandardView::kLeft, {90, 0, 270}, {1, 0, 0}, {0, 0, 1}},
      {StandardView::kRight, {90, 0, 90}, {-1, 0, 0}, {0, 0, 1}},
      {StandardView::kFront, {90, 0, 0}, {0, 1, 0}, {0, 0, 1}},
      {StandardView::kBack, {90, 0, 180}, {0, -1, 0}, {0, 0, 1}},
  };
  for (const auto& row : kViews) {
    Navigation navigation = tilted();
    navigation.look_from(row.view);
    EXPECT_EQ(navigation.camera().rotation_deg, row.rotation_deg);
    EXPECT_EQ(navigation.view(kSize).forward, row.forward);
    EXPECT_EQ(navigation.view(kSize).up, row.up);
    EXPECT_EQ(navigation.camera().target, tilted().camera().target);
  }
  Navigation navigation = tilted();
  navigation.look_from(StandardView::kDiagonal);
  EXPECT_EQ(navigation.camera().rotation_deg, Vec3(55, 0, 25));
}

TEST(Projection, IsTheInverseOfAPixelsRay) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0, 1);
  for (const Projection projection : kProjections) {
    const csgcore::View view = tilted(projection).view(kSize);
    for (int i = 0; i < 100; ++i) {
      const double x = 640 * share(random), y = 480 * share(random);
      const csgcore::Ray ray = csgcore::pixel_ray(view, x - 0.5, y - 0.5);
      const auto place = project(view, ray.origin + (1 + 200 * share(random)) * ray.direction);
      ASSERT_TRUE(place);
      EXPECT_NEAR(place->x_px, x, 1e-9);
      EXPECT_NEAR(place->y_px, y, 1e-9);
    }
  }
}

TEST(Projection, BehindTheEyeThereIsNothingToSeeInPerspective) {
  const csgcore::View perspective = tilted(Projection::kPerspective).view(kSize);
  EXPECT_FALSE(project(perspective, perspective.eye - perspective.forward));
  EXPECT_FALSE(project(perspective, perspective.eye));
  const csgcore::View orthographic = tilted(Projection::kOrthographic).view(kSize);
  const auto place = project(orthographic, orthographic.eye - orthographic.forward);
  ASSERT_TRUE(place);
  EXPECT_NEAR(place->x_px, 320, 1e-9);
  EXPECT_NEAR(place->y_px, 240, 1e-9);
}

}  // namespace
}  // namespace window
