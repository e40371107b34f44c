// A design's main file and the files it uses, parsed.
#pragma once

#include <deque>
#include <memory_resource>
#include <string>
#include <vector>

#include "base/name_table.hpp"
#include "language/source_files.hpp"
#include "syntax/syntax.hpp"

namespace language {

/// A file that is parsed by itself: the main file or a used one, with the text it includes.
struct Unit {
  FileId file = kNoFile;
  std::string folder;              // absolute: where relative paths of its code begin
  const Scope* scope = nullptr;    // null: it could not be parsed, and counts as empty
  std::vector<uint32_t> uses;      // indices into Program::units, in source order
  std::vector<std::string> fonts;  // font files that it names in `use`
};

struct Program {
  std::pmr::monotonic_buffer_resource arena;  // holds the syntax trees and their strings
  NameTable names;
  SourceFiles files;
  std::deque<Unit> units;            // 0 is the main file; each used file stands here once
  std::vector<std::string> lookups;  // absolute paths that were tried and do not exist
  bool is_parsed = false;            // false: the main file has a syntax error; messages say so
};

}  // namespace language
