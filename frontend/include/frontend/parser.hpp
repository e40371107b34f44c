// Parses the text of a .csg into a syntax tree.
#pragma once

#include <cstdint>
#include <stop_token>
#include <string>
#include <string_view>

#include "frontend/syntax_tree.hpp"

namespace frontend {

/// Parses a .csg file, in the spelling of every OpenSCAD version or as a person may write it
/// (frontend/OPENSCAD.md, "The .csg file"). Time and memory are in proportion to the text; nesting
/// may be arbitrarily deep. `file_name` is used in messages only. Throws Error; and Stopped
/// (stop.hpp) once `stop` is requested.
SyntaxTree parse(std::string_view text, std::string file_name, const std::stop_token& stop = {});

/// Returns the tree of the node alone whose name is at `offset` of a text that parse() has taken.
/// Its places are those in the text from there on.
SyntaxTree parse_subtree(std::string_view text, uint32_t offset);

/// Returns whether no text that begins with `start` can be parsed: parse() of `start`, and of each
/// of those texts, throws the same Error. So an endless input can be refused after its start.
bool is_beyond_repair(std::string_view start, const std::stop_token& stop = {});

}  // namespace frontend
