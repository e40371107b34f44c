// Finds and reads the files of a design while they are parsed.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "language/text_overlay.hpp"
#include "messages/messages.hpp"
#include "syntax/lexer.hpp"
#include "syntax/program.hpp"

namespace language {

/// Finds files as `include` and `use` do (LANGUAGE.md, "Text"), in the order: absolute path; the
/// folder of the file that names it; the parts of OPENSCADPATH; the user's and the system's library
/// folder.
class LibrarySearch {
 public:
  /// Reads the environment. Absolute paths that were tried and do not exist are added to `lookups`.
  /// Files of the overlay, which may be null, exist.
  explicit LibrarySearch(std::vector<std::string>& lookups, const TextOverlay* overlay = nullptr);

  /// Returns the absolute path of a file that is named in a file of `folder` (absolute). Links and
  /// dots are followed, except, as in OpenSCAD, where a library folder has it: then its path is
  /// that of the library folder, and the name. Empty: there is none but folders and the paths in
  /// `excluded`.
  std::string find(std::string_view name, const std::string& folder,
                   std::span<const std::string> excluded = {});
  /// Those of OPENSCADPATH, the user and the system, in the order in which they are searched.
  const std::vector<std::string>& library_folders() const { return library_folders_; }

 private:
  bool is_file(const std::filesystem::path& path);

  std::vector<std::string>& lookups_;
  const TextOverlay* overlay_;
  std::vector<std::string> library_folders_;  // absolute
};

class ProgramReader : public FileLookup {
 public:
  ProgramReader(Program& program, Messages& messages, const ParseOptions& options);

  /// Adds the main file as unit 0. Returns false if it cannot be read.
  bool read_main(const std::string& path);
  /// Parses the main file. Returns false after a syntax error.
  bool parse_main() { return parse(0); }
  /// Parses all files that unit 0 uses, and those that they use.
  void parse_used();

  FileId include(const FileReference& file) override;
  void use(const FileReference& file) override;
  void leave(FileId file) override {
    if (KeptFile* kept = program_.kept_file(file)) kept->is_read = true;
  }

 private:
  void look_whether_to_stop() const;
  void set_main_unit(uint32_t unit);
  bool parse(uint32_t unit);
  uint32_t add_unit(FileId file, std::string folder);
  FileId open(KeptSources::Role role, const std::string& path);
  void cannot_open(std::string_view words, const FileReference& file, const std::string& path);
  std::string unit_text(std::string text) const;
  void use_font(const std::string& name, const std::string& path);

  Program& program_;
  Messages& messages_;
  const ParseOptions& options_;
  LibrarySearch search_;
  uint32_t current_unit_ = 0;                         // the one being parsed
  std::string last_path_name_;                        // see Lexer::Main
  std::unordered_map<std::string, FileId> included_;  // by path
  std::unordered_map<std::string, uint32_t> used_;    // units by path
};

}  // namespace language
