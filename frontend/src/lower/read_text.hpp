// Text node → its letters.
#pragma once

#include <vector>

#include "fonts/design_fonts.hpp"
#include "frontend/design_tree.hpp"
#include "lower/node_problems.hpp"

namespace frontend {

/// Returns the arguments of a text node, with OpenSCAD's defaults. A text that is no string is
/// empty.
TextSettings read_text(const NodeTree& tree, const Node& node, NodeProblems& problems);

/// Returns the letters that have ink, and tells which font stands in for one that is missing.
/// `pieces`: how many chords a curve becomes; 0: it stays a curve.
std::vector<PlacedGlyph> letters_of(const Node& node, const TextSettings& text, int pieces,
                                    DesignFonts& fonts, NodeProblems& problems);

}  // namespace frontend
