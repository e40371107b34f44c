// A place in a file that an editor can open, and the way to a leaf of a design.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/design_tree.hpp"
#include "language/source_files.hpp"

namespace frontend {

struct SourcePlace {
  std::string path;     // absolute; empty: no file that could be opened has it
  std::string file;     // its name, without folders
  uint32_t line = 0;    // from 1
  uint32_t column = 0;  // in characters, from 1
};

/// Returns the place of a byte of a file's text, which is in that line. A path that is not absolute
/// counts as the name of a text that is no file.
SourcePlace source_place(const std::string& path, uint32_t line, std::string_view text,
                         std::size_t offset);
/// Returns a place in the files of an evaluation.
SourcePlace source_place(const language::SourceFiles& files, language::Place place);

/// Returns "name:line:column"; empty if there is no place.
std::string text_of(const SourcePlace& place);

/// Where a leaf of a design stands in the design's text, and the calls that led to it.
struct TrailStep {
  std::string what;  // the node in few words, or the call as the design spells it
  SourcePlace place;
  language::Place at{};  // the same in DesignTree::files
};

/// The way to a leaf, from the inside out: what it is made of, if that is one primitive; the calls
/// of the design's own modules that stand in between; the leaf; and the calls that it stands in.
/// Control structures, transformations and operations are no steps.
struct LeafPlace {
  std::vector<TrailStep> trail;  // never empty
  std::size_t leaf = 0;          // its index in the trail

  const TrailStep& step() const { return trail[leaf]; }
};

/// `node` is one of ImportedDesign::places. A .csg has no calls: the trail is in the .csg.
LeafPlace leaf_place(const DesignTree& tree, uint32_t node);

}  // namespace frontend
