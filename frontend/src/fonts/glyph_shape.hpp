// The outlines of glyphs, as plane figures.
#pragma once

#include <memory>

#include "csgcore/profile.hpp"
#include "fonts/font_libraries.hpp"
#include "plane/figure.hpp"

namespace frontend {

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

}  // namespace frontend
