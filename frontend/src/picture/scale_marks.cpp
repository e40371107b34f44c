#include "picture/scale_marks.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <string>
#include <string_view>

namespace frontend {
namespace {

using csgcore::Vec3;

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
