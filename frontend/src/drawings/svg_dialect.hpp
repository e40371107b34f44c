// What differs between the versions of OpenSCAD in what an SVG document draws: a table, each row
// with the behaviour of 2021.01 beside that of 2026.
#pragma once

#include "language/language_version.hpp"
#include "plane/outlines.hpp"

namespace frontend {

class SvgDialect : public language::VersionTable {
 public:
  using VersionTable::VersionTable;

  /// Whether `use`, `display` and import()'s `id` and `layer` decide which elements are drawn; else
  /// all are that stand outside of `defs`.
  const bool chooses_elements = row(false, true);
  /// Whether blanks around a unit and the values of `style` are none of them.
  const bool trims_words = row(false, true);
  /// Whether a page's length in percent is one of the view box's; else it is none at all.
  const bool has_percents = row(false, true);
  /// Whether $fn, $fa and $fs may ask for more chords.
  const bool follows_facets = row(false, true);
  /// The ends of lines whose `stroke-linecap` is missing, and the chords of pens.
  const LineEnds line_ends = row(StrokeSettings{}.ends, LineEnds::kButt);
  const StrokeChords pen_chords = row(StrokeChords::kOf2021, StrokeChords::kOf2026);
};

}  // namespace frontend
