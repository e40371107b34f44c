// A font, opened: the shaping of text by HarfBuzz, and the glyphs by FreeType.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "fonts/font_libraries.hpp"
#include "fonts/glyph_shape.hpp"
#include "fonts/text_run.hpp"
#include "frontend/file_text.hpp"

namespace frontend {

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
