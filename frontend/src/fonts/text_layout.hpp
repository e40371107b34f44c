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
// - OpenSCAD's development snapshots divide all lengths by 10⁵. They align by the advances and by
//   the boxes of the letters that have ink: center moves up by half of the sum of the highest and
//   the lowest place of a box. In vertical directions left and right move by the box of all
//   letters, and only center and bottom move by the sum of the advances. Unless the text says
//   otherwise, its letters begin at the origin; those of a vertical text are centred on it.
// - direction is the given one, or the script's; script the given one, or the one that all letters
//   share which are not of all scripts; language is en if none is given. Control characters are
//   letters like others.
// - All letters and their contours are united by their winding numbers: inside is where it is not
//   0.
// - Each curve of a letter has ⌊N/8⌋ + 1 chords, at least 2, at equal steps of its parameter, where
//   N is the number of fragments of a circle of the radius size.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "fonts/font_face.hpp"
#include "plane/plane_map.hpp"

namespace frontend {

enum class HorizontalAlign : uint8_t { kDefault, kLeft, kCenter, kRight };
enum class VerticalAlign : uint8_t { kDefault, kBaseline, kTop, kCenter, kBottom };

/// The words for alignments, in the order in which a message lists them; another one, or none,
/// means kDefault.
template <typename Align>
struct AlignWord {
  std::string_view word;
  Align align;
};
constexpr std::array<AlignWord<HorizontalAlign>, 3> kHorizontalWords = {
    {{"left", HorizontalAlign::kLeft},
     {"right", HorizontalAlign::kRight},
     {"center", HorizontalAlign::kCenter}}};
constexpr std::array<AlignWord<VerticalAlign>, 4> kVerticalWords = {
    {{"baseline", VerticalAlign::kBaseline},
     {"bottom", VerticalAlign::kBottom},
     {"top", VerticalAlign::kTop},
     {"center", VerticalAlign::kCenter}}};

/// Returns the alignment that a word means, or the default.
template <typename Align, size_t kCount>
Align align_of(std::string_view word, const std::array<AlignWord<Align>, kCount>& words) {
  for (const AlignWord<Align>& known : words) {
    if (known.word == word) return known.align;
  }
  return Align::kDefault;
}

/// The arguments of a text node.
struct TextSettings {
  TextLetters letters;
  std::string font;  // a fontconfig pattern
  double size = 10;
  double spacing = 1;
  HorizontalAlign halign = HorizontalAlign::kDefault;
  VerticalAlign valign = VerticalAlign::kDefault;
  bool is_placed_exactly = false;  // GeometryDialect::places_letters_exactly
  bool has_features = false;       // GeometryDialect::has_font_features
};

/// A letter with ink, where it stands.
struct PlacedGlyph {
  GlyphShape shape;
  PlaneMap place;  // from the shape's units
};

/// The lengths of a text of size 1 that OpenSCAD's development snapshots align it by.
class MeasuredText {
 public:
  MeasuredText(const std::vector<ShapedGlyph>& glyphs, double spacing, bool is_vertical,
               FontFace& font);

  /// Returns the box of all letters where they stand without an alignment, which is that of their
  /// control points, rounded outwards to whole pixels. Empty: none of them has ink.
  const Rectangle& box() const { return box_; }
  double ascent() const { return ascent_; }    // the highest place of a letter's box
  double descent() const { return descent_; }  // the lowest one
  const Vec2& advance() const { return advance_; }
  /// Returns by how much an alignment moves the letters.
  Vec2 offset(HorizontalAlign halign, VerticalAlign valign) const;

 private:
  const bool is_vertical_;
  bool is_empty_ = true;  // whether no letter has ink
  Rectangle box_;
  double ascent_ = 0, descent_ = 0;
  Vec2 advance_{0.0};
};

/// Returns the letters of the text, as the run has them, in the font. `pieces` is that of
/// shape_of(). What stands at no finite place is left out.
std::vector<PlacedGlyph> lay_out(const TextSettings& text, const TextRun& run, FontFace& font,
                                 int pieces);

}  // namespace frontend
