// The comments by which a design describes its parameters (customizer.hpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace language {

class ParameterComments {
 public:
  /// Reads a text, which must outlive this object.
  explicit ParameterComments(std::string_view text);

  // Of the assignment whose name stands at an offset:

  /// Returns whether its line comes before the first `{`.
  bool may_be_parameter(size_t offset) const { return line_of(offset) < end_line_; }
  /// Returns the comment in the line above it; empty: none.
  std::string_view description(size_t offset) const;
  /// Returns the name of its group; empty: none.
  std::string group(size_t offset) const;
  /// Returns the comment behind it, if it is the only statement in its line; empty: none.
  std::string_view annotation(size_t offset) const { return lines_[line_of(offset)].annotation; }

 private:
  /// What the current line holds so far, besides comments.
  enum class Seen : uint8_t { kPart, kStatement, kMore };
  struct Line {
    size_t begin;
    std::string_view whole_comment{};  // if the line begins with it
    std::string_view annotation{};
  };
  struct Group {
    size_t line;
    std::string_view comment;  // between its delimiters
  };

  size_t line_of(size_t offset) const;
  // These read what begins at an offset, and return where it ends.
  size_t read(size_t at);
  size_t read_line_comment(size_t at);
  size_t read_block_comment(size_t at);
  size_t read_string(size_t at);
  size_t begin_line(size_t at);

  std::string_view text_;
  std::vector<Line> lines_;
  std::vector<Group> groups_;                             // in order of their lines
  size_t end_line_ = std::numeric_limits<size_t>::max();  // of the first `{`
  Seen seen_ = Seen::kPart;
};

/// `[value]`, `[value:label]`, or `[min:step:max]`.
using CommentEntry = std::vector<std::string_view>;

/// Returns words with one blank between them, without quotes and parentheses; nothing if there is
/// none, or if they are several numbers.
std::optional<std::string> plain_words(std::string_view text);

/// Returns the entries of a list in brackets, whose parts are all plain words; none if the comment
/// is no such list.
std::vector<CommentEntry> comment_entries(std::string_view comment);

/// Returns whether they are one entry of numbers alone.
bool are_range(const std::vector<CommentEntry>& entries);

}  // namespace language
