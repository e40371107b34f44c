#include "picture/overlay_lines.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace frontend {
namespace {

using csgcore::Vec3;

constexpr double kNearPlane = 0.1;    // share of the camera's distance at which OpenSCAD clips its
                                      // lines
constexpr double kStippleRun_px = 3;  // OpenSCAD's glLineStipple(3, 0xAAAA): 3 off, 3 on
/// OpenGL's grid within a pixel. On it an end that is meant to lie between two pixels does so
/// exactly, and the line does not jump from one to the other.
constexpr double kSubpixels = 256;

double snapped(double position_px) { return std::round(position_px * kSubpixels) / kSubpixels; }

}  // namespace

LinePainter::LinePainter(Canvas& canvas, const csgcore::View& view, const Camera& camera)
    : canvas_(canvas), projector_(view, camera), distance_(std::abs(camera.distance)) {}

void LinePainter::draw(const Vec3& from, const Vec3& to, LineStyle style) {
  const auto ends = projector_.line(from, to);
  if (!ends) return;
  walk_line(
      canvas_, ends->front(), ends->back(),
      [&](int64_t column, int64_t row, double depth, double step) {
        if (style == LineStyle::kStippled && std::fmod(step, 2 * kStippleRun_px) < kStippleRun_px) {
          return;
        }
        const double s = projector_.s_of(depth);
        if (s <= canvas_.z(column, row) + kCoincidence * distance_) canvas_.draw(column, row);
      });
}

Projector::Projector(const csgcore::View& view, const Camera& camera)
    : view_(view),
      distance_(std::abs(camera.distance)),
      is_perspective_(view.projection == csgcore::Projection::kPerspective) {}

std::optional<std::array<ScreenPoint, 2>> Projector::line(const Vec3& from, const Vec3& to) const {
  Vec3 a = to_eye(from);
  Vec3 b = to_eye(to);
  if (!clip(a, b) || !clip(b, a)) return std::nullopt;
  return std::array{to_screen(a), to_screen(b)};
}

/// Returns (right, up, s).
Vec3 Projector::to_eye(const Vec3& point) const {
  const Vec3 offset = point - view_.eye;
  return Vec3(glm::dot(offset, view_.right), glm::dot(offset, view_.up),
              glm::dot(offset, view_.forward));
}

/// Moves `point` onto the near plane if it lies in front of it. Returns false if `other` does, too.
bool Projector::clip(Vec3& point, const Vec3& other) const {
  const double near = kNearPlane * distance_;
  if (!is_perspective_ || point.z >= near) return true;
  if (other.z <= near) return false;
  point += (near - point.z) / (other.z - point.z) * (other - point);
  return true;
}

ScreenPoint Projector::to_screen(const Vec3& p) const {
  const double half_height = is_perspective_ ? p.z * view_.half_height : view_.half_height;
  const double scale = view_.height_px / (2 * half_height);
  return {snapped(view_.width_px / 2.0 + p.x * scale), snapped(view_.height_px / 2.0 - p.y * scale),
          is_perspective_ ? 1 / p.z : p.z};
}

}  // namespace frontend
