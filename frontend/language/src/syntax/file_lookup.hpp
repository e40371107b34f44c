// What `include` and `use` name.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "language/place.hpp"

namespace language {

/// A path as a design writes it.
struct FileReference {
  std::string_view name;
  Place place;                                  // of the `include` or `use`
  const std::string& folder;                    // absolute; of the file where it is written
  std::span<const std::string> being_included;  // their paths are not found again
};

/// Finds and reads files for the lexer and the parser, and says what it does not find.
class FileLookup {
 public:
  virtual ~FileLookup() = default;
  /// Returns the text that an `include` stands for, or kNoFile if there is none.
  virtual FileId include(const FileReference& file) = 0;
  /// Adds a library, or a font, to those that the file being parsed uses.
  virtual void use(const FileReference& file) = 0;
  /// Takes note that a file has been read to its end.
  virtual void leave(FileId file) = 0;
};

/// For text that names no other files, or whose files do not count.
class NoFiles final : public FileLookup {
 public:
  FileId include(const FileReference&) override { return kNoFile; }
  void use(const FileReference&) override {}
  void leave(FileId) override {}
};

}  // namespace language
