// A .csg as a flat row of tokens, so that subtrees are ranges of it: cheap to cut, copy and move,
// however deep they are.
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

/// Blocks are balanced.
using Design = std::vector<Token>;

/// Nothing if the text is no row of nodes with balanced brackets. Names and arguments are not
/// looked at; comments and blanks between them are left out.
std::optional<Design> parse(std::string_view text);

std::string text_of(const Design& design);

/// Past the last token of the subtree that begins with the token, which is no kClose.
std::size_t subtree_end(const Design& design, std::size_t begin);

/// Where a number stands in a head: not as a part of a name or a string.
struct NumberPlace {
  std::size_t begin, length;
};
std::vector<NumberPlace> numbers_of(const std::string& head);

}  // namespace slow_search
