#include "syntax/parameter_comments.hpp"

#include <algorithm>

#include "syntax/parameter_set.hpp"

namespace language {

ParameterComments::ParameterComments(std::string_view text) : text_(text) {
  begin_line(0);
  for (size_t at = 0; at < text_.size() && lines_.size() <= end_line_;) at = read(at);
}

size_t ParameterComments::read(size_t at) {
  const char c = text_[at];
  if (c == '\n') return begin_line(at + 1);
  if (c == '"') return read_string(at);
  if (text_.substr(at).starts_with("//")) return read_line_comment(at);
  if (text_.substr(at).starts_with("/*")) return read_block_comment(at);
  if (c == '{') end_line_ = lines_.size() - 1;
  if (c == ';' && seen_ == Seen::kPart) {
    seen_ = Seen::kStatement;
  } else if (seen_ == Seen::kStatement && c != ' ' && c != '\t' && c != '\r') {
    seen_ = Seen::kMore;
  }
  return at + 1;
}

size_t ParameterComments::begin_line(size_t at) {
  lines_.push_back({at});
  seen_ = Seen::kPart;
  return at;
}

size_t ParameterComments::read_line_comment(size_t at) {
  const size_t end = std::min(text_.find('\n', at), text_.size());
  std::string_view comment = text_.substr(at + 2, end - at - 2);
  if (comment.ends_with('\r')) comment.remove_suffix(1);
  comment = trimmed(comment);
  if (at == lines_.back().begin) lines_.back().whole_comment = comment;
  if (seen_ == Seen::kStatement) lines_.back().annotation = comment;
  return end;
}

/// Comments of several lines name no group.
size_t ParameterComments::read_block_comment(size_t at) {
  const size_t end = std::min(text_.find("*/", at + 2), text_.size());
  const std::string_view comment = text_.substr(at + 2, end - at - 2);
  const size_t line = lines_.size() - 1;
  if (comment.find('\n') == comment.npos) groups_.push_back({line, comment});
  for (size_t i = at; i < end; ++i) {
    if (text_[i] == '\n') begin_line(i + 1);
  }
  return std::min(end + 2, text_.size());
}

size_t ParameterComments::read_string(size_t at) {
  if (seen_ == Seen::kStatement) seen_ = Seen::kMore;
  for (++at; at < text_.size() && text_[at] != '"'; ++at) {
    if (text_[at] == '\\') ++at;
    if (at < text_.size() && text_[at] == '\n') begin_line(at + 1);
  }
  return std::min(at + 1, text_.size());
}

size_t ParameterComments::line_of(size_t offset) const {
  const auto next =
      std::upper_bound(lines_.begin(), lines_.end(), offset,
                       [](size_t place, const Line& line) { return place < line.begin; });
  return static_cast<size_t>(next - lines_.begin()) - 1;
}

std::string_view ParameterComments::description(size_t offset) const {
  const size_t line = line_of(offset);
  return line == 0 ? std::string_view() : lines_[line - 1].whole_comment;
}

/// A name is all that stands in brackets; a comment without brackets ends the group before it.
std::string ParameterComments::group(size_t offset) const {
  const auto next =
      std::lower_bound(groups_.begin(), groups_.end(), line_of(offset),
                       [](const Group& group, size_t line) { return group.line < line; });
  if (next == groups_.begin()) return {};
  std::string_view comment = std::prev(next)->comment;
  std::string name;
  for (;;) {
    const size_t begin = comment.find('[');
    const size_t end = comment.find(']', begin);
    if (end == comment.npos) return std::string(trimmed(name));
    if (!name.empty()) name += '-';
    name += comment.substr(begin + 1, end - begin - 1);
    comment.remove_prefix(end + 1);
  }
}

std::optional<std::string> plain_words(std::string_view text) {
  if (text.empty() || text.find_first_of("[]") != text.npos) return std::nullopt;
  std::string words;
  bool is_quoted = false, has_other = false;
  for (const std::string_view word : split(text, ' ')) {
    if (word.empty()) continue;
    has_other = has_other || !signed_number(word);
    if (!words.empty()) words += ' ';
    for (const char c : word) {
      if (c == '"') {
        is_quoted = !is_quoted;
      } else if (is_quoted || (c != '(' && c != ')')) {
        words += c;
      }
    }
  }
  if (words.find(' ') != words.npos && !has_other) return std::nullopt;
  return words;
}

std::vector<CommentEntry> comment_entries(std::string_view comment) {
  if (comment.size() < 2 || comment.front() != '[' || comment.back() != ']') return {};
  std::vector<CommentEntry> entries;
  for (const std::string_view entry : split(comment.substr(1, comment.size() - 2), ',')) {
    entries.push_back(split(entry, ':'));
    for (const std::string_view part : entries.back()) {
      if (!plain_words(part)) return {};
    }
  }
  return entries;
}

bool are_range(const std::vector<CommentEntry>& entries) {
  return entries.size() == 1 && std::all_of(entries.front().begin(), entries.front().end(),
                                            [](auto part) { return signed_number(part); });
}

}  // namespace language
