// A place in a file that an editor can open.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

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

}  // namespace frontend
