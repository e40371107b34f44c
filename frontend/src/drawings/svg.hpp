// The parts of an SVG document that svg.cpp reads: numbers, the page and paths.
#pragma once

#include <charconv>
#include <functional>
#include <limits>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "csg/lexer.hpp"
#include "csgcore/facets.hpp"
#include "drawings/curve_path.hpp"
#include "drawings/drawing.hpp"
#include "drawings/svg_dialect.hpp"
#include "plane/outlines.hpp"
#include "plane/plane_map.hpp"

namespace frontend {

/// Returns the number that an attribute holds, as OpenSCAD 2021.01 reads it; 0 if the word is none,
/// or has anything behind it. One that exceeds a double is infinite, so that its shape is out of
/// range; OpenSCAD takes it for 0, without a word.
inline double svg_number(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error == std::errc::invalid_argument || end != word.data() + word.size()) return 0;
  if (error != std::errc::result_out_of_range) return value;
  const bool is_small = is_below_one(word.substr(word.starts_with('-') ? 1 : 0));
  return is_small ? 0 : std::numeric_limits<double>::infinity();
}

/// Returns the element's attribute as a number, 0 where it is missing.
inline double svg_number(const pugi::xml_node& element, const char* name) {
  return svg_number(element.attribute(name).value());
}

inline bool is_svg_separator(char c) {
  return c == ' ' || c == ',' || c == '\t' || c == '\n' || c == '\r' || c == '\f';
}

/// Takes the next word between blanks and commas from the front of the text; empty at its end.
inline std::string_view take_svg_word(std::string_view& text) {
  while (!text.empty() && is_svg_separator(text.front())) text.remove_prefix(1);
  size_t length = 0;
  while (length < text.size() && !is_svg_separator(text[length])) ++length;
  const std::string_view word = text.substr(0, length);
  text.remove_prefix(length);
  return word;
}

/// Takes what separates words from both ends of the text.
inline std::string_view trimmed_svg(std::string_view text) {
  while (!text.empty() && is_svg_separator(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_svg_separator(text.back())) text.remove_suffix(1);
  return text;
}

/// The chords that OpenSCAD has for curves.
class SvgChords {
 public:
  /// Those of 2021.01, which no settings change.
  SvgChords() = default;
  /// Those of 2026: 2021.01's, or as many as $fn, $fa and $fs ask for, if these are more.
  explicit SvgChords(const csgcore::FacetSettings& facets) : facets_(facets) {}

  int circle(const Vec2& radii) const;
  /// Returns where a circle's chords begin, in radians from the x axis to the y axis.
  double circle_start() const;
  /// `sweep` in radians, of either sign.
  int arc(double sweep, const Vec2& radii) const;
  int bezier() const;

 private:
  double fragments(const Vec2& radii) const;

  std::optional<csgcore::FacetSettings> facets_;
};

/// Returns those that the settings ask for.
inline SvgChords svg_chords(const SvgSettings& settings) {
  return SvgDialect(settings.language).follows_facets ? SvgChords(settings.facets) : SvgChords();
}

/// What a path draws: closed parts, which are filled, and open ones, which a pen follows.
struct SvgPath {
  std::vector<CurvePath> filled;
  std::vector<CurvePath> open;
};

/// Reads the attribute `d`, by OpenSCAD 2021.01's rules (svg.cpp). A number that cannot be read is
/// 0, and an incomplete set of numbers is left out.
SvgPath read_svg_path(std::string_view data, const SvgChords& chords);

/// Returns the part of an ellipse with the axes rx along (cos, sin) of the rotation, and ry, both
/// not 0, from one point to another one; scaled up if it cannot reach both.
EllipseArc svg_arc(const Vec2& from, const Vec2& to, Vec2 radii, double rotation_deg, bool is_large,
                   bool is_clockwise_on_paper);

/// A drawn element.
struct SvgShape {
  PlaneMap map;           // to the document's coordinates
  SvgPath path;           // by the even-odd rule
  StrokeSettings stroke;  // of what is open
  bool is_circle = false;
};

/// Returns the element's shape in its own coordinates; nothing if it is none, or empty.
std::optional<SvgShape> read_svg_shape(const pugi::xml_node& element, const SvgSettings& settings);

/// Returns the value that an attribute gives, or else the attribute `style`; empty where neither
/// does.
std::string_view svg_style(const pugi::xml_node& element, const char* name,
                           const SvgDialect& dialect);

/// An element that is drawn, and the map to the document's coordinates.
struct SvgElement {
  pugi::xml_node node;
  PlaneMap map;
};

/// Returns the elements that are drawn, in their order (svg.cpp). Calls take_page(element) with
/// every `svg` element, and adds problems.
std::vector<SvgElement> drawn_svg_elements(
    const pugi::xml_node& root, const std::string& name, const SvgSettings& settings,
    const std::function<void(const pugi::xml_node&)>& take_page,
    std::vector<DrawingProblem>& problems);

/// Where a document's coordinates lie, in mm: what OpenSCAD makes of the attributes of `svg`
/// elements (svg.cpp). If there are several, the last one places all that is drawn.
class SvgPage {
 public:
  /// `dpi` is that of lengths without a unit.
  SvgPage(double dpi, const SvgDialect& dialect) : dpi_(dpi), dialect_(dialect) {}

  void take(const pugi::xml_node& svg);

  /// Returns the map from the document's coordinates to the plane's. Its y axis points upwards.
  PlaneMap map() const;
  /// Returns where the middle of a centred drawing lies.
  Vec2 middle() const { return {-origin_.x * scale_.x, -origin_.y * scale_.y}; }

 private:
  double dpi_;
  SvgDialect dialect_;
  double height_ = 0;
  Vec2 scale_{1.0};
  Vec2 origin_{0.0};  // of the view box
  Vec2 margin_{0.0};
};

/// Returns the map that a `transform` attribute stands for. A transformation with a wrong count of
/// numbers is left out.
PlaneMap read_svg_transform(std::string_view text);

}  // namespace frontend
