// OpenSCAD's camera (frontend/OPENSCAD.md, "Camera"): its numbers, and the
// csgcore::View that they mean.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "csgcore/geometry.hpp"
#include "csgcore/view.hpp"

namespace frontend {

/// OpenSCAD's $vpt, $vpr and $vpd. The eye stands at target + R·(0, 0, distance), where R is
/// OpenSCAD's rotate(rotation_deg), and looks at the target.
struct Camera {
  csgcore::Vec3 target{0.0};
  csgcore::Vec3 rotation_deg{55, 0, 25};
  double distance = 140;
  bool operator==(const Camera&) const = default;
};

/// The camera that a .scad sets by its own $vpt, $vpr and $vpd.
struct DesignCamera {
  std::optional<csgcore::Vec3> target{};
  std::optional<csgcore::Vec3> rotation_deg{};
  std::optional<double> distance{};

  bool operator==(const DesignCamera&) const = default;
};

/// The largest width and height of a picture; larger ones are refused. GL drivers commonly have no
/// larger textures and viewports (GL_MAX_TEXTURE_SIZE of llvmpipe and of most hardware).
constexpr uint32_t kMaxPictureSide_px = 16384;

/// The command line's options for the camera and the picture's size.
struct CameraOptions {
  std::optional<Camera> camera;  // none: view_all and auto_center apply
  bool view_all = false;
  bool auto_center = false;  // has an effect only with view_all, as in OpenSCAD
  csgcore::Projection projection = csgcore::Projection::kPerspective;
  uint32_t width_px = 512;  // 1…kMaxPictureSide_px
  uint32_t height_px = 512;
};

/// Returns the options with the design's camera, unless they have one.
CameraOptions with_camera_of(const DesignCamera& design, CameraOptions options);

/// Returns the camera of `--camera`: 7 numbers (target, rotation, distance) or 6 (eye, target).
/// Throws Error for any other count.
Camera camera_from_numbers(std::span<const double> numbers);

/// Returns whether the camera's place depends on the design's box.
inline bool sees_all(const CameraOptions& options) { return options.view_all || !options.camera; }

/// Applies view_all and auto_center to the design's box. An empty box leaves the camera as it is.
Camera choose_camera(const CameraOptions& options, const csgcore::Box& view_box);

/// Returns whether the picture is all background, whatever the design, as in OpenSCAD 2021.01: the
/// distance is 0, not finite, or in perspective negative.
bool sees_nothing(const Camera& camera, csgcore::Projection projection);

/// Returns the rays of the camera. If the camera sees nothing (sees_nothing()), only their
/// directions are valid. OpenSCAD's orthographic picture from a negative distance is the one from
/// the positive distance upside down: there `up` points downwards, and right × up = forward.
csgcore::View make_view(const Camera& camera, const CameraOptions& options);

}  // namespace frontend
