// A faint grid in the plane z = 0, where the picture shows no solid.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "frontend/overlays.hpp"
#include "picture/edge_overlay.hpp"
#include "picture/overlay_lines.hpp"

namespace frontend {
namespace {

using csgcore::Image;
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

double height_at_target(const View& view, const Camera& camera) {
  const bool is_perspective = view.projection == csgcore::Projection::kPerspective;
  return 2 * view.half_height * (is_perspective ? camera.distance : 1);
}

/// Where a ray meets the ground, and how that changes from pixel to pixel.
struct GroundPoint {
  Vec3 at, per_column, per_row;
};

class GridPainter {
 public:
  GridPainter(Image& image, const View& view, const Camera& camera, Rgb background, double line_px)
      : image_(image),
        spacing_(grid_spacing(view, camera)),
        target_(camera.target),
        reach_(kReach * height_at_target(view, camera)),
        line_px_(line_px),
        line_(ContrastLines::color_on({background.r, background.g, background.b})),
        corner_(csgcore::pixel_ray(view, 0, 0)) {
    const csgcore::Ray right = csgcore::pixel_ray(view, 1, 0);
    const csgcore::Ray below = csgcore::pixel_ray(view, 0, 1);
    per_column_ = {right.origin - corner_.origin, right.direction - corner_.direction};
    per_row_ = {below.origin - corner_.origin, below.direction - corner_.direction};
    // An orthographic eye sees from infinity.
    sees_behind_ = view.projection == csgcore::Projection::kOrthographic;
  }

  void draw() {
    for (uint32_t y = 0; y < image_.height_px; ++y) {
      for (uint32_t x = 0; x < image_.width_px; ++x) {
        const std::size_t pixel = std::size_t{y} * image_.width_px + x;
        if (std::isfinite(image_.z[pixel])) continue;
        const double strength = strength_at(x, y);
        for (std::size_t i = 0; i < 3 && strength > 0; ++i) {
          uint8_t& value = image_.rgb[pixel][i];
          value = static_cast<uint8_t>(std::lround(value + strength * (line_[i] - value)));
        }
      }
    }
  }

 private:
  double strength_at(double x, double y) const {
    const Vec3 origin = corner_.origin + x * per_column_.origin + y * per_row_.origin;
    const Vec3 direction = corner_.direction + x * per_column_.direction + y * per_row_.direction;
    const double t = -origin.z / direction.z;
    if (!(std::isfinite(t) && (t > 0 || sees_behind_))) return 0;
    const Vec3 at = origin + t * direction;
    const Vec3 from_target = at - target_;
    const double share =
        (from_target.x * from_target.x + from_target.y * from_target.y) / (reach_ * reach_);
    if (!(share < 1)) return 0;
    const auto change = [&](const csgcore::Ray& step) {
      const double of_t = -(step.origin.z + t * step.direction.z) / direction.z;
      return step.origin + t * step.direction + of_t * direction;
    };
    const GroundPoint ground{at, change(per_column_), change(per_row_)};
    return (1 - share) * std::max(kStrength * lines_at(ground, spacing_),
                                  kFineStrength * lines_at(ground, spacing_ / 10));
  }

  /// Returns the share of the pixel that lines at these distances cover, less where they are close.
  double lines_at(const GroundPoint& ground, double spacing) const {
    double covered = 0;
    for (int axis = 0; axis < 2; ++axis) {
      const double phase = ground.at[axis] / spacing;
      const double width = std::hypot(ground.per_column[axis], ground.per_row[axis]) / spacing;
      const double line = line_px_ * width, from_line = std::abs(phase - std::round(phase));
      const double both = std::clamp((width + line) / 2 - from_line, 0.0, std::min(width, line));
      const double apart_px = 1 / line;
      const double clear =
          std::clamp((apart_px - kClosest_px) / (kClear_px - kClosest_px), 0.0, 1.0);
      covered = std::max(covered, clear * both / width);
    }
    return covered;
  }

  Image& image_;
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

void draw_ground_grid(Image& image, const View& view, const Camera& camera, Rgb background,
                      double line_px) {
  GridPainter(image, view, camera, background, line_px).draw();
}

}  // namespace frontend
