// A faint grid in the plane z = 0, behind all solids: it is seen as far as the background is.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "frontend/overlays.hpp"
#include "picture/edge_overlay.hpp"
#include "picture/overlay_lines.hpp"
#include "render/solid_renderer.hpp"

namespace frontend {
namespace {

using csgcore::Image;
using csgcore::PixelShare;
using csgcore::Vec3;
using csgcore::View;

/// How much lines take of the background's colour: those of the grid, and ten times as many
/// between.
constexpr double kStrength = 0.28, kFineStrength = 0.09;
/// The grid ends at so many heights of the picture from what the camera looks at.
constexpr double kReach = 1.5;
/// Lines that are closer than the first number of pixels are left out, from the second on they are
/// drawn in full.
constexpr double kClosest_px = 4, kClear_px = 12;
/// So many lines away a double still tells a line from the next one.
constexpr double kFurthestPhase = 0x1p50;

double height_at_target(const View& view, const Camera& camera) {
  const bool is_perspective = view.projection == csgcore::Projection::kPerspective;
  return 2 * view.half_height * (is_perspective ? camera.distance : 1);
}

/// Where a ray meets the ground, and how far that moves from pixel to pixel, along x and y.
struct GroundPoint {
  double at[2], width[2];
};

class GridPainter {
 public:
  GridPainter(Image& image, const View& view, const Camera& camera, const ColorScheme& scheme,
              double line_px)
      : image_(image),
        spacing_(grid_spacing(view, camera)),
        target_(camera.target),
        reach_(kReach * height_at_target(view, camera)),
        line_px_(line_px),
        line_(ContrastLines::color_on(
            {scheme.background.r, scheme.background.g, scheme.background.b})),
        corner_(csgcore::pixel_ray(view, 0, 0)) {
    set_background(scheme, frame_);
    const csgcore::Ray right = csgcore::pixel_ray(view, 1, 0);
    const csgcore::Ray below = csgcore::pixel_ray(view, 0, 1);
    per_column_ = {right.origin - corner_.origin, right.direction - corner_.direction};
    per_row_ = {below.origin - corner_.origin, below.direction - corner_.direction};
    // An orthographic eye sees from infinity.
    sees_behind_ = view.projection == csgcore::Projection::kOrthographic;
  }

  void draw() {
    tbb::parallel_for(0u, image_.height_px, [this](uint32_t y) { draw_row(y); });
  }

 private:
  void draw_row(uint32_t y) {
    const std::size_t first = std::size_t{y} * image_.width_px;
    if (image_.shares) return draw_shares(y, first, first + image_.width_px);
    for (uint32_t x = 0; x < image_.width_px; ++x) {
      if (!std::isfinite(image_.z[first + x])) draw_pixel(x, y, image_.rgb[first + x], 1);
    }
  }

  void draw_shares(uint32_t y, std::size_t first, std::size_t end) {
    const auto begin = std::ranges::lower_bound(*image_.shares, first, {}, &PixelShare::pixel);
    for (auto seen = begin; seen != image_.shares->end() && seen->pixel < end; ++seen) {
      if (seen->id != csgcore::kNoPrimitive) continue;
      const std::array<uint8_t, 3> background = background_pixel(frame_, y, image_.height_px);
      draw_pixel(static_cast<uint32_t>(seen->pixel - first), y, background, seen->share);
    }
  }

  /// Changes a pixel by as much as the background, of which it shows this share.
  void draw_pixel(uint32_t x, uint32_t y, const std::array<uint8_t, 3>& background, double share) {
    const double strength = share * strength_at(x, y);
    if (!(strength > 0)) return;
    std::array<uint8_t, 3>& color = image_.rgb[std::size_t{y} * image_.width_px + x];
    for (std::size_t i = 0; i < 3; ++i) {
      const double value = color[i] + strength * (line_[i] - background[i]);
      color[i] = static_cast<uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
    }
  }

  double strength_at(double x, double y) const {
    const Vec3 origin = corner_.origin + x * per_column_.origin + y * per_row_.origin;
    const Vec3 direction = corner_.direction + x * per_column_.direction + y * per_row_.direction;
    const double inverse = 1 / direction.z, t = -origin.z * inverse;
    if (!(std::isfinite(t) && (t > 0 || sees_behind_))) return 0;
    GroundPoint ground;
    double from_target2 = 0;
    const double t_per_column = -(per_column_.origin.z + t * per_column_.direction.z) * inverse;
    const double t_per_row = -(per_row_.origin.z + t * per_row_.direction.z) * inverse;
    for (int axis = 0; axis < 2; ++axis) {
      ground.at[axis] = origin[axis] + t * direction[axis];
      const double from_target = ground.at[axis] - target_[axis];
      from_target2 += from_target * from_target;
      const double column = per_column_.origin[axis] + t * per_column_.direction[axis] +
                            t_per_column * direction[axis];
      const double row =
          per_row_.origin[axis] + t * per_row_.direction[axis] + t_per_row * direction[axis];
      ground.width[axis] = std::sqrt(column * column + row * row);
    }
    const double share = from_target2 / (reach_ * reach_);
    if (!(share < 1)) return 0;
    return (1 - share) * std::max(kStrength * lines_at(ground, 1 / spacing_),
                                  kFineStrength * lines_at(ground, 10 / spacing_));
  }

  /// Returns the share of the pixel that lines at these distances cover, less where they are close.
  double lines_at(const GroundPoint& ground, double per_spacing) const {
    double covered = 0;
    for (int axis = 0; axis < 2; ++axis) {
      const double phase = ground.at[axis] * per_spacing;
      const double width = ground.width[axis] * per_spacing, line = line_px_ * width;
      // Lines that are closer than that are left out, and none is as far away as these numbers go.
      if (!(kClosest_px * line < 1 && std::abs(phase) < kFurthestPhase)) continue;
      const double nearest =
          static_cast<double>(static_cast<int64_t>(phase + (phase < 0 ? -0.5 : 0.5)));
      const double both = (width + line) / 2 - std::abs(phase - nearest);
      if (!(both > 0)) continue;
      const double clear = std::min((1 / line - kClosest_px) / (kClear_px - kClosest_px), 1.0);
      covered = std::max(covered, clear * std::min(both, std::min(width, line)) / width);
    }
    return covered;
  }

  Image& image_;
  csgcore::FrameSettings frame_;  // the background's colour alone
  const double spacing_;
  const Vec3 target_;
  const double reach_, line_px_;
  const ContrastLines::Color line_;
  const csgcore::Ray corner_;
  csgcore::Ray per_column_, per_row_;
  bool sees_behind_ = false;
};

}  // namespace

double grid_spacing(const View& view, const Camera& camera) {
  // At least two squares fit into the picture's height.
  return std::pow(10.0, std::floor(std::log10(height_at_target(view, camera) / 2)));
}

void draw_ground_grid(Image& image, const View& view, const Camera& camera,
                      const ColorScheme& scheme, double line_px) {
  GridPainter(image, view, camera, scheme, line_px).draw();
}

}  // namespace frontend
