// Where the letters of a text stand, as OpenSCAD's text() places them.
// - FreeType opens the font at 10⁵/64 points and 100 dots per inch, and loads glyphs hinted. A
//   glyph's coordinates, in 1/64 of a pixel, are divided by 10⁵ and multiplied by size: the em is
//   1.38889·size. A negative size turns the text by 180°; a size of 0, or one that is not finite,
//   leaves nothing, and one that is no number is 10.
// - HarfBuzz's advances and offsets, and all lengths of alignment, are divided by 1.024·10⁵:
//   letters stand 2.34 % closer than their size says. An advance, not an offset, is multiplied by
//   spacing, which may be 0 or negative.
// - halign moves by the sum of the advances, or by half of it. valign moves by the ascent (top,
//   down), the descent (bottom, up) or half their difference: the furthest that a glyph's box
//   reaches above and below the baseline, if it does. The box is that of the control points,
//   rounded outwards to whole pixels. In vertical directions the width is that of the widest box,
//   the ascent is the sum of the advances along y, which is negative, and the descent is 0. An
//   unknown word counts as missing, with a message.
// - direction is the given one, or the script's; script the given one, or the one that all letters
//   share which are not of all scripts; language is en if none is given. Control characters are
//   letters like others.
// - All letters and their contours are united by their winding numbers: inside is where it is not
//   0.
// - Each curve of a letter has ⌊N/8⌋ + 1 chords, at least 2, at equal steps of its parameter, where
//   N is the number of fragments of a circle of the radius size.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "fonts/font_face.hpp"
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
