#include "navigation.hpp"

#include <algorithm>
#include <cmath>

#include "projection.hpp"

namespace window {
namespace {

using csgcore::Vec3;

// OpenSCAD's factors (frontend/OPENSCAD.md, "Window").
constexpr double kTurn_degPerPixel = 0.7;
constexpr double kPan = 3 * 0.7;  // camera distances per drag across the picture
constexpr double kZoomOfNotch = 0.9;

/// Limits of the camera's distance, so that the square of a scene's size is still a double.
constexpr double kLeastDistance = 1e-90;
constexpr double kLargestDistance = 1e90;

/// Returns the angle in [0, 360), as OpenSCAD shows it.
double full_turn(double angle_deg) {
  const double rest = std::fmod(angle_deg, 360.0);
  return rest < 0 ? rest + 360 : rest;
}

Vec3 rotation_of(StandardView view) {
  switch (view) {
    case StandardView::kTop:
      return {0, 0, 0};
    case StandardView::kBottom:
      return {180, 0, 0};
    case StandardView::kLeft:
      return {90, 0, 270};
    case StandardView::kRight:
      return {90, 0, 90};
    case StandardView::kFront:
      return {90, 0, 0};
    case StandardView::kBack:
      return {90, 0, 180};
    case StandardView::kDiagonal:
      break;
  }
  return frontend::Camera{}.rotation_deg;
}

}  // namespace

Navigation::Navigation(const frontend::Camera& camera, csgcore::Projection projection)
    : camera_(camera), projection_(projection) {
  camera_.distance = camera.distance == 0
                         ? frontend::Camera{}.distance
                         : std::clamp(std::abs(camera.distance), kLeastDistance, kLargestDistance);
}

csgcore::View Navigation::view(Size size) const {
  frontend::CameraOptions options;
  options.projection = projection_;
  options.width_px = size.width_px;
  options.height_px = size.height_px;
  return frontend::make_view(camera_, options);
}

void Navigation::turn(double dx_px, double dy_px, bool about_y) {
  Vec3& angles = camera_.rotation_deg;
  angles.x = full_turn(angles.x - kTurn_degPerPixel * dy_px);
  double& turned = about_y ? angles.y : angles.z;
  turned = full_turn(turned - kTurn_degPerPixel * dx_px);
}

void Navigation::turn_by(double about_x_deg, double about_z_deg) {
  Vec3& angles = camera_.rotation_deg;
  angles.x = full_turn(angles.x + about_x_deg);
  angles.z = full_turn(angles.z + about_z_deg);
}

void Navigation::pan(double dx_px, double dy_px, Size size, double depth) {
  const csgcore::View now = view(size);
  const double unit = pixel_size(now, now.eye + depth * now.forward);
  camera_.target += unit * (dy_px * now.up - dx_px * now.right);
}

void Navigation::pan_far(double dx_px, double dy_px, Size size) {
  const csgcore::View now = view(size);
  const double reach = kPan * camera_.distance;
  camera_.target -= now.right * (reach * dx_px / size.width_px);
  camera_.target += now.up * (reach * dy_px / size.height_px);
}

void Navigation::move_along(double dy_px, Size size) {
  camera_.target += view(size).forward * (kPan * camera_.distance * dy_px / size.height_px);
}

double Navigation::scale_distance(double notches) {
  const double before = camera_.distance;
  camera_.distance =
      std::clamp(before * std::pow(kZoomOfNotch, notches), kLeastDistance, kLargestDistance);
  return camera_.distance / before;
}

void Navigation::zoom(double notches, double x_px, double y_px, Size size) {
  const csgcore::View now = view(size);
  const double unit = pixel_size(now, camera_.target);
  const Vec3 offset = now.right * (unit * (x_px - 0.5 * size.width_px)) +
                      now.up * (unit * (0.5 * size.height_px - y_px));
  camera_.target += offset * (1 - scale_distance(notches));
}

void Navigation::look_from(StandardView standard_view) {
  camera_.rotation_deg = rotation_of(standard_view);
}

}  // namespace window
