// The camera as mouse and keys move it, like OpenSCAD's (frontend/OPENSCAD.md, "Window").
#pragma once

#include <cstdint>

#include "frontend/camera.hpp"

namespace window {

enum class StandardView : uint8_t { kTop, kBottom, kLeft, kRight, kFront, kBack, kDiagonal };

/// The picture's size.
struct Size {
  uint32_t width_px = 0;
  uint32_t height_px = 0;
  bool operator==(const Size&) const = default;
};

/// A camera and its projection. Movements of the mouse are in pixels of the picture, x to the right
/// and y downwards; a place in the picture counts from its upper left corner.
class Navigation {
 public:
  /// Makes the distance positive: from where nothing is seen, the mouse leads nowhere.
  Navigation(const frontend::Camera& camera, csgcore::Projection projection);

  bool operator==(const Navigation&) const = default;

  const frontend::Camera& camera() const { return camera_; }
  csgcore::Projection projection() const { return projection_; }
  csgcore::View view(Size size) const;

  /// Left drag; `about_y` with shift.
  void turn(double dx_px, double dy_px, bool about_y);
  /// Turns about the picture's x axis and the world's z axis, as a drag does.
  void turn_by(double about_x_deg, double about_z_deg);
  /// Right drag: what is that far before the eye, along the view's axis, moves with the mouse.
  void pan(double dx_px, double dy_px, Size size, double depth);
  /// Does the same with what the camera looks at.
  void pan(double dx_px, double dy_px, Size size) { pan(dx_px, dy_px, size, camera_.distance); }
  /// Pans some four times as far, as OpenSCAD does.
  void pan_far(double dx_px, double dy_px, Size size);
  /// Middle drag, and right drag with shift: moves forward and back.
  void move_along(double dy_px, Size size);
  /// The wheel: what is under the cursor, at the target's depth, stays there. notches > 0: nearer.
  void zoom(double notches, double x_px, double y_px, Size size);
  /// Zooms at the picture's middle.
  void zoom(double notches) { scale_distance(notches); }
  void look_from(StandardView standard_view);
  void look_at(const csgcore::Vec3& target) { camera_.target = target; }
  void set_projection(csgcore::Projection projection) { projection_ = projection; }

 private:
  double scale_distance(double notches);

  frontend::Camera camera_;
  csgcore::Projection projection_;
};

// A drag that pans: the point that was under the mouse at its begin stays there.

/// How far that point is before the eye becomes known only after a while.
struct Pan {
  uint64_t probe = 0;  // that finds the point; 0: nothing is panned
  Navigation start{{}, csgcore::Projection::kPerspective};
  Navigation now = start;  // as the pan has left it
  double dx_px = 0, dy_px = 0;
  double depth = 0;

  /// Goes on from a camera, which something else may have moved meanwhile.
  Navigation move(const Navigation& from, double x_px, double y_px, Size size) {
    if (!(from == now)) {
      start = from;
      dx_px = dy_px = 0;
    }
    dx_px += x_px;
    dy_px += y_px;
    now = start;
    now.pan(dx_px, dy_px, size, depth);
    return now;
  }
};

}  // namespace window
