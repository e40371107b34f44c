// The files that designs include and use, with what parsing them has made, kept between evaluations
// as long as they do not change.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/name_table.hpp"
#include "language/file_signature.hpp"
#include "language/source_files.hpp"
#include "language/text_overlay.hpp"
#include "syntax/arena.hpp"
#include "syntax/arena_list.hpp"
#include "syntax/syntax.hpp"

namespace language {

/// What a statement at a file's top level adds to the scope.
using TopLevelItem = std::variant<Assignment, FunctionDefinition, ModuleDefinition, ModuleCall>;

/// A statement that stands whole in its file. Its meaning depends on its bytes alone, and parsing
/// it has said nothing, so it need not be parsed again.
struct KeptStatement {
  uint32_t blank;  // where the blanks and comments before it begin
  uint32_t begin;  // of its first token
  uint32_t end;    // where the lexer goes on
  std::span<const TopLevelItem> items{};
};

/// A file that is included or used, with what parsing it has made.
class KeptFile {
 public:
  KeptFile(FileId number, std::string path, std::string text)
      : number_(number), source_(std::make_shared<SourceFile>(std::move(path), std::move(text))) {}

  FileId number() const { return number_; }
  const std::shared_ptr<SourceFile>& source() const { return source_; }
  /// Where the nodes of statements lie that are to be kept.
  Arena& arena() { return arena_; }

  /// Whether the file has been read to its end. Statements are added until the evaluation ends in
  /// which that happens.
  bool is_read = false;
  bool is_complete = false;

  /// Adds a statement, unless it stands before one that was added.
  void add(KeptStatement statement, std::span<const TopLevelItem> items) {
    if (!statements_.empty() && statements_.back().begin >= statement.begin) return;
    statement.items = copy_to_arena(arena_, items);
    statements_.push_back(statement);
  }
  /// Returns the statement that begins at an offset, or behind the blanks there; null: none is
  /// kept.
  const KeptStatement* find(uint32_t offset);

 private:
  const FileId number_;
  const std::shared_ptr<SourceFile> source_;
  Arena arena_;
  std::vector<KeptStatement> statements_;  // in the order of the text
  size_t next_ = 0;                        // the statement behind the one that was found last
};

class KeptSources {
 public:
  enum class Role : uint8_t { kIncluded, kUsed };  // a file in two roles counts as two files

  KeptSources();

  /// Identifiers of all that is kept; it begins with kFirstNames.
  NameTable names;

  /// To be called before the first file of an evaluation is opened. Forgets all files if the main
  /// file is another one, or is parsed with other definitions, as they bear on how others are read.
  /// `overlay` may be null.
  void begin(const std::string& main_path, const std::vector<std::string>& definitions,
             const TextOverlay* overlay = nullptr);
  /// Returns a file as it is now; null if it cannot be read, or is not regular. `text_of` makes the
  /// text of its bytes.
  std::shared_ptr<KeptFile> open(Role role, const std::string& path,
                                 const std::function<std::string(std::string bytes)>& text_of);
  /// To be called when all is parsed. Forgets the files that were not opened.
  void end();
  /// Returns how many names and paths are known, which only grows.
  size_t size() const { return names.size() + numbers_.size(); }

 private:
  struct Entry {
    std::shared_ptr<KeptFile> file;  // null: none is kept
    FileSignature signature;
    bool is_open = false;
  };

  const TextOverlay* overlay_ = nullptr;  // of this evaluation
  std::string main_path_;
  std::vector<std::string> definitions_;
  std::map<std::pair<Role, std::string>, FileId> numbers_;
  std::vector<Entry> files_;  // by number; the first one, the main file, is never kept
};

}  // namespace language
