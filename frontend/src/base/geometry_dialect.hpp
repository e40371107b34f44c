// What differs between the versions of OpenSCAD in what a tree means as geometry and as a picture,
// beyond what its text says: a table, each row with the behaviour of 2021.01 beside that of 2026,
// the development snapshots (OPENSCAD.md, "Versions"). Each row is read in one place. What differs
// in the language is in language/src/base/dialect.hpp.
#pragma once

#include "language/language_version.hpp"

namespace frontend {

class GeometryDialect : public language::VersionTable {
 public:
  using VersionTable::VersionTable;

  /// Whether a fraction of $fn is rounded up; else it is cut off.
  const bool rounds_fragments_up = row(false, true);
  /// Whether the edges of a twisted or unevenly scaled extrusion are cut into segments by $fn or
  /// $fs, where no `segments` are given, each of which counts as long as its longest image in a
  /// layer; and an uneven scale asks for its slices beside those that a twist asks for.
  const bool cuts_twisted_edges = row(false, true);
  /// Whether a round corner of an offset begins with whole chords and ends with one for what is
  /// left of its turn; else the number of chords is rounded.
  const bool has_chord_for_rest = row(false, true);
  /// Whether letters are placed and aligned in the units of their outlines. In 2021.01 they stand
  /// 1000/1024 as far apart, and other lengths align vertical texts.
  const bool places_letters_exactly = row(false, true);
  /// Whether `fontfeatures` in a font's name choose OpenType's features.
  const bool has_font_features = row(false, true);
  /// Whether what render() holds, and a final render, keep color(); and have the faces that
  /// anything without a colour has cut in the colour of cut faces.
  const bool keeps_colors = row(false, true);
  /// Whether the box that a camera is to see is that of all products, each the intersection of the
  /// boxes of its operands; else the union of the boxes of all that is not subtracted.
  const bool intersects_boxes = row(false, true);
  /// How thick plane figures are in that box.
  const double figure_thickness = row(0.0, 1.0);
  /// How far the axes are drawn, in distances of the camera: without an end, as far as a picture
  /// shows.
  const double axes_reach = row(1.0, 100.0);
  /// Whether it is said that AMF is a format of the past.
  const bool deprecates_amf = row(false, true);
};

}  // namespace frontend
