#include "frontend/axes_overlay.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <string_view>

namespace frontend {
namespace {

using csgcore::Image;
using csgcore::Vec3;
using csgcore::View;

constexpr double kNearPlane = 0.1;     // of the camera's distance, where OpenSCAD clips its lines
constexpr int64_t kStippleRun_px = 3;  // OpenSCAD's glLineStipple(3, 0xAAAA): 3 off, 3 on
// An axis that lies in a face is drawn: z is a float, and the renderer's may be off by a few ulp.
constexpr double kCoincidence = 1e-5;  // of the camera's distance
// Farther out, steps of a pixel drown in a double's rounding. Nothing that far ends in the picture.
constexpr double kFarthest_px = 1e15;
constexpr double kGnomonOrigin = 0.1;  // of the picture's width and height, from the lower left
constexpr double kGnomonUnits = 180;   // units of the gnomon in the picture's height
constexpr double kGnomonAxis = 10;     // in units
constexpr double kGnomonLabel = 12;

const std::array<Vec3, 3> kAxes = {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};

/// A point on the screen, in pixels from the top left corner, and its depth: 1/s in a perspective
/// view, s in an orthographic one, which are what is linear along a line on the screen.
struct ScreenPoint {
  double x, y, depth;
};

/// A point on the screen's raster: pixel `i` holds the positions in (i, i + 1], as the GL's does
/// with x; with y, which runs downwards here, it holds [i, i + 1).
double column_of(double x) { return std::ceil(x) - 1; }
double row_of(double y) { return std::floor(y); }

class Canvas {
 public:
  Canvas(Image& image, Rgb color) : image_(image), color_{color.r, color.g, color.b} {}
  void set_color(Rgb color) { color_ = {color.r, color.g, color.b}; }
  int64_t width() const { return image_.width_px; }
  int64_t height() const { return image_.height_px; }

  bool contains(int64_t column, int64_t row) const {
    return column >= 0 && row >= 0 && column < width() && row < height();
  }
  void draw(int64_t column, int64_t row) {
    if (contains(column, row)) image_.rgb[index(column, row)] = color_;
  }
  /// Precondition: contains(column, row).
  double z(int64_t column, int64_t row) const { return image_.z[index(column, row)]; }

 private:
  std::size_t index(int64_t column, int64_t row) const {
    return static_cast<std::size_t>(row * width() + column);
  }
  Image& image_;
  std::array<uint8_t, 3> color_;
};

/// Calls visit(column, row, depth, step) for the pixels from `a` up to but without `b`, one for
/// each column or row, whichever the line crosses more of.
template <typename Visit>
void walk_line(const Canvas& canvas, const ScreenPoint& a, const ScreenPoint& b, Visit visit) {
  const bool along_x = std::abs(b.x - a.x) >= std::abs(b.y - a.y);
  const double from = along_x ? a.x : a.y;
  const double to = along_x ? b.x : b.y;
  const double first = along_x ? column_of(a.x) : row_of(a.y);
  const double last = along_x ? column_of(b.x) : row_of(b.y);
  if (!(std::abs(first) < kFarthest_px && std::abs(last) < kFarthest_px) || first == last) return;
  const double direction = last > first ? 1 : -1;
  const double size = static_cast<double>(along_x ? canvas.width() : canvas.height());
  // Steps that leave the picture are not walked: an axis may be a billion pixels long.
  const double entry = direction > 0 ? -first : first - (size - 1);
  const double exit = direction > 0 ? size - first : first + 1;
  const double end = std::min(std::abs(last - first), exit);
  for (double step = std::max(entry, 0.0); step < end; ++step) {
    const double major = first + direction * step;
    const double t = std::clamp((major + 0.5 - from) / (to - from), 0.0, 1.0);
    const double column = along_x ? major : column_of(a.x + t * (b.x - a.x));
    const double row = along_x ? row_of(a.y + t * (b.y - a.y)) : major;
    if (column < 0 || row < 0 || column >= static_cast<double>(canvas.width()) ||
        row >= static_cast<double>(canvas.height())) {
      continue;
    }
    visit(static_cast<int64_t>(column), static_cast<int64_t>(row),
          a.depth + t * (b.depth - a.depth), std::fmod(step, 2 * kStippleRun_px));
  }
}

class AxesPainter {
 public:
  AxesPainter(const View& view, const Camera& camera)
      : view_(view),
        distance_(camera.distance),
        is_perspective_(view.projection == csgcore::Projection::kPerspective) {}

