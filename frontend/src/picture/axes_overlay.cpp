#include <array>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <span>
#include <string>
#include <string_view>

#include "picture/overlay_lines.hpp"

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

// All lengths are shares of the camera's distance.
constexpr double kMark = 1 / 60.0;
constexpr double kLongMark = 1 / 30.0;
constexpr double kDigitWidth = 1 / 120.0;
constexpr double kDigitAdvance = 1 / 80.0;
// Heights above the axis. OpenSCAD's middle is not half way.
constexpr double kDigitBottom = 1 / 240.0;
constexpr double kDigitMiddle = 7 / 480.0;
constexpr double kDigitTop = 1 / 48.0;

/// A half-axis: its direction, that in which its numbers are read, and the side of its marks.
struct HalfAxis {
  Vec3 direction, reading, up, mark;
};
const std::array<HalfAxis, 6> kHalfAxes = {{
    {Vec3(1, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0)},
    {Vec3(-1, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0)},
    {Vec3(0, 1, 0), Vec3(0, -1, 0), Vec3(1, 0, 0), Vec3(-1, 0, 0)},
    {Vec3(0, -1, 0), Vec3(0, -1, 0), Vec3(1, 0, 0), Vec3(-1, 0, 0)},
    {Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(1, 0, 0), Vec3(-1, 0, 0)},
    {Vec3(0, 0, -1), Vec3(0, 0, -1), Vec3(1, 0, 0), Vec3(-1, 0, 0)},
}};

/// Returns a character as one stroke through the corners of
///   A B
///   C D
///   E F
/// A 1 is at the side of the origin. Characters of %g beyond these (the + of 1e+06) are blank.
std::string_view stroke_of(char character, bool origin_is_left) {
  switch (character) {
    case '0':
      return "ABFEA";
    case '1':
      return origin_is_left ? "AE" : "BF";
    case '2':
      return "ABDCEF";
    case '3':
      return "ABDCDFE";
    case '4':
      return "ACDBF";
    case '5':
      return "BACDFE";
    case '6':
      return "BAEFDC";
    case '7':
      return "ABE";
    case '8':
      return "ABFEACD";
    case '9':
      return "DCABF";
    case '-':
      return "CD";
    case '.':
      return "EF";
    case 'e':
      return "BACDCEF";
    default:
      return "";
  }
}

/// Writes a number at its mark. It begins or ends there, with the end that is nearer to the origin.
void draw_number(LinePainter& painter, const HalfAxis& axis, const std::string& text, double at,
                 double distance) {
  const bool runs_outwards = glm::dot(axis.direction, axis.reading) > 0;
  const double first = runs_outwards ? 0 : 1.0 - static_cast<double>(text.size());
  constexpr std::array<double, 3> kHeights = {kDigitTop, kDigitMiddle, kDigitBottom};
  for (std::size_t i = 0; i < text.size(); ++i) {
    const double middle = (first + static_cast<double>(i)) * kDigitAdvance;
    const auto corner = [&](char letter) {
      const auto index = static_cast<std::size_t>(letter - 'A');
      const double along = middle + (index % 2 == 0 ? -0.5 : 0.5) * kDigitWidth;
      return at * axis.direction +
             distance * (along * axis.reading + kHeights[index / 2] * axis.up);
    };
    const std::string_view stroke = stroke_of(text[i], runs_outwards);
    for (std::size_t k = 1; k < stroke.size(); ++k) {
      painter.draw(corner(stroke[k - 1]), corner(stroke[k]));
    }
  }
}

std::string number_text(double value) {
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%g", value);
  return text.data();
}

}  // namespace

void draw_axes(LinePainter& painter, double reach) {
  for (const Vec3& axis : kAxes) {
    painter.draw(Vec3(0.0), reach * axis);
    painter.draw(Vec3(0.0), -reach * axis, LineStyle::kStippled);
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

void draw_scale_marks(LinePainter& painter, const Camera& camera) {
  const double distance = camera.distance;
  const double step = std::pow(10, std::floor(std::log10(distance)) - 1);
  if (!std::isnormal(step)) return;  // the distance is too near to 0 for a tenth of it
  // Numbers are at the long marks, or, if there are few of these, at every other mark.
  const int numbered = distance < 30 * step ? 2 : 10;
  for (int i = 0; i * step < distance; ++i) {
    const double at = i * step;
    const double length = distance * (i % 10 == 0 ? kLongMark : kMark);
    for (const HalfAxis& axis : kHalfAxes) {
      const bool is_negative = axis.direction.x + axis.direction.y + axis.direction.z < 0;
      const Vec3 foot = at * axis.direction;
      painter.draw(foot, foot + length * axis.mark,
                   is_negative ? LineStyle::kStippled : LineStyle::kSolid);
      if (i == 0 || i % numbered != 0) continue;
      draw_number(painter, axis, number_text(is_negative ? -at : at), at, distance);
    }
  }
}

}  // namespace frontend
