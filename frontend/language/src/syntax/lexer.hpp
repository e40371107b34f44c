// Splits the text of a file, and of the files that it includes, into tokens (LANGUAGE.md, "Text").
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/dialect.hpp"
#include "base/name_table.hpp"
#include "language/source_files.hpp"
#include "messages/messages.hpp"
#include "syntax/arena.hpp"
#include "syntax/characters.hpp"
#include "syntax/token.hpp"

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

/// Ends the parsing of a file, after the message about it.
struct SyntaxError {};

/// Ends the preparsing of a definition (parser.hpp), which has to be parsed at once.
struct NotPreparsed {};

class Lexer {
 public:
  struct Main {
    FileId file = kNoFile;
    std::string folder;          // of the file; absolute
    bool hard_warnings = false;  // whether a warning is a syntax error
    /// What `use <>` means: the name in the last path, even if that stands in a file lexed before.
    std::string last_path_name{};
  };

  /// Lexes a file. `names` must begin with kFirstNames. Texts
  /// of tokens lie in the arena.
  Lexer(const Dialect& dialect, SourceFiles& files, NameTable& names, Arena& arena,
        Messages& messages, FileLookup& lookup, const Main& main);

  /// Reads the next token. Says messages about what is not terminated, whose token is kUnknown.
  void next(Token& token) {
    const char* at = cursor_;
    while (*at == ' ') ++at;
    if (!is_sign(*at)) return next_other(token);
    blank_begin_ = cursor_;
    token.place = {file_, offset_of(at)};
    token.kind = kind_of(*at);
    cursor_ = at + 1;
  }
  Place position() const { return {file_, offset_of(cursor_)}; }  // behind the last token
  /// Returns where the blanks and comments before the last token begin.
  uint32_t blank_begin() const { return offset_of(blank_begin_); }
  /// Goes on elsewhere in the current file, up to which all has been read before.
  void go_on_at(uint32_t offset) { cursor_ = begin_ + offset; }
  const std::string& last_path_name() const { return last_path_name_; }
  /// Returns how often another file was entered: text between which it differs is not of one file.
  uint32_t entries() const { return entries_; }
  /// Returns where the last token of which something was said ends.
  Place last_remark() const { return last_remark_; }
  Arena* arena() const { return arena_; }
  /// Sets where texts of tokens lie. Null: tokens get no text, and where another file would be
  /// entered or something is to be said NotPreparsed is thrown, before anything is done.
  void set_arena(Arena* arena) { arena_ = arena; }
  /// Says a parser error about the last token, and throws SyntaxError.
  [[noreturn]] void fail(const std::string& text) const;
  /// Fails if there was a warning since the lexer was made, and warnings are errors.
  void check_warnings() const;

 private:
  /// How lines are counted in parser errors: `first`, plus the line feeds from `offset` on.
  struct ErrorLines {
    uint32_t first = 1;
    uint32_t offset = 0;
  };
  struct Includer {
    FileId file;
    const char* cursor;
    std::string folder;
    ErrorLines error_lines;
  };

  FileReference named_file(std::string_view name, Place place) const {
    return {name, place, folder_, being_included_};
  }
  /// Returns where a path is looked for, behind which the cursor stands: of several lines, on the
  /// last one where its lines are counted.
  Place path_place(const Token& token, const char* path_begin) const {
    const bool has_lines =
        std::any_of(path_begin, cursor_, [](char c) { return c == '\n' || c == '\r'; });
    return has_lines && dialect_.counts_lines_of_paths ? position() : token.place;
  }
  uint32_t offset_of(const char* at) const { return static_cast<uint32_t>(at - begin_); }
  void enter(FileId file, const char* cursor);
  bool leave();
  void check_is_no_preparsing() const {
    if (!arena_) throw NotPreparsed();
  }

  void next_other(Token& token);
  bool skip_blank();
  void skip_line_comment();
  bool skip_block_comment();
  bool lex(Token& token);
  bool lex_word(Token& token);
  bool lex_number(Token& token, size_t length);
  void lex_hexadecimal(Token& token, size_t length);
  void lex_sign(Token& token);
  void lex_string(Token& token);
  bool lex_path(Token& token);
  bool lex_include(Token& token);
  void lex_use(Token& token);
  void remark(MessageGroup group, std::string text, Place place);
  void tell_imprecise(std::string_view digits, double number, Place place);
  bool begins_path() const;
  void skip_to_path();
  bool reach_path_part(std::string_view statement);
  std::string_view store(std::string_view text);
  void say_error(const std::string& text) const;
  void lex_unterminated(Token& token, std::string_view what);

  const Dialect& dialect_;
  SourceFiles& files_;
  NameTable& names_;
  Arena* arena_;
  Messages& messages_;
  FileLookup& lookup_;
  bool hard_warnings_;
  size_t warnings_before_;

  std::vector<Includer> includers_;          // outermost first
  std::vector<std::string> being_included_;  // paths of the included files among them
  FileId file_ = kNoFile;
  std::string folder_;  // of the current file
  SourceFile* source_ = nullptr;
  const char* begin_ = nullptr;  // of its text, behind which stands a NUL
  const char* cursor_ = nullptr;
  const char* end_ = nullptr;
  const char* blank_begin_ = nullptr;
  uint32_t entries_ = 0;
  Place last_remark_{};
  bool is_in_comment_ = false;  // at the end of the file, whose last line is a comment
  ErrorLines error_lines_;      // of the current file
  std::string string_;          // the string that is being read
  std::string last_path_name_;
};

}  // namespace language
