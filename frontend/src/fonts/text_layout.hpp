// Where the letters of a text stand, as OpenSCAD's text() places them (frontend/OPENSCAD.md,
// "Text").
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "fonts/font_face.hpp"
#include "fonts/text_run.hpp"
#include "plane/plane_map.hpp"

namespace frontend {

enum class HorizontalAlign : uint8_t { kLeft, kCenter, kRight };
enum class VerticalAlign : uint8_t { kBaseline, kTop, kCenter, kBottom };

/// The arguments of a text node.
struct TextSettings {
  TextLetters letters;
  std::string font;  // a fontconfig pattern
  double size = 10;
  double spacing = 1;
  HorizontalAlign halign = HorizontalAlign::kLeft;
  VerticalAlign valign = VerticalAlign::kBaseline;
};

/// A letter with ink, where it stands.
struct PlacedGlyph {
  GlyphShape shape;
  PlaneMap place;  // from the shape's units
};

/// Returns the letters of the text, as the run has them, in the font. `pieces` is that of
/// shape_of(). What stands at no finite place is left out.
std::vector<PlacedGlyph> lay_out(const TextSettings& text, const TextRun& run, FontFace& font,
                                 int pieces);

}  // namespace frontend
