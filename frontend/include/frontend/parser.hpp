// Text → syntax tree.
#pragma once

#include <stop_token>
#include <string>
#include <string_view>

#include "frontend/syntax_tree.hpp"

namespace frontend {

/// Parses a .csg file (frontend/OPENSCAD.md, "The .csg file": every version's spelling, and what a
/// person may write by hand). Time and memory are in proportion to the text; nesting may be
/// arbitrarily deep. `file_name` is used in messages only. Throws Error, and Stopped (stop.hpp)
/// where `stop` asks for it.
SyntaxTree parse(std::string_view text, std::string file_name, const std::stop_token& stop = {});

/// Whether no text that begins with `start` can be parsed: parse(start), and that of all of them,
/// throws the same Error. So what never ends is refused without reading it all.
bool is_beyond_repair(std::string_view start, const std::stop_token& stop = {});

}  // namespace frontend
