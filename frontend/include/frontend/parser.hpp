// Parses the text of a .csg into the tree of its nodes.
#pragma once

#include <stop_token>
#include <string>
#include <string_view>

#include "frontend/design_tree.hpp"
#include "frontend/file_text.hpp"

namespace frontend {

/// Parses a .csg file, in the spelling of every OpenSCAD version or as a person may write it
/// (frontend/OPENSCAD.md, "The .csg file"). Time and memory are in proportion to the text, which
/// the tree keeps; nesting may be arbitrarily deep. What has `*` is checked and dropped. `name` is
/// what messages call the file; `path` is where it is, absolute, or "" if there is none. Throws
/// Error; and Stopped (stop.hpp) once `stop` is requested.
DesignTree parse(const FileText& text, std::string name, std::string path = {},
                 const std::stop_token& stop = {});
/// The same of a copy of the text.
DesignTree parse(std::string_view text, std::string name);

/// Returns whether no text that begins with `start` can be parsed: parse() of `start`, and of each
/// of those texts, throws the same Error. So an endless input can be refused after its start.
bool is_beyond_repair(std::string_view start, const std::stop_token& stop = {});

}  // namespace frontend
