// What textmetrics() and fontmetrics() ask of the fonts that draw.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>

namespace language {

/// What text() shows. An empty word means that it says nothing.
struct TextRequest {
  std::string text;  // in UTF-8
  double size = 10, spacing = 1;
  std::string font;  // a fontconfig pattern
  std::string direction, script, language;
  std::string halign, valign;  // a word that is not known says nothing
};

/// Where a text lies in the plane, in its units.
struct TextMetrics {
  bool has_ink = false;
  std::array<double, 2> position{}, size{};  // of the box around the letters
  double ascent = 0, descent = 0;            // above and below the baseline; below is negative
  std::array<double, 2> offset{};            // that alignment makes, of the first letter's origin
  std::array<double, 2> advance{};           // from there to where another text would go on
};

/// The same of a font's letters, and the distance of lines.
struct FontMetrics {
  double ascent = 0, descent = 0;            // that its maker names
  double most_ascent = 0, most_descent = 0;  // of all letters
  double line_distance = 0;
  std::string family, style;
};

class TextMeter {
 public:
  virtual ~TextMeter() = default;
  /// Both return nothing if there is no such font. `fonts` are the files that the design brings
  /// along.
  virtual std::optional<TextMetrics> measure(const TextRequest& text,
                                             std::span<const std::string> fonts) = 0;
  virtual std::optional<FontMetrics> measure_font(const std::string& font, double size,
                                                  std::span<const std::string> fonts) = 0;
};

}  // namespace language
