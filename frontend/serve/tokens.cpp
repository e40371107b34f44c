#include "tokens.hpp"

#include <algorithm>
#include <string>

#include "syntax/characters.hpp"
#include "syntax/token.hpp"

namespace serve {
namespace {

class Scanner {
 public:
  /// `text` ends with a NUL.
  Scanner(std::string_view text, bool strings_end_with_lines)
      : text_(text), strings_end_with_lines_(strings_end_with_lines) {}

  /// Returns false if a string is not terminated, and the others were not cut at their lines.
  bool scan(std::vector<Token>& tokens) {
    while (at_ < text_.size()) {
      if (!language::is_blank(text_[at_])) {
        const std::size_t wide = language::wide_blank_length(text_.data() + at_);
        if (wide > 0) {
          at_ += wide;
          continue;
        }
        const auto begin = static_cast<uint32_t>(at_);
        const TokenKind kind = read();
        if (is_broken_) return false;
        at_ = std::min(at_, text_.size());
        tokens.push_back({kind, {begin, static_cast<uint32_t>(at_)}});
      } else {
        ++at_;
      }
    }
    return true;
  }

 private:
  TokenKind read() {
    const char* const begin = text_.data() + at_;
    if (begin[0] == '"') return read_string();
    if (begin[0] == '/' && begin[1] == '/') return read_to("\n", 0, TokenKind::kComment);
    if (begin[0] == '/' && begin[1] == '*') return read_to("*/", 2, TokenKind::kComment);
    std::size_t word = begin[0] == '$' ? 1 : 0;
    while (language::is_word(begin[word])) ++word;
    const std::size_t number = language::number_length(begin);
    if (number > 0 && number >= word) {
      at_ += number;
      return TokenKind::kNumber;
    }
    if (word > 0) return read_word(word);
    const language::TokenKind kind = language::sign_kind(begin);
    at_ += language::is_two_bytes(kind) ? 2 : 1;
    return TokenKind::kSign;
  }

  TokenKind read_word(std::size_t length) {
    const std::string_view word = text_.substr(at_, length);
    at_ += length;
    const std::size_t path = text_.find_first_not_of(" \t\r\n", at_);
    const bool is_include = word == "include";
    if ((!is_include && word != "use") || path == text_.npos || text_[path] != '<')
      return TokenKind::kWord;
    const std::size_t end = text_.find('>', path), line_end = text_.find('\n', path);
    // One whose path has several lines is rather one that is being typed.
    at_ = end < line_end ? end + 1 : std::min(line_end, text_.size());
    return is_include ? TokenKind::kInclude : TokenKind::kUse;
  }

  TokenKind read_to(std::string_view end, std::size_t length, TokenKind kind) {
    const std::size_t found = text_.find(end, at_ + length);
    at_ = found == text_.npos ? text_.size() : found + length;
    return kind;
  }

  TokenKind read_string() {
    const std::size_t begin = at_++;
    while (at_ < text_.size() && text_[at_] != '"') {
      if (strings_end_with_lines_ && text_[at_] == '\n') return TokenKind::kString;
      at_ += text_[at_] == '\\' ? 2 : 1;
    }
    if (at_ >= text_.size() && !strings_end_with_lines_) {
      is_broken_ = true;
      at_ = begin;
    }
    ++at_;
    return TokenKind::kString;
  }

  std::string_view text_;
  bool strings_end_with_lines_;
  bool is_broken_ = false;
  std::size_t at_ = 0;
};

}  // namespace

std::vector<Token> tokens_of(std::string_view text) {
  const std::string terminated(text);
  std::vector<Token> tokens;
  if (Scanner(terminated, false).scan(tokens)) return tokens;
  tokens.clear();
  Scanner(terminated, true).scan(tokens);
  return tokens;
}

Span path_of(std::string_view text, const Token& token) {
  const auto begin = static_cast<uint32_t>(text.find('<', token.span.begin) + 1);
  const bool is_closed = text[token.span.end - 1] == '>';
  return {begin, std::max(begin, token.span.end - (is_closed ? 1 : 0))};
}

std::size_t token_behind(const std::vector<Token>& tokens, std::size_t offset) {
  const auto found = std::ranges::upper_bound(tokens, offset, {},
                                              [](const Token& token) { return token.span.end; });
  return static_cast<std::size_t>(found - tokens.begin());
}

bool is_reserved(std::string_view word) {
  const std::size_t reserved = static_cast<std::size_t>(language::TokenKind::kName);
  const auto end = language::kFirstNames.begin() + reserved;
  return std::find(language::kFirstNames.begin(), end, word) != end;
}

}  // namespace serve
