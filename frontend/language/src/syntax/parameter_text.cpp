#include "syntax/parameter_text.hpp"

#include <cstring>
#include <string>

#include "base/decimal_number.hpp"
#include "syntax/arena_list.hpp"
#include "syntax/characters.hpp"
#include "syntax/string_escape.hpp"

namespace language {

std::string_view trimmed(std::string_view text) {
  while (text.starts_with(' ') || text.starts_with('\t')) text.remove_prefix(1);
  while (text.ends_with(' ') || text.ends_with('\t')) text.remove_suffix(1);
  return text;
}

std::optional<double> signed_number(std::string_view text) {
  const bool is_negative = text.starts_with('-');
  if (is_negative || text.starts_with('+')) text.remove_prefix(1);
  const std::string terminated(text);
  if (text.empty() || number_length(terminated.c_str()) != text.size()) return std::nullopt;
  const auto number = decimal_number(text);
  return number && is_negative ? -*number : number;
}

std::vector<std::string_view> split(std::string_view text, char sign) {
  std::vector<std::string_view> parts;
  bool is_quoted = false;
  size_t begin = 0;
  for (size_t i = 0; i < text.size(); ++i) {
    if (is_quoted && text[i] == '\\') {
      ++i;
    } else if (text[i] == '"') {
      is_quoted = !is_quoted;
    } else if (text[i] == sign && !is_quoted) {
      parts.push_back(trimmed(text.substr(begin, i - begin)));
      begin = i + 1;
    }
  }
  parts.push_back(trimmed(text.substr(begin)));
  return parts;
}

namespace {

/// Removes a text's first and last bytes if they are the given ones.
bool strip(std::string_view& text, char first, char last) {
  if (text.size() < 2 || text.front() != first || text.back() != last) return false;
  text = trimmed(text.substr(1, text.size() - 2));
  return true;
}

class LiteralMaker {
 public:
  LiteralMaker(Arena& arena, Place place) : arena_(arena), place_(place) {}

  template <typename Node, typename... Fields>
  const Expression* make(ExpressionKind kind, Fields... fields) {
    return new (arena_.allocate(sizeof(Node), alignof(Node))) Node{{kind, place_}, fields...};
  }
  const Expression* make_string(std::string_view text) {
    const auto copy = copy_to_arena<char>(arena_, text);
    return make<StringExpression>(ExpressionKind::kString,
                                  std::string_view(copy.data(), copy.size()));
  }
  const Expression* make_number(std::string_view text) {
    while (strip(text, '(', ')')) continue;
    const auto number = signed_number(text);
    return number ? make<NumberExpression>(ExpressionKind::kNumber, *number) : nullptr;
  }
  const Expression* make_bool(std::string_view text) {
    const bool is_true = text == "true" || text == "1";
    if (!is_true && text != "false" && text != "0") return nullptr;
    return make<BoolExpression>(ExpressionKind::kBool, is_true);
  }
  const Expression* make_vector(std::string_view text);
  const Expression* make_range(std::string_view text);

 private:
  const Expression* make_element(std::string_view text);

  Arena& arena_;
  Place place_;
};

/// An element is a number, a text in quotes, or a text without.
const Expression* LiteralMaker::make_element(std::string_view text) {
  if (text.empty() || text.find_first_of("[]:") != text.npos) return nullptr;
  if (const Expression* number = make_number(text)) return number;
  if (!strip(text, '"', '"')) return make_string(text);
  std::string value;
  const std::string terminated(text);
  for (const char* at = terminated.c_str(); *at != '\0';) {
    if (*at == '\\' && std::strchr("xuU", at[1])) {
      ++at;  // these escapes are unknown here
    } else if (*at == '\\') {
      at += append_escape(at, value);
    } else {
      value += *at++;
    }
  }
  return make_string(value);
}

const Expression* LiteralMaker::make_vector(std::string_view text) {
  while (strip(text, '(', ')')) continue;
  if (!strip(text, '[', ']')) return nullptr;
  std::vector<const Expression*> elements;
  for (const std::string_view part : split(text, ',')) {
    elements.push_back(make_element(part));
    if (!elements.back()) return nullptr;
  }
  return make<VectorExpression>(ExpressionKind::kVector,
                                copy_to_arena<const Expression*>(arena_, elements));
}

const Expression* LiteralMaker::make_range(std::string_view text) {
  while (strip(text, '(', ')')) continue;
  if (!strip(text, '[', ']')) return nullptr;
  std::vector<const Expression*> parts;
  for (const std::string_view part : split(text, ':')) {
    parts.push_back(make_number(part));
    if (!parts.back()) return nullptr;
  }
  if (parts.size() < 2 || parts.size() > 3) return nullptr;
  const Expression* step = parts.size() == 3 ? parts[1] : nullptr;
  return make<RangeExpression>(ExpressionKind::kRange, parts.front(), step, parts.back());
}

}  // namespace

const Expression* parameter_literal(Arena& arena, Place place, std::string_view text,
                                    ValueType type) {
  LiteralMaker maker(arena, place);
  switch (type) {
    case ValueType::kBool:
      return maker.make_bool(trimmed(text));
    case ValueType::kNumber:
      return maker.make_number(trimmed(text));
    case ValueType::kString:
      return maker.make_string(text);
    case ValueType::kVector:
      return maker.make_vector(trimmed(text));
    case ValueType::kRange:
      return maker.make_range(trimmed(text));
    default:
      return nullptr;
  }
}

}  // namespace language
