// Lines of single pixels in a picture, as OpenGL rasterises them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "csgcore/image.hpp"
#include "frontend/render_settings.hpp"

namespace frontend {

/// A point on the screen, in pixels from the top left corner, and its depth: 1/s in a perspective
/// view, s in an orthographic one, which are what is linear along a line on the screen.
struct ScreenPoint {
  double x, y, depth;
};

/// A point on the screen's raster: pixel `i` holds the positions in (i, i + 1], as the GL's does
/// with x; with y, which runs downwards here, it holds [i, i + 1).
inline double column_of(double x) { return std::ceil(x) - 1; }
inline double row_of(double y) { return std::floor(y); }

/// A picture and the colour to draw with.
class Canvas {
 public:
  Canvas(csgcore::Image& image, Rgb color) : image_(image), color_{color.r, color.g, color.b} {}
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
  csgcore::Image& image_;
  std::array<uint8_t, 3> color_;
};

/// Calls visit(column, row, depth, step) for the pixels from `a` up to but without `b`, one for
/// each column or row, whichever the line crosses more of; `step` is the distance from `a`, in
/// pixels.
template <typename Visit>
void walk_line(const Canvas& canvas, const ScreenPoint& a, const ScreenPoint& b, Visit visit) {
  // Farther out, steps of a pixel drown in a double's rounding. Nothing that far ends in the
  // picture.
  constexpr double kFarthest_px = 1e15;
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
    // One of them is not a number where both ends lie infinitely far to one side.
    const bool is_inside = column >= 0 && row >= 0 &&
                           column < static_cast<double>(canvas.width()) &&
                           row < static_cast<double>(canvas.height());
    if (!is_inside) continue;
    visit(static_cast<int64_t>(column), static_cast<int64_t>(row),
          a.depth + t * (b.depth - a.depth), step);
  }
}

}  // namespace frontend
