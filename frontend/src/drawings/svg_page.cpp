#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <vector>

#include "base/angles.hpp"
#include "drawings/svg.hpp"

namespace frontend {
namespace {

constexpr double kInch = 25.4;
constexpr double kPixelsPerInch = 96;  // of CSS
constexpr double kPointsPerInch = 72;
constexpr double kPicasPerInch = 6;

struct Length {
  double number = 0;
  enum class Unit : uint8_t { kNone, kPercent, kRelative, kMillimetres } unit = Unit::kNone;
};

/// Returns nothing where the length is missing or cannot be read.
std::optional<Length> read_length(std::string_view text, const SvgDialect& dialect) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || !std::isfinite(number)) return std::nullopt;
  std::string_view unit(end, static_cast<size_t>(text.data() + text.size() - end));
  if (dialect.trims_words) unit = trimmed_svg(unit);
  const auto in_mm = [&](double mm) { return Length{number * mm, Length::Unit::kMillimetres}; };
  if (unit.empty()) return Length{number, Length::Unit::kNone};
  if (unit == "%" && dialect.has_percents) {
    return Length{number, Length::Unit::kPercent};
  }
  if (unit == "%" || unit == "em" || unit == "ex") return Length{number, Length::Unit::kRelative};
  if (unit == "mm") return in_mm(1);
  if (unit == "cm") return in_mm(10);
  if (unit == "in") return in_mm(kInch);
  if (unit == "px") return in_mm(kInch / kPixelsPerInch);
  if (unit == "pt") return in_mm(kInch / kPointsPerInch);
  if (unit == "pc") return in_mm(kInch / kPicasPerInch);
  return std::nullopt;
}

struct ViewBox {
  Vec2 origin{0.0};
  Vec2 size{0.0};
};

std::optional<ViewBox> read_view_box(std::string_view text) {
  std::array<double, 4> numbers{};
  for (double& number : numbers) {
    const std::string_view word = take_svg_word(text);
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(number)) {
      return std::nullopt;
    }
  }
  if (!take_svg_word(text).empty()) return std::nullopt;
  return ViewBox{{numbers[0], numbers[1]}, {numbers[2], numbers[3]}};
}

/// The share of the view box that a length in % is; 1 for others.
double share_of(const std::optional<Length>& length) {
  return length && length->unit == Length::Unit::kPercent ? length->number / 100 : 1;
}

/// In mm. What is missing has the size of the view box, as if it had no unit, or the share of it
/// that is given; a relative length has it in mm.
double resolved(const std::optional<Length>& length, double view_box_size, double dpi) {
  if (!length) return view_box_size * kInch / dpi;
  switch (length->unit) {
    case Length::Unit::kNone:
      return length->number * kInch / dpi;
    case Length::Unit::kPercent:
      return share_of(length) * view_box_size * kInch / dpi;
    case Length::Unit::kRelative:
      return view_box_size;
    case Length::Unit::kMillimetres:
      break;
  }
  return length->number;
}

/// The share of the room beside the drawing that comes before it.
double share_before(std::string_view align, std::string_view axis) {
  const size_t at = align.find(axis);
  if (at == std::string_view::npos) return 0.5;
  const std::string_view word = align.substr(at + axis.size(), 3);
  return word == "Min" ? 0 : word == "Max" ? 1 : 0.5;
}

double factor(double size, double view_box_size) {
  return view_box_size != 0 ? size / view_box_size : 0;
}

/// Scales by x and y alike, so that the whole view box is seen, or its part that fills the page.
double common_factor(const Vec2& factors, bool is_slice) {
  if (factors.x == 0 || factors.y == 0) return std::max(factors.x, factors.y);
  return is_slice ? std::max(factors.x, factors.y) : std::min(factors.x, factors.y);
}

PlaneMap rotation(double angle_deg, const Vec2& center) {
  const double c = std::cos(angle_deg * kDegree);
  const double s = std::sin(angle_deg * kDegree);
  PlaneMap map;
  map.linear = glm::dmat2(c, s, -s, c);
  map.translation = center - map.linear * center;
  return map;
}

/// Returns nothing if the name, or the count of numbers, is wrong.
std::optional<PlaneMap> transformation(std::string_view name, const std::vector<double>& numbers) {
  const size_t count = numbers.size();
  const auto linear = [](double xx, double yx, double xy, double yy) {
    return PlaneMap{glm::dmat2(xx, yx, xy, yy), Vec2(0.0)};
  };
  if (name == "matrix" && count == 6) {
    PlaneMap map = linear(numbers[0], numbers[1], numbers[2], numbers[3]);
    map.translation = {numbers[4], numbers[5]};
    return map;
  }
  if (name == "translate" && (count == 1 || count == 2)) {
    return PlaneMap{glm::dmat2(1.0), Vec2(numbers[0], count == 2 ? numbers[1] : 0)};
  }
  if (name == "scale" && (count == 1 || count == 2)) {
    return linear(numbers[0], 0, 0, numbers[count - 1]);
  }
  if (name == "rotate" && (count == 1 || count == 3)) {
    return rotation(numbers[0], count == 3 ? Vec2(numbers[1], numbers[2]) : Vec2(0.0));
  }
  if (name == "skewX" && count == 1) return linear(1, 0, std::tan(numbers[0] * kDegree), 1);
  if (name == "skewY" && count == 1) return linear(1, std::tan(numbers[0] * kDegree), 0, 1);
  return std::nullopt;
}

}  // namespace

void SvgPage::take(const pugi::xml_node& svg) {
  const std::optional<ViewBox> box = read_view_box(svg.attribute("viewBox").value());
  const std::optional<Length> width = read_length(svg.attribute("width").value(), dialect_);
  const std::optional<Length> height = read_length(svg.attribute("height").value(), dialect_);
  height_ = resolved(height, box ? box->size.y : 0, dpi_);
  if (!box) return;
  const Vec2 page(resolved(width, box->size.x, dpi_), height_);
  const Vec2 factors(factor(page.x, box->size.x), factor(page.y, box->size.y));
  const std::string_view align = svg.attribute("preserveAspectRatio").value();
  origin_ = box->origin * Vec2(share_of(width), share_of(height));
  scale_ = factors;
  margin_ = Vec2(0.0);
  if (align.starts_with("none")) return;
  scale_ = Vec2(common_factor(factors, align.find("slice") != std::string_view::npos));
  const Vec2 rest = page - scale_ * box->size;
  margin_ = {share_before(align, "x") * rest.x, share_before(align, "Y") * rest.y};
}

PlaneMap SvgPage::map() const {
  PlaneMap map;
  map.linear = glm::dmat2(scale_.x, 0, 0, -scale_.y);
  // OpenSCAD subtracts the view box's y after it has turned the axis over.
  map.translation = Vec2(margin_.x, height_ - margin_.y) + middle();
  return map;
}

PlaneMap read_svg_transform(std::string_view text) {
  PlaneMap map;
  while (true) {
    const size_t open = text.find('(');
    if (open == std::string_view::npos) return map;
    const size_t close = text.find(')', open);
    if (close == std::string_view::npos) return map;
    const std::string_view name = trimmed_svg(text.substr(0, open));
    std::string_view words = text.substr(open + 1, close - open - 1);
    std::vector<double> numbers;
    for (std::string_view word = take_svg_word(words); !word.empty(); word = take_svg_word(words)) {
      numbers.push_back(svg_number(word));
    }
    if (const std::optional<PlaneMap> next = transformation(name, numbers)) {
      map = compose(map, *next);
    }
    text.remove_prefix(close + 1);
  }
}

}  // namespace frontend
