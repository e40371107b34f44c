#include "design.hpp"

#include <algorithm>
#include <cctype>
#include <utility>

namespace slow_search {
namespace {

bool is_blank(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }
bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }
bool is_of_name(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '$';
}

/// Returns the position after the string that begins there.
std::size_t string_end(std::string_view text, std::size_t at) {
  for (++at; at < text.size() && text[at] != '"'; ++at) {
    if (text[at] == '\\') ++at;
  }
  return std::min(at + 1, text.size());
}

/// Returns the position after blanks and comments, and after a byte order mark.
std::size_t next_word(std::string_view text, std::size_t at) {
  for (;;) {
    while (at < text.size() && is_blank(text[at])) ++at;
    const std::string_view rest = text.substr(at);
    if (rest.starts_with("\xEF\xBB\xBF")) {
      at += 3;
    } else if (rest.starts_with("//")) {
      at = std::min(text.find('\n', at), text.size());
    } else if (rest.starts_with("/*")) {
      const std::size_t end = text.find("*/", at + 2);
      at = end == std::string_view::npos ? text.size() : end + 2;
    } else {
      return at;
    }
  }
}

/// Takes modifiers, a name and its arguments in brackets, without blanks outside strings, and moves
/// `at` on; empty if there are none.
std::string take_head(std::string_view text, std::size_t& at) {
  std::string head;
  while (at < text.size() && std::string_view("#%*!").find(text[at]) != std::string_view::npos) {
    head += text[at];
    at = next_word(text, at + 1);
  }
  const std::size_t name_length = head.size();
  while (at < text.size() && is_of_name(text[at])) head += text[at++];
  at = next_word(text, at);
  if (head.size() == name_length || at >= text.size() || text[at] != '(') return {};
  int depth = 0;
  while (at < text.size()) {
    const char c = text[at];
    if (c == '"') {
      const std::size_t end = string_end(text, at);
      head += text.substr(at, end - at);
      at = next_word(text, end);
      continue;
    }
    if (c == '(' || c == '[') ++depth;
    if (c == ')' || c == ']') --depth;
    head += c;
    at = next_word(text, at + 1);
    if (depth == 0) return head;
  }
  return {};
}

}  // namespace

std::optional<Design> parse(std::string_view text) {
  Design design;
  std::vector<bool> is_single;  // by open node: it has one child and no braces
  const auto end_subtree = [&] {
    while (!is_single.empty() && is_single.back()) {
      design.push_back({Kind::kClose, {}});
      is_single.pop_back();
    }
  };
  for (std::size_t at = next_word(text, 0); at < text.size(); at = next_word(text, at)) {
    if (text[at] == '}') {
      if (is_single.empty() || is_single.back()) return std::nullopt;
      is_single.pop_back();
      design.push_back({Kind::kClose, {}});
      end_subtree();
      ++at;
      continue;
    }
    if (text[at] == ';') {  // an empty statement
      ++at;
      continue;
    }
    std::string head = take_head(text, at);
    if (head.empty() || at >= text.size()) return std::nullopt;
    if (text[at] == ';') {
      design.push_back({Kind::kLeaf, std::move(head)});
      end_subtree();
      ++at;
    } else {
      is_single.push_back(text[at] != '{');
      design.push_back({Kind::kOpen, std::move(head)});
      if (text[at] == '{') ++at;
    }
  }
  if (!is_single.empty()) return std::nullopt;
  return design;
}

std::string text_of(const Design& design) {
  std::string text;
  for (const Token& token : design) {
    switch (token.kind) {
      case Kind::kLeaf:
        text += token.head + ";\n";
        break;
      case Kind::kOpen:
        text += token.head + "{\n";
        break;
      case Kind::kClose:
        text += "}\n";
        break;
    }
  }
  return text;
}

std::size_t subtree_end(const Design& design, std::size_t begin) {
  std::size_t depth = 0;
  for (std::size_t at = begin; at < design.size(); ++at) {
    if (design[at].kind == Kind::kOpen) ++depth;
    if (design[at].kind == Kind::kClose) --depth;
    if (depth == 0) return at + 1;
  }
  return design.size();
}

std::vector<NumberPlace> numbers_of(const std::string& head) {
  std::vector<NumberPlace> places;
  for (std::size_t at = 0; at < head.size();) {
    if (head[at] == '"') {
      at = string_end(head, at);
    } else if (is_digit(head[at]) || (head[at] == '-' && is_digit(head[at + 1]))) {
      const std::size_t begin = at++;
      while (at < head.size() && (is_digit(head[at]) || head[at] == '.')) ++at;
      if (at < head.size() && (head[at] == 'e' || head[at] == 'E')) {
        ++at;
        if (at < head.size() && (head[at] == '-' || head[at] == '+')) ++at;
        while (at < head.size() && is_digit(head[at])) ++at;
      }
      places.push_back({begin, at - begin});
    } else if (is_of_name(head[at])) {
      while (at < head.size() && is_of_name(head[at])) ++at;
    } else {
      ++at;
    }
  }
  return places;
}

}  // namespace slow_search
