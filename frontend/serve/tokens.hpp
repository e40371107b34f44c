// The tokens of a text that may be broken, comments among them.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "text.hpp"

namespace serve {

enum class TokenKind : uint8_t {
  kWord,  // a name or a reserved word
  kNumber,
  kString,   // with its quotes
  kInclude,  // include <path>
  kUse,      // use <path>
  kSign,     // an operator or a bracket
  kComment,
};

struct Token {
  TokenKind kind;
  Span span;
};

/// Cuts a text into tokens, by the rules of frontend/language's lexer. It never fails: a string
/// that is not terminated ends with its line, and so do then all others; a comment that is not
/// terminated ends with the text.
std::vector<Token> tokens_of(std::string_view text);

/// Returns the path within `include <path>` or `use <path>`.
Span path_of(std::string_view text, const Token& token);

/// Returns the index of the first token that ends behind an offset.
std::size_t token_behind(const std::vector<Token>& tokens, std::size_t offset);

/// Returns whether a word is reserved.
bool is_reserved(std::string_view word);

}  // namespace serve