  void draw_axis(Canvas& canvas, const Vec3& end, bool stippled) const {
    Vec3 from = to_eye(Vec3(0.0));
    Vec3 to = to_eye(end);
    if (!clip(from, to) || !clip(to, from)) return;
    walk_line(canvas, to_screen(from), to_screen(to),
              [&](int64_t column, int64_t row, double depth, double step) {
                if (stippled && step < kStippleRun_px) return;
                const double s = is_perspective_ ? 1 / depth : depth;
                if (s <= canvas.z(column, row) + kCoincidence * distance_) canvas.draw(column, row);
              });
  }

 private:
  /// (right, up, s).
  Vec3 to_eye(const Vec3& point) const {
    const Vec3 offset = point - view_.eye;
    return Vec3(glm::dot(offset, view_.right), glm::dot(offset, view_.up),
                glm::dot(offset, view_.forward));
  }
  /// Moves `point` onto the near plane if it lies before it. False if `other` does, too.
  bool clip(Vec3& point, const Vec3& other) const {
    const double near = kNearPlane * distance_;
    if (!is_perspective_ || point.z >= near) return true;
    if (other.z <= near) return false;
    point += (near - point.z) / (other.z - point.z) * (other - point);
    return true;
  }
  ScreenPoint to_screen(const Vec3& p) const {
    const double half_height = is_perspective_ ? p.z * view_.half_height : view_.half_height;
    const double scale = view_.height_px / (2 * half_height);
    return {view_.width_px / 2.0 + p.x * scale, view_.height_px / 2.0 - p.y * scale,
            is_perspective_ ? 1 / p.z : p.z};
  }

  const View& view_;
  double distance_;
  bool is_perspective_;
};

// The letters as OpenSCAD's lines come out, 6 pixels wide; the last row stands for 3 pixels below
// the label's place, in Z 4.
constexpr std::array<std::string_view, 6> kLetterX = {"#....#", ".#..#.", "..##..",
                                                      "..##..", ".#..#.", "#....#"};
constexpr std::array<std::string_view, 6> kLetterY = {"#....#", ".#..#.", "..##..",
                                                      "..#...", ".#....", "#....."};
constexpr std::array<std::string_view, 7> kLetterZ = {"######", "....#.", "...#..", "..#...",
                                                      ".#....", "#.....", "######"};

void draw_letter(Canvas& canvas, std::span<const std::string_view> letter, double x, double y) {
  if (!std::isfinite(x) || !std::isfinite(y)) return;
  const int64_t left = static_cast<int64_t>(std::floor(x)) - 3;
  const int64_t top = static_cast<int64_t>(row_of(y)) - 2;
  for (std::size_t row = 0; row < letter.size(); ++row) {
    for (std::size_t column = 0; column < letter[row].size(); ++column) {
      if (letter[row][column] == '#') {
        canvas.draw(left + static_cast<int64_t>(column), top + static_cast<int64_t>(row));
      }
    }
  }
}

void draw_gnomon(Canvas& canvas, const View& view, Rgb label_color) {
  constexpr std::array<Rgb, 3> kColors = {Rgb{255, 0, 0}, Rgb{0, 255, 0}, Rgb{0, 0, 255}};
  const std::array<std::span<const std::string_view>, 3> letters = {kLetterX, kLetterY, kLetterZ};
  const double scale = view.height_px / kGnomonUnits;
  const ScreenPoint origin{kGnomonOrigin * view.width_px, (1 - kGnomonOrigin) * view.height_px, 0};
  const auto place = [&](std::size_t axis, double units) {
    return ScreenPoint{origin.x + units * scale * glm::dot(kAxes[axis], view.right),
                       origin.y - units * scale * glm::dot(kAxes[axis], view.up), 0};
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    canvas.set_color(kColors[axis]);
    walk_line(canvas, origin, place(axis, kGnomonAxis),
              [&](int64_t column, int64_t row, double, double) { canvas.draw(column, row); });
  }
  canvas.set_color(label_color);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const ScreenPoint label = place(axis, kGnomonLabel);
    draw_letter(canvas, letters[axis], label.x, label.y);
  }
}

}  // namespace

void draw_axes(Image& image, const View& view, const Camera& camera, Rgb color) {
  Canvas canvas(image, color);
  const AxesPainter painter(view, camera);
  for (const Vec3& axis : kAxes) {
    painter.draw_axis(canvas, camera.distance * axis, false);
    painter.draw_axis(canvas, -camera.distance * axis, true);
  }
  draw_gnomon(canvas, view, color);
}

}  // namespace frontend
