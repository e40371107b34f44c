#include "frontend/camera.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "frontend/error.hpp"

namespace frontend {
namespace {

using csgcore::Box;
using csgcore::Mat3;
using csgcore::Vec3;

constexpr double kHalfFov_deg = 11.25;  // OpenSCAD's vertical field of view is 22.5°

double radians(double angle_deg) { return angle_deg * std::numbers::pi / 180; }
double degrees(double angle_rad) { return angle_rad * 180 / std::numbers::pi; }

/// Returns the sine, exact at multiples of 30° (0, ±½ or ±1), so that straight views are straight.
double sine_of_degrees(double angle_deg) {
  constexpr std::array<double, 12> kSines = {
      0, 0.5,  std::numbers::sqrt3 / 2,  1,  std::numbers::sqrt3 / 2,  0.5,
      0, -0.5, -std::numbers::sqrt3 / 2, -1, -std::numbers::sqrt3 / 2, -0.5};
  double turn = std::fmod(angle_deg, 360.0);
  if (turn < 0) turn += 360;
  const double twelfth = turn / 30;
  if (twelfth == std::floor(twelfth)) return kSines[static_cast<std::size_t>(twelfth) % 12];
  return std::sin(radians(turn));
}

double cosine_of_degrees(double angle_deg) {
  // The remainder comes first: adding 90 to a large angle would round it.
  return sine_of_degrees(std::fmod(angle_deg, 360.0) + 90);
}

/// Returns OpenSCAD's rotate(angles): about x, then y, then z.
Mat3 rotation(const Vec3& angles_deg) {
  const double sx = sine_of_degrees(angles_deg.x), cx = cosine_of_degrees(angles_deg.x);
  const double sy = sine_of_degrees(angles_deg.y), cy = cosine_of_degrees(angles_deg.y);
  const double sz = sine_of_degrees(angles_deg.z), cz = cosine_of_degrees(angles_deg.z);
  const Mat3 about_x(Vec3(1, 0, 0), Vec3(0, cx, sx), Vec3(0, -sx, cx));
  const Mat3 about_y(Vec3(cy, 0, -sy), Vec3(0, 1, 0), Vec3(sy, 0, cy));
  const Mat3 about_z(Vec3(cz, sz, 0), Vec3(-sz, cz, 0), Vec3(0, 0, 1));
  return about_z * about_y * about_x;
}

double length(const Vec3& v) { return std::hypot(v.x, v.y, v.z); }

/// Returns the angles of the camera that looks along `direction`, with z upwards.
Vec3 rotation_of_direction(const Vec3& direction) {
  const double level = std::hypot(direction.x, direction.y);
  const double x_deg = 90 + degrees(std::atan2(direction.z, level));
  if (level == 0) return Vec3(x_deg, 0, direction.z < 0 ? 0 : 180);
  return Vec3(x_deg, 0, degrees(std::atan2(direction.y, direction.x)) - 90);
}

}  // namespace

Camera camera_from_numbers(std::span<const double> numbers) {
  Camera camera;
  if (numbers.size() == 7) {
    camera.target = Vec3(numbers[0], numbers[1], numbers[2]);
    camera.rotation_deg = Vec3(numbers[3], numbers[4], numbers[5]);
    camera.distance = numbers[6];
  } else if (numbers.size() == 6) {
    camera.target = Vec3(numbers[3], numbers[4], numbers[5]);
    const Vec3 direction = camera.target - Vec3(numbers[0], numbers[1], numbers[2]);
    camera.rotation_deg = rotation_of_direction(direction);
    camera.distance = length(direction);
  } else {
    throw Error("", {}, "--camera has " + std::to_string(numbers.size()) + " numbers",
                "give 7: translation, rotation and distance, or 6: eye and centre");
  }
  return camera;
}

CameraOptions with_camera_of(const DesignCamera& design, CameraOptions options) {
  const bool is_set = design.target || design.rotation_deg || design.distance;
  if (options.camera || !is_set) return options;
  const Camera standard;
  options.camera = Camera{design.target.value_or(standard.target),
                          design.rotation_deg.value_or(standard.rotation_deg),
                          design.distance.value_or(standard.distance)};
  return options;
}

Camera choose_camera(const CameraOptions& options, const Box& view_box) {
  Camera camera = options.camera.value_or(Camera{});
  const bool view_all = sees_all(options);
  const bool auto_center = options.auto_center || !options.camera;
  if (!view_box.empty()) {
    // auto_center alone has no effect: every OpenSCAD heeds it only with view_all.
    if (view_all && auto_center) camera.target = view_box.center();
    if (view_all) {
      const double radius = length(view_box.center() - camera.target) + view_box.diagonal() / 2;
      if (radius > 0) camera.distance = radius / std::sin(radians(kHalfFov_deg));
    }
  }
  return camera;
}

bool sees_nothing(const Camera& camera, csgcore::Projection projection) {
  const bool sees_behind = projection == csgcore::Projection::kOrthographic;
  for (int axis = 0; axis < 3; ++axis) {
    if (!std::isfinite(camera.target[axis]) || !std::isfinite(camera.rotation_deg[axis]))
      return true;
  }
  return camera.distance == 0 || !std::isfinite(camera.distance) ||
         (camera.distance < 0 && !sees_behind);
}

csgcore::View make_view(const Camera& camera, const CameraOptions& options) {
  const Mat3 turn = rotation(camera.rotation_deg);
  csgcore::View view;
  view.projection = options.projection;
  view.right = turn[0];
  view.up = turn[1];
  view.forward = -turn[2];
  const double distance = std::abs(camera.distance);
  view.eye = camera.target + distance * turn[2];
  view.half_height = std::tan(radians(kHalfFov_deg));
  if (options.projection == csgcore::Projection::kOrthographic) {
    view.half_height *= distance;
    if (camera.distance < 0) view.up = -view.up;
  }
  view.width_px = options.width_px;
  view.height_px = options.height_px;
  return view;
}

}  // namespace frontend
