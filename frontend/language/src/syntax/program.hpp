// A design's main file and the files it uses, parsed.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "base/dialect.hpp"
#include "base/name_table.hpp"
#include "language/source_files.hpp"
#include "language/text_overlay.hpp"
#include "syntax/arena.hpp"
#include "syntax/kept_sources.hpp"
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

/// How a design is parsed.
struct ParseOptions {
  std::vector<std::string> definitions;  // -D, in order, as typed
  bool hard_warnings = false;
  std::stop_token stop;
  std::optional<std::string_view> text;  // of the main file; nothing: it is read
  const TextOverlay* overlay = nullptr;  // texts of other files; null: they are read
};

struct Program {
  /// `sources` are what programs of a design share that are in the same dialect.
  explicit Program(const Dialect& of = dialect_of(LanguageVersion::k2021),
                   std::shared_ptr<KeptSources> sources = std::make_shared<KeptSources>())
      : dialect(of), kept(std::move(sources)), names(kept->names) {}

  /// Returns the kept file of a number; null: the main file.
  KeptFile* kept_file(FileId file) const {
    return file < kept_files.size() ? kept_files[file].get() : nullptr;
  }

  /// Returns the folder from which messages of a unit show paths.
  const std::string& shown_folder(uint32_t unit) const {
    return units[dialect.shows_paths_from_main_file ? 0 : unit].folder;
  }

  const Dialect& dialect;
  std::shared_ptr<KeptSources> kept;
  NameTable& names;
  std::vector<std::shared_ptr<KeptFile>> kept_files;  // by number
  Arena arena;                                        // holds the syntax trees that are not kept
  SourceFiles files;
  std::deque<Unit> units;            // 0 is the main file; each used file stands here once
  std::vector<std::string> lookups;  // absolute paths that were tried and do not exist
  bool is_parsed = false;            // false: the main file has a syntax error; messages say so
};

}  // namespace language
