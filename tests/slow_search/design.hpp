// A .csg as a flat row of tokens. Subtrees are ranges of it, so that they are cheap to cut, copy
// and move, however deep they are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace slow_search {

enum class Kind : uint8_t {
  kLeaf,   // "cube(size = 1);": a node without a block
  kOpen,   // "union() {": a node up to its block
  kClose,  // "}"
};

struct Token {
  Kind kind;
  std::string head;  // modifiers, name and arguments; empty: kClose
};

/// A design; its blocks are balanced.
using Design = std::vector<Token>;

/// Returns nothing if the text is not a row of nodes with balanced brackets. Names and arguments
/// are not examined; comments and blanks between them are dropped.
std::optional<Design> parse(std::string_view text);

std::string text_of(const Design& design);

/// Returns the index after the last token of the subtree that begins with the token, which must not
/// be kClose.
std::size_t subtree_end(const Design& design, std::size_t begin);

/// The place of a number in a head, not within a name or a string.
struct NumberPlace {
  std::size_t begin, length;
};
std::vector<NumberPlace> numbers_of(const std::string& head);

}  // namespace slow_search
