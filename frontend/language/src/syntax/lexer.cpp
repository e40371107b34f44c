#include "syntax/lexer.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>

#include "base/number_text.hpp"
#include "base/utf8.hpp"
#include "syntax/characters.hpp"

namespace language {
namespace {

constexpr size_t kLeastImprecise = 16;                   // digits of the least such integer
constexpr double kMostInteger = 18446744073709551615.0;  // what larger ones become

std::string imprecise_text(std::string_view number) {
  return "Integer \"" + std::string(number) + "\" cannot be represented precisely";
}

bool is_integer_of(double number, uint64_t integer) {
  constexpr double kEnd = 18446744073709551616.0;  // 2^64
  // OpenSCAD converts all ones, too, and finds them the same.
  return number >= kEnd || static_cast<uint64_t>(number) == integer;
}

}  // namespace

Lexer::Lexer(const Dialect& dialect, SourceFiles& files, NameTable& names, Arena& arena,
             Messages& messages, FileLookup& lookup, const Main& main)
    : dialect_(dialect),
      files_(files),
      names_(names),
      arena_(&arena),
      messages_(messages),
      lookup_(lookup),
      hard_warnings_(main.hard_warnings),
      warnings_before_(messages.warnings()),
      folder_(main.folder),
      last_path_name_(main.last_path_name) {
  enter(main.file, files_[main.file].text.data());
}

void Lexer::enter(FileId file, const char* cursor) {
  source_ = &files_[file];
  file_ = file;
  begin_ = source_->text.data();
  end_ = begin_ + source_->text.size();
  cursor_ = cursor;
  error_lines_ = {};
  ++entries_;
}

/// Goes on in the file that includes the current one. Returns false if none does.
bool Lexer::leave() {
  if (!includers_.empty()) check_is_no_preparsing();
  lookup_.leave(file_);
  if (includers_.empty()) return false;
  Includer includer = std::move(includers_.back());
  includers_.pop_back();
  being_included_.pop_back();
  folder_ = std::move(includer.folder);
  enter(includer.file, includer.cursor);
  error_lines_ = includer.error_lines;
  return true;
}

/// Reads a name, a number, `include <path>` or `use <path>`: the longest that there is.
inline bool Lexer::lex_word(Token& token) {
  const char* const begin = cursor_;
  const char* end = begin + (*begin == '$');
  while (is_word(*end)) ++end;
  const auto length = static_cast<size_t>(end - begin);
  if (begins_number(*begin)) {
    const size_t digits = number_length(begin);
    if (digits > 0 && digits >= length) return lex_number(token, digits);
    if (dialect_.has_hexadecimal_numbers && hexadecimal_length(begin) >= length) {
      lex_hexadecimal(token, length);
      return true;
    }
    if (dialect_.deprecates_digits_first) {
      remark(MessageGroup::kDeprecated,
             "Variable names starting with digits (\"" + std::string(begin, length) +
                 "\") will be removed in future releases.",
             token.place);
    }
  } else if (length == 1 && *begin == '$' && !dialect_.has_bare_dollars) {
    lex_sign(token);
    return true;
  }
  token.name = names_.intern({begin, length});
  cursor_ = end;
  token.kind = token.name < static_cast<Name>(TokenKind::kName) ? static_cast<TokenKind>(token.name)
                                                                : TokenKind::kName;
  const bool may_begin_path = token.name == kIncludeName || token.name == kUseName;
  return !may_begin_path || !begins_path() || lex_path(token);
}

/// Reads what stands at the cursor, which is no blank. Returns false if that yields no token.
inline bool Lexer::lex(Token& token) {
  const char c = *cursor_;
  if (is_sign(c)) {
    token.kind = kind_of(c);
    ++cursor_;
    return true;
  }
  if (is_word(c) || c == '$' || (c == '.' && is_digit(cursor_[1]))) return lex_word(token);
  if (c == '"') {
    lex_string(token);
  } else if (c != '\0') {
    lex_sign(token);
  } else if (cursor_ == end_ && leave()) {
    if (is_in_comment_) skip_line_comment();
    return false;
  } else {
    token.kind = TokenKind::kEnd;  // OpenSCAD reads no further than a NUL
  }
  return true;
}

/// Reads a token of any kind. Nearly half are signs of one byte, which next() reads itself.
void Lexer::next_other(Token& token) {
  bool is_token = false;
  while (!is_token) {
    const char* at = cursor_;
    blank_begin_ = at;
    while (*at == ' ') ++at;
    cursor_ = at;
    const bool is_whole = is_word(*at) || is_sign(*at) || skip_blank();
    token.place = position();
    if (!is_whole) return lex_unterminated(token, "comment");
    is_token = lex(token);
  }
}

/// Skips blanks and comments. Returns false if a comment is not terminated.
bool Lexer::skip_blank() {
  for (;;) {
    while (*cursor_ == ' ') ++cursor_;
    const char c = *cursor_;
    if (is_word(c)) return true;
    if (is_blank(c)) {
      if (c == '\r') source_->note_counted_return(offset_of(cursor_));
      ++cursor_;
    } else if (c == '/' && cursor_[1] == '/') {
      skip_line_comment();
    } else if (c == '/' && cursor_[1] == '*') {
      if (!skip_block_comment()) return false;
    } else if (is_ascii(c)) {
      return true;
    } else if (const size_t length = wide_blank_length(cursor_); length > 0) {
      cursor_ += length;
    } else {
      return true;
    }
  }
}

/// A comment that an included file ends in goes on behind the `include`.
void Lexer::skip_line_comment() {
  const void* line_feed = std::memchr(cursor_, '\n', static_cast<size_t>(end_ - cursor_));
  cursor_ = line_feed ? static_cast<const char*>(line_feed) : end_;
  is_in_comment_ = !line_feed;
}

bool Lexer::skip_block_comment() {
  for (cursor_ += 2; cursor_ < end_; ++cursor_) {
    if (*cursor_ == '*' && cursor_[1] == '/') {
      cursor_ += 2;
      return true;
    }
  }
  return false;
}

/// A number that is too large vanishes.
bool Lexer::lex_number(Token& token, size_t length) {
  const std::string_view text(cursor_, length);
  auto number = decimal_number(text);
  if (dialect_.tells_imprecise_integers && text.size() >= kLeastImprecise &&
      text.find_first_not_of("0123456789") == text.npos) {
    if (!number) number = kMostInteger;
    tell_imprecise(text, *number, token.place);
  }
  cursor_ += length;
  token.kind = TokenKind::kNumber;
  token.number = number.value_or(0);
  return number.has_value();
}

void Lexer::lex_hexadecimal(Token& token, size_t length) {
  const std::string_view text(cursor_, length);
  token.kind = TokenKind::kNumber;
  if (const auto integer = hexadecimal_integer(text)) {
    token.number = static_cast<double>(*integer);
    if (!is_integer_of(token.number, *integer))
      remark(MessageGroup::kWarning, imprecise_text(text), token.place);
  } else {
    token.number = kMostInteger;
    remark(MessageGroup::kWarning, "Hexadecimal constant \"" + std::string(text) + "\" too large",
           token.place);
  }
  cursor_ += length;
}

/// Says that a whole number of decimal digits is not the number that was read, if so.
void Lexer::tell_imprecise(std::string_view digits, double number, Place place) {
  constexpr size_t kMostDigits = 310;  // of a double
  std::array<char, kMostDigits> text;
  const char* const end =
      std::to_chars(text.data(), text.data() + text.size(), number, std::chars_format::fixed).ptr;
  const std::string_view significant =
      digits.substr(std::min(digits.find_first_not_of('0'), digits.size() - 1));
  if (significant != std::string_view(text.data(), static_cast<size_t>(end - text.data())))
    remark(MessageGroup::kWarning, imprecise_text(digits), place);
}

/// Says something about the token that is being read.
void Lexer::remark(MessageGroup group, std::string text, Place place) {
  check_is_no_preparsing();
  messages_.say(group, std::move(text), place, PathBase::kMainFile);
  last_remark_ = position();
  check_warnings();
}

void Lexer::lex_sign(Token& token) {
  token.kind = sign_kind(cursor_);
  if (token.kind == TokenKind::kEnd) return;
  cursor_ += is_two_bytes(token.kind) ? 2 : 1;
}

void Lexer::lex_string(Token& token) {
  token.kind = TokenKind::kString;
  const char* const text = ++cursor_;
  while (!ends_plain_text(*cursor_)) ++cursor_;
  if (*cursor_ == '"') {  // most strings stand in the file as they are
    token.text = {text, static_cast<size_t>(cursor_ - text)};
    ++cursor_;
    return;
  }
  string_.assign(text, cursor_);
  bool has_lines = false;
  while (*cursor_ != '"') {
    if (cursor_ == end_) return lex_unterminated(token, "string");
    if (*cursor_ == '\\') {
      const Escape escape = append_escape(cursor_, string_);
      if (!escape.is_defined && dialect_.tells_undefined_escapes)
        remark(MessageGroup::kWarning, "Undefined escape sequence", position());
      cursor_ += escape.length;
      continue;
    }
    if (*cursor_ != '\n' && *cursor_ != '\0') string_ += *cursor_;
    if (*cursor_ == '\n') has_lines = true;
    ++cursor_;
  }
  if (has_lines) token.place = position();
  ++cursor_;
  token.text = store(string_);
}

/// Returns whether `<` stands at the cursor, perhaps behind blanks.
bool Lexer::begins_path() const {
  const char* at = cursor_;
  while (is_blank(*at)) ++at;
  return *at == '<';
}

/// Skips `<`, and the blanks before it.
void Lexer::skip_to_path() {
  for (; *cursor_ != '<'; ++cursor_) {
    if (*cursor_ == '\n' && !dialect_.counts_lines_of_paths)
      source_->note_uncounted_feed(offset_of(cursor_));
  }
  ++cursor_;
}

/// Skips what separates the parts of a path of a statement. Returns false at the end of the path or
/// of the file.
bool Lexer::reach_path_part(std::string_view statement) {
  while (*cursor_ == '\t' || *cursor_ == '\r' || *cursor_ == '\n') {
    const char c = *cursor_;
    const bool is_return = c == '\r' && dialect_.counts_lines_of_paths;
    if (is_return) source_->note_counted_return(offset_of(cursor_));
    ++cursor_;
    if (c != '\n' && !is_return) continue;
    if (dialect_.counts_lines_of_paths) {
      remark(MessageGroup::kWarning,
             "new lines " + std::string(statement) +
                 "-statement is not defined - behavior may change in the future",
             position());
    } else {
      --error_lines_.first;
      source_->note_uncounted_feed(offset_of(cursor_ - 1));
    }
  }
  return *cursor_ != '>' && cursor_ < end_;
}

bool Lexer::lex_path(Token& token) {
  check_is_no_preparsing();
  if (token.name == kIncludeName) return lex_include(token);
  lex_use(token);
  return true;
}

bool Lexer::lex_include(Token& token) {
  std::string path_folder;
  last_path_name_.clear();
  skip_to_path();
  const char* const path_begin = cursor_;
  while (reach_path_part("in 'include<>'")) {
    const std::string_view part(cursor_, path_part_length(cursor_, end_));
    const size_t slash = part.rfind('/');
    if (slash != part.npos) path_folder = part.substr(0, slash + 1);
    if (slash + 1 < part.size()) last_path_name_ = part.substr(slash + 1);
    cursor_ += part.size();
  }
  if (cursor_ == end_) {
    lex_unterminated(token, "include statement");
    return true;
  }
  ++cursor_;
  const Place place = path_place(token, path_begin);
  const FileId file = lookup_.include(named_file(path_folder + last_path_name_, place));
  check_warnings();
  if (file == kNoFile) return false;
  last_path_name_.clear();
  // OpenSCAD goes on counting with the line of messages, which differs where there are CRs.
  const ErrorLines lines{files_.message_line(place), offset_of(cursor_)};
  includers_.push_back({file_, cursor_, std::move(folder_), lines});
  const std::string& path = files_[file].path;
  being_included_.push_back(path);
  folder_ = std::filesystem::path(path).parent_path().string();
  enter(file, files_[file].text.data());
  return false;
}

void Lexer::lex_use(Token& token) {
  token.kind = TokenKind::kUse;
  skip_to_path();
  const char* const path_begin = cursor_;
  while (reach_path_part("'use<>'")) {
    const size_t length = path_part_length(cursor_, end_);
    last_path_name_.assign(cursor_, length);
    cursor_ += length;
  }
  if (cursor_ == end_) return lex_unterminated(token, "use statement");
  ++cursor_;
  lookup_.use(named_file(last_path_name_, path_place(token, path_begin)));
  check_warnings();
}

std::string_view Lexer::store(std::string_view text) {
  if (text.empty() || !arena_) return {};
  auto* copy = static_cast<char*>(arena_->allocate(text.size(), 1));
  std::memcpy(copy, text.data(), text.size());
  return {copy, text.size()};
}

void Lexer::lex_unterminated(Token& token, std::string_view what) {
  token.kind = TokenKind::kUnknown;
  say_error("Unterminated " + std::string(what));
}

void Lexer::check_warnings() const {
  if (hard_warnings_ && messages_.warnings() > warnings_before_) fail("stop on first warning");
}

void Lexer::fail(const std::string& text) const {
  say_error(text);
  throw SyntaxError();
}

void Lexer::say_error(const std::string& text) const {
  const auto line_feeds = std::count(begin_ + error_lines_.offset, cursor_, '\n');
  const uint32_t line = error_lines_.first + static_cast<uint32_t>(line_feeds);
  messages_.say_parser_error("Parser error: " + text, position(), line);
}

}  // namespace language
