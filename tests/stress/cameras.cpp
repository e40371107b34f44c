#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "cases.hpp"
#include "support/reference.hpp"

namespace stress {
namespace {

/// Half of the height of what a picture shows, as a share of the box's diagonal.
constexpr double kHalfHeight = 0.55;

void set_lens(View& view, PictureSize size, Projection projection, double model, double distance) {
  view.projection = projection;
  const bool perspective = projection == Projection::kPerspective;
  view.half_height = perspective ? kHalfHeight / distance : kHalfHeight * model;
  view.width_px = size.width_px;
  view.height_px = size.height_px;
}

}  // namespace

Box camera_box(const Scene& scene) {
  const Box box = csgcore::reference_box(scene);
  return box.empty() ? Box{Vec3{-10.0}, Vec3{10.0}} : box;
}

View view_around(const Box& box, PictureSize size, Projection projection, double around_deg,
                 double above_deg, double distance) {
  const double around = around_deg * std::numbers::pi / 180;
  const double above = above_deg * std::numbers::pi / 180;
  const Vec3 towards_eye{std::cos(above) * std::cos(around), std::cos(above) * std::sin(around),
                         std::sin(above)};
  View view;
  set_lens(view, size, projection, box.diagonal(), distance);
  view.forward = -towards_eye;
  view.right = {-std::sin(around), std::cos(around), 0};
  view.up = glm::cross(view.right, view.forward);
  view.eye = box.center() + distance * box.diagonal() * towards_eye;
  return view;
}

View view_along(const Box& box, PictureSize size, Projection projection, int axis,
                double distance) {
  View view;
  set_lens(view, size, projection, box.diagonal(), distance);
  view.forward = view.right = view.up = Vec3{0.0};
  view.forward[axis] = -1;
  view.right[(axis + 1) % 3] = 1;
  view.up[(axis + 2) % 3] = 1;
  view.eye = box.center();
  view.eye[axis] += distance * box.diagonal();
  return view;
}

std::vector<Camera> default_cameras(const Scene& scene, PictureSize size) {
  const Box box = camera_box(scene);
  return {{"oblique", view_around(box, size, Projection::kPerspective, 25, 35, 3)},
          {"above", view_along(box, size, Projection::kOrthographic, 2, 3)},
          {"low", view_around(box, size, Projection::kPerspective, 200, 2, 1.2)}};
}

std::vector<Camera> cameras_off_edges(const Scene& scene, PictureSize size) {
  const Box box = camera_box(scene);
  return {{"oblique", view_around(box, size, Projection::kPerspective, 25, 35, 3)},
          {"orthographic", view_around(box, size, Projection::kOrthographic, 17, 79, 3)},
          {"low", view_around(box, size, Projection::kPerspective, 203, 2, 1.2)}};
}

}  // namespace stress
