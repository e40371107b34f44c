// Tests the camera's numbers (frontend/OPENSCAD.md, "Camera").
#include "frontend/camera.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "frontend/error.hpp"

namespace frontend {
namespace {

using csgcore::Box;
using csgcore::Projection;
using csgcore::Vec3;
using csgcore::View;

constexpr double kClose = 1e-12;  // for numbers of size 1 to 1000, in double

void expect_near(const Vec3& actual, const Vec3& expected, double tolerance = kClose) {
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(actual[axis], expected[axis], tolerance) << "axis " << axis;
  }
}

Box box(const Vec3& min, const Vec3& max) {
  Box result;
  result.min = min;
  result.max = max;
  return result;
}

Camera camera_of(const std::vector<double>& numbers) { return camera_from_numbers(numbers); }

double radians(double angle_deg) { return angle_deg * std::numbers::pi / 180; }

TEST(Camera, DefaultsAreOpenScads) {
  const Camera camera;
  expect_near(camera.target, {0, 0, 0});
  expect_near(camera.rotation_deg, {55, 0, 25});
  EXPECT_EQ(camera.distance, 140);
}

TEST(Camera, SevenNumbersAreTargetRotationDistance) {
  const Camera camera = camera_of({1, 2, 3, 40, 50, 60, 70});
  expect_near(camera.target, {1, 2, 3});
  expect_near(camera.rotation_deg, {40, 50, 60});
  EXPECT_EQ(camera.distance, 70);
}

TEST(Camera, SixNumbersAreEyeAndTarget) {
  const Camera camera = camera_of({13, 2, 3, 3, 2, 3});  // from +x
  expect_near(camera.target, {3, 2, 3});
  expect_near(camera.rotation_deg, {90, 0, 90});
  EXPECT_DOUBLE_EQ(camera.distance, 10);
}

TEST(Camera, SixNumbersStraightDownAndUp) {
  expect_near(camera_of({0, 0, 5, 0, 0, 0}).rotation_deg, {0, 0, 0});
  expect_near(camera_of({0, 0, -5, 0, 0, 0}).rotation_deg, {180, 0, 180});
}

TEST(Camera, SixNumbersSeeFromTheEye) {
  const CameraOptions options;
  for (const auto& numbers :
       {std::vector<double>{10, -20, 30, 1, 2, 3}, std::vector<double>{-4, 7, -9, 0, 0, 0},
        std::vector<double>{0, 0, 5, 0, 0, 0}}) {
    const Camera camera = camera_of(numbers);
    const View view = make_view(camera, options);
    const Vec3 eye(numbers[0], numbers[1], numbers[2]);
    const Vec3 target(numbers[3], numbers[4], numbers[5]);
    expect_near(view.eye, eye, 1e-10);
    const Vec3 way = target - eye;
    expect_near(view.forward, way / std::sqrt(glm::dot(way, way)), kClose);
    EXPECT_GE(view.up.z, -kClose);  // z is upwards
  }
}

TEST(Camera, OtherCountsAreErrors) {
  for (const std::size_t count : {0u, 1u, 5u, 8u}) {
    EXPECT_THROW(camera_from_numbers(std::vector<double>(count, 1.0)), Error) << count;
  }
}

TEST(Camera, ViewOfTheFrontIsExact) {
  Camera camera;
  camera.rotation_deg = {90, 0, 0};
  camera.distance = 10;
  const View view = make_view(camera, {});
  EXPECT_EQ(view.eye, Vec3(0, -10, 0));
  EXPECT_EQ(view.right, Vec3(1, 0, 0));
  EXPECT_EQ(view.up, Vec3(0, 0, 1));
  EXPECT_EQ(view.forward, Vec3(0, 1, 0));
}

TEST(Camera, ViewIsRotatedAboutXThenYThenZ) {
  Camera camera;
  camera.rotation_deg = {20, 30, 40};
  camera.target = {1, 2, 3};
  camera.distance = 10;
  const View view = make_view(camera, {});
  // R·(0,0,1), multiplied out by hand from Rz·Ry·Rx.
  const double a = radians(20), b = radians(30), c = radians(40);
  const Vec3 back(std::cos(c) * std::sin(b) * std::cos(a) + std::sin(c) * std::sin(a),
                  std::sin(c) * std::sin(b) * std::cos(a) - std::cos(c) * std::sin(a),
                  std::cos(b) * std::cos(a));
  expect_near(view.forward, -back);
  expect_near(view.eye, Vec3(1, 2, 3) + 10.0 * back);
  expect_near(view.right, {std::cos(c) * std::cos(b), std::sin(c) * std::cos(b), -std::sin(b)});
  expect_near(glm::cross(view.right, view.up), -view.forward);
}

TEST(Camera, HalfHeightOfBothProjections) {
  Camera camera;
  camera.distance = 50;
  CameraOptions options;
  options.width_px = 300;
  options.height_px = 200;
  View view = make_view(camera, options);
  EXPECT_DOUBLE_EQ(view.half_height, std::tan(radians(11.25)));
  EXPECT_EQ(view.width_px, 300u);
  EXPECT_EQ(view.height_px, 200u);
  options.projection = Projection::kOrthographic;
  view = make_view(camera, options);
  EXPECT_EQ(view.projection, Projection::kOrthographic);
  EXPECT_DOUBLE_EQ(view.half_height, 50 * std::tan(radians(11.25)));
}

TEST(Camera, WithoutACameraTheWholeDesignIsSeenAndCentred) {
  const Camera camera = choose_camera({}, box({0, 0, 0}, {2, 4, 4}));
  expect_near(camera.target, {1, 2, 2});
  expect_near(camera.rotation_deg, {55, 0, 25});
  EXPECT_DOUBLE_EQ(camera.distance, 3 / std::sin(radians(11.25)));
}

TEST(Camera, ViewAllWithoutAutoCenterAddsTheWayToTheCentre) {
  CameraOptions options;
  options.camera = camera_of({0, 0, 0, 10, 20, 30, 5});
  options.view_all = true;
  const Camera camera = choose_camera(options, box({0, 0, 0}, {2, 4, 4}));
  expect_near(camera.target, {0, 0, 0});
  expect_near(camera.rotation_deg, {10, 20, 30});
  EXPECT_DOUBLE_EQ(camera.distance, (3.0 + 3.0) / std::sin(radians(11.25)));
}

TEST(Camera, AutoCenterMovesTheTargetOnlyWithViewAll) {
  CameraOptions options;
  options.camera = camera_of({0, 0, 0, 10, 20, 30, 5});
  options.auto_center = true;
  Camera camera = choose_camera(options, box({0, 0, 0}, {2, 4, 4}));
  expect_near(camera.target, {0, 0, 0});  // so does OpenSCAD 2021.01
  EXPECT_EQ(camera.distance, 5);
  options.view_all = true;
  camera = choose_camera(options, box({0, 0, 0}, {2, 4, 4}));
  expect_near(camera.target, {1, 2, 2});
  EXPECT_DOUBLE_EQ(camera.distance, 3.0 / std::sin(radians(11.25)));
}

TEST(Camera, AnEmptyDesignKeepsTheCamera) {
  const Camera camera = choose_camera({}, Box{});
  expect_near(camera.target, {0, 0, 0});
  EXPECT_EQ(camera.distance, 140);
}

TEST(Camera, ADesignWithoutExtentKeepsTheDistance) {
  EXPECT_EQ(choose_camera({}, box({1, 2, 3}, {1, 2, 3})).distance, 140);
}

TEST(Camera, DistanceMayBeAnyUnlessViewAllReplacesIt) {
  CameraOptions options;
  for (const double distance : {0.0, -1.0}) {
    options.camera = camera_of({0, 0, 0, 0, 0, 0, distance});
    options.view_all = false;
    EXPECT_EQ(choose_camera(options, box({0, 0, 0}, {1, 1, 1})).distance, distance);
    options.view_all = true;
    EXPECT_GT(choose_camera(options, box({0, 0, 0}, {1, 1, 1})).distance, 0);
  }
}

TEST(Camera, SeesNothingWhereOpenScadDrawsNothing) {
  const auto sees_nothing = [](const std::vector<double>& numbers, Projection projection) {
    return frontend::sees_nothing(camera_of(numbers), projection);
  };
  for (const Projection projection : {Projection::kPerspective, Projection::kOrthographic}) {
    EXPECT_FALSE(sees_nothing({0, 0, 0, 0, 0, 0, 1}, projection));
    EXPECT_TRUE(sees_nothing({0, 0, 0, 0, 0, 0, 0}, projection));
    EXPECT_TRUE(sees_nothing({1, 2, 3, 1, 2, 3}, projection));           // the eye on the target
    EXPECT_TRUE(sees_nothing({-1e308, 0, 0, 1e308, 0, 0}, projection));  // beyond the doubles
  }
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(sees_nothing({infinity, 0, 0, 0, 0, 0, 1}, Projection::kPerspective));
  EXPECT_TRUE(sees_nothing({0, 0, 0, 0, NAN, 0, 1}, Projection::kOrthographic));
  EXPECT_TRUE(sees_nothing({0, 0, 0, 0, 0, 0, -1}, Projection::kPerspective));
  EXPECT_FALSE(sees_nothing({0, 0, 0, 0, 0, 0, -1}, Projection::kOrthographic));
}

TEST(Camera, ANegativeDistanceTurnsAnOrthographicPictureUpsideDown) {
  CameraOptions options;
  options.projection = Projection::kOrthographic;
  const View upright = make_view(camera_of({1, 2, 3, 40, 10, 70, 50}), options);
  const View view = make_view(camera_of({1, 2, 3, 40, 10, 70, -50}), options);
  EXPECT_EQ(view.eye, upright.eye);
  EXPECT_EQ(view.right, upright.right);
  EXPECT_EQ(view.up, -upright.up);
  EXPECT_EQ(view.forward, upright.forward);
  EXPECT_EQ(view.half_height, upright.half_height);
}

}  // namespace
}  // namespace frontend
