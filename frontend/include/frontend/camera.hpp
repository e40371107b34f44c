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

/// Larger pictures than this a side are refused; it is the largest texture and viewport side that
/// GL drivers commonly have (GL_MAX_TEXTURE_SIZE of llvmpipe and of most hardware).
constexpr uint32_t kMaxPictureSide_px = 16384;

/// What the command line says of the camera and of the picture's size.
struct CameraOptions {
  std::optional<Camera> camera;  // none: as with view_all and auto_center
  bool view_all = false;
  bool auto_center = false;  // only together with view_all, as in OpenSCAD
  csgcore::Projection projection = csgcore::Projection::kPerspective;
  uint32_t width_px = 512;  // 1…kMaxPictureSide_px
  uint32_t height_px = 512;
};

/// The camera of `--camera`: 7 numbers (target, rotation, distance) or 6 (eye, target). Throws
/// Error for any other count.
Camera camera_from_numbers(std::span<const double> numbers);

/// Whether the camera's place depends on the design's box.
inline bool sees_all(const CameraOptions& options) { return options.view_all || !options.camera; }

/// Applies view_all and auto_center to the design's box. An empty box leaves the camera as it is.
Camera choose_camera(const CameraOptions& options, const csgcore::Box& view_box);

/// Whether the picture is the background whatever there is, as in OpenSCAD 2021.01: the distance is
/// 0, not finite, or in perspective negative.
bool sees_nothing(const Camera& camera, csgcore::Projection projection);

/// The rays of that camera; of one that sees nothing only the directions hold. OpenSCAD's
/// orthographic picture from a negative distance is that from the positive one upside down: `up`
/// points downwards there, and right × up = forward.
csgcore::View make_view(const Camera& camera, const CameraOptions& options);

}  // namespace frontend
