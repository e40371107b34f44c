#include "picture/axes_overlay.hpp"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>
#include <string_view>

namespace frontend {
namespace {

using csgcore::Vec3;
using csgcore::View;

constexpr double kGnomonOrigin = 0.1;  // from the lower left, as shares of the picture's width and
                                       // height
constexpr double kGnomonUnits = 180;   // the picture's height, in units of the gnomon
constexpr double kGnomonAxis = 10;     // an axis, in these units
constexpr double kGnomonLabel = 12;
constexpr int64_t kHalfLetter_px = 3;

const std::array<Vec3, 3> kAxes = {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};

// The letters' pixels as OpenSCAD's lines set them.
constexpr std::array<std::string_view, 6> kLetterX = {"#....#", ".#..#.", "..##..",
                                                      "..##..", ".#..#.", "#....#"};
constexpr std::array<std::string_view, 6> kLetterY = {"#....#", ".#..#.", "..##..",
                                                      "..#...", ".#....", "#....."};
constexpr std::array<std::string_view, 7> kLetterZ = {"######", "....#.", "...#..", "..#...",
                                                      ".#....", "#.....", "######"};

/// Draws a letter with its middle at (x, y), in pixels from the top left corner. The place is
/// rounded as by OpenSCAD, which counts from the lower left.
void draw_letter(Canvas& canvas, std::span<const std::string_view> letter, double x, double y) {
  if (!std::isfinite(x) || !std::isfinite(y)) return;
  const int64_t left = std::llround(x) - kHalfLetter_px;
  const int64_t top =
      canvas.height() - std::llround(static_cast<double>(canvas.height()) - y) - kHalfLetter_px;
  for (std::size_t row = 0; row < letter.size(); ++row) {
    for (std::size_t column = 0; column < letter[row].size(); ++column) {
      if (letter[row][column] == '#') {
        canvas.draw(left + static_cast<int64_t>(column), top + static_cast<int64_t>(row));
      }
    }
  }
}

}  // namespace

void draw_axes(LinePainter& painter, const Camera& camera) {
  for (const Vec3& axis : kAxes) {
    painter.draw(Vec3(0.0), camera.distance * axis);
    painter.draw(Vec3(0.0), -camera.distance * axis, LineStyle::kStippled);
  }
}

void draw_gnomon(Canvas& canvas, const View& view, Rgb label_color) {
  constexpr std::array<Rgb, 3> kColors = {Rgb{255, 0, 0}, Rgb{0, 255, 0}, Rgb{0, 0, 255}};
  const std::array<std::span<const std::string_view>, 3> letters = {kLetterX, kLetterY, kLetterZ};
  const double scale = view.height_px / kGnomonUnits;
  const ScreenPoint origin{kGnomonOrigin * view.width_px, (1 - kGnomonOrigin) * view.height_px, 0};
  // The gnomon is upright even in a picture that is upside down.
  const bool is_upright = glm::dot(glm::cross(view.right, view.up), view.forward) < 0;
  const Vec3 up = is_upright ? view.up : -view.up;
  const auto place = [&](std::size_t axis, double units) {
    return ScreenPoint{origin.x + units * scale * glm::dot(kAxes[axis], view.right),
                       origin.y - units * scale * glm::dot(kAxes[axis], up), 0};
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

}  // namespace frontend
