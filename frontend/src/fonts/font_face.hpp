// A font, opened: the shaping of text by HarfBuzz, and the outlines of glyphs by FreeType.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "csgcore/profile.hpp"
#include "fonts/font_libraries.hpp"
#include "frontend/file_text.hpp"
#include "plane/figure.hpp"

namespace frontend {

/// What a text node says of its letters. An empty word means that it says nothing.
struct TextLetters {
  std::string text;  // in UTF-8
  std::string direction, script, language;
};

/// A text as HarfBuzz takes it: its letters, and how they run.
struct TextRun {
  std::vector<uint32_t> letters;  // code points
  hb_direction_t direction = HB_DIRECTION_LTR;
  hb_script_t script = HB_SCRIPT_UNKNOWN;
  hb_language_t language = nullptr;
  std::vector<hb_feature_t> features{};  // OpenType's, beside those that are usual

  bool is_vertical() const { return HB_DIRECTION_IS_VERTICAL(direction); }
};

/// Returns the letters, with the script that all of them share, where none is given, and the
/// direction of the script (text_layout.hpp). Bytes that are no UTF-8 are replaced.
TextRun run_of(const FontLibraries& libraries, const TextLetters& text);

/// Fonts are opened at this size in points, so that an outline has this many units for each unit of
/// a text's `size` (text_layout.hpp).
constexpr double kOutlineUnits = 1e5;

/// A glyph's outline, in units of 1/kOutlineUnits, about its origin. It has the font's windings,
/// and is filled where they are not 0.
struct GlyphShape {
  std::shared_ptr<const Figure> figure;             // null: the glyph has no ink
  std::shared_ptr<const csgcore::Profile> profile;  // of the figure
};

/// Returns the outline. `pieces` 0: its curves are kept, those of the third degree as quadratic
/// ones that are off by kCubicTolerance at most. Else each curve becomes that many chords, at equal
/// steps of its parameter.
GlyphShape shape_of(const FontLibraries& libraries, FT_Outline& outline, int pieces);

/// Fonts' control points are rounded to whole units, and so are the curves themselves good to half
/// a unit: 4e-6 of the letters' height, far below a pixel.
constexpr double kCubicTolerance = 0.5;

/// A glyph of a shaped text. Offset and advance are in outlines' units, and unhinted.
struct ShapedGlyph {
  uint32_t index = 0;  // in the font
  Vec2 offset{0.0}, advance{0.0};
};

/// Not to be used by several threads at once.
class FontFace {
 public:
  /// Returns null if the file's text is no font that can be scaled.
  static std::shared_ptr<FontFace> open(const FontLibraries& libraries, FT_Library freetype,
                                        FileText file, int index);
  FontFace(const FontFace&) = delete;
  FontFace& operator=(const FontFace&) = delete;
  ~FontFace();

  /// Returns the glyphs in the order in which they are drawn, which is the text's, or its reverse.
  std::vector<ShapedGlyph> shape(const TextRun& run) const;

  /// Returns the box of the glyph's control points, rounded outwards to whole pixels; empty if it
  /// has none.
  const Rectangle& pixel_box(uint32_t glyph);
  /// What the font says of all its letters, in outlines' units: how far they reach above the
  /// baseline, and below, which is negative; and its names.
  struct Extent {
    double ascent, descent;
    double most_ascent, most_descent;
    double line_distance;
    std::string family, style;
  };
  Extent extent() const;
  /// Returns the glyph's outline: shape_of(), made once.
  const GlyphShape& shape_of_glyph(uint32_t glyph, int pieces);

 private:
  FontFace(const FontLibraries& libraries, FileText file)
      : libraries_(libraries), file_(std::move(file)) {}
  void shape_part(const TextRun& run, size_t begin, size_t end,
                  std::vector<ShapedGlyph>& glyphs) const;
  /// Returns null if the glyph has no outline.
  FT_Outline* load(uint32_t glyph);

  const FontLibraries& libraries_;
  FileText file_;  // FreeType reads it when it needs a glyph
  FT_Face face_ = nullptr;
  hb_font_t* font_ = nullptr;
  std::map<uint32_t, Rectangle> boxes_;
  std::map<std::pair<uint32_t, int>, GlyphShape> shapes_;
};

}  // namespace frontend
