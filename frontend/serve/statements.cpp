#include "statements.hpp"

#include <algorithm>

#include "tokens.hpp"

namespace serve {

Statements::Statements(std::string_view text) {
  std::vector<Token> tokens = tokens_of(text);
  std::erase_if(tokens, [](const Token& token) { return token.kind == TokenKind::kComment; });
  const auto is = [&](std::size_t token, std::string_view word) {
    if (token >= tokens.size()) return false;
    const Span span = tokens[token].span;
    return text.substr(span.begin, span.end - span.begin) == word;
  };
  std::vector<std::size_t> open;    // the statements that have not ended, innermost last
  std::vector<std::size_t> blocks;  // how many of them are around what each `{` holds
  const auto end_beyond = [&](std::size_t count, uint32_t offset) {
    for (; open.size() > count; open.pop_back()) spans_[open.back()].end = offset;
  };
  std::size_t brackets = 0;
  bool begins = true;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    const Token& token = tokens[i];
    if (token.kind == TokenKind::kInclude || token.kind == TokenKind::kUse) continue;
    if (is(i, "}")) {
      if (blocks.empty()) continue;  // one too many
      end_beyond(blocks.back(), token.span.begin);
      blocks.pop_back();
    } else if (begins) {
      open.push_back(spans_.size());
      spans_.push_back(token.span);
    }
    begins = false;
    if (is(i, "(") || is(i, "[")) ++brackets;
    if ((is(i, ")") || is(i, "]")) && brackets > 0) --brackets;
    if (is(i, "{")) blocks.push_back(open.size());
    const bool ends = is(i, "}") || (is(i, ";") && brackets == 0);
    if (ends && !is(i + 1, "else")) end_beyond(open.size() - 1, token.span.end);
    if (ends || is(i, "{")) brackets = 0;
    begins = is(i, "{") || (ends && !is(i + 1, "else"));
  }
  end_beyond(0, static_cast<uint32_t>(text.size()));
}

std::optional<Span> Statements::around(std::size_t offset) const {
  const auto found = std::find_if(spans_.rbegin(), spans_.rend(),
                                  [&](const Span& span) { return span.touches(offset); });
  return found == spans_.rend() ? std::nullopt : std::optional(*found);
}

Span Statements::from(uint32_t offset) const {
  const auto found = std::find_if(spans_.rbegin(), spans_.rend(), [&](const Span& span) {
    return span.begin <= offset && offset < span.end;
  });
  return {offset, found == spans_.rend() ? offset : found->end};
}

}  // namespace serve
