// The limit of a design's nesting.
#pragma once

#include "syntax/parser.hpp"

namespace language {

/// Counts the symbols that OpenSCAD's parser would stack, and fails where it runs out of memory.
class Parser::Nested {
 public:
  Nested(Parser& parser, uint32_t symbols) : parser_(parser), symbols_(symbols) {
    constexpr uint32_t kMostSymbols = 19'994;
    parser_.depth_ += symbols_;
    if (parser_.depth_ > kMostSymbols) parser_.fail("memory exhausted");
  }
  Nested(const Nested&) = delete;
  Nested& operator=(const Nested&) = delete;
  ~Nested() { parser_.depth_ -= symbols_; }

 private:
  Parser& parser_;
  uint32_t symbols_;
};

}  // namespace language
