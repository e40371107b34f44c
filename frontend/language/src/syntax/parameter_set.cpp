#include "syntax/parameter_set.hpp"

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/number_text.hpp"
#include "base/read_file.hpp"
#include "language/parameter_set_file.hpp"
#include "syntax/arena_list.hpp"
#include "syntax/characters.hpp"

namespace language {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kSets = "parameterSets";

size_t line_of(std::string_view text, size_t offset) {
  const auto end = text.begin() + static_cast<long>(std::min(offset, text.size()));
  return 1 + static_cast<size_t>(std::count(text.begin(), end, '\n'));
}

/// Refuses what nests deeper than any set: it is written by recursion.
void check_depth(std::string_view text) {
  constexpr int kMostDepth = 100;
  int depth = 0;
  bool is_quoted = false;
  for (size_t at = 0; at < text.size(); ++at) {
    const char c = text[at];
    if (c == '"') is_quoted = !is_quoted;
    if (is_quoted) {
      if (c == '\\') ++at;
      continue;
    }
    if (c == '[' || c == '{') ++depth;
    if (c == ']' || c == '}') --depth;
    if (depth > kMostDepth) throw ParameterSetFile::ParseError{line_of(text, at)};
  }
}

Json parsed(std::string_view text) {
  check_depth(text);
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    throw ParameterSetFile::ParseError{line_of(text, error.byte)};
  } catch (const Json::out_of_range&) {  // a number, which does not say where it stands
    throw ParameterSetFile::ParseError{1};
  }
}

/// Returns a member of an object; null if there is none.
const Json* member(const Json* object, const std::string& name) {
  if (!object || !object->is_object()) return nullptr;
  const auto found = object->find(name);
  return found == object->end() ? nullptr : &*found;
}

/// Returns a member, made an object if it is none.
Json& object_in(Json& parent, const std::string& name) {
  Json& child = parent[name];
  if (!child.is_object()) child = Json::object();
  return child;
}

void say_unreadable(Messages& messages, const std::string& file, const std::string& reason) {
  messages.say(MessageGroup::kError, "Cannot open Parameter Set '" + file + "': " + reason);
}

}  // namespace

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
      at += append_escape(at, value).length;
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

struct ParameterSetFile::Content {
  Json json;
};

ParameterSetFile::ParameterSetFile()
    : content_(std::make_unique<Content>(
          Content{{{kSets, Json::object()}, {"fileFormatVersion", "1"}}})) {}
ParameterSetFile::ParameterSetFile(std::string_view text)
    : content_(std::make_unique<Content>(Content{parsed(text)})) {}
ParameterSetFile::~ParameterSetFile() = default;
ParameterSetFile::ParameterSetFile(ParameterSetFile&&) noexcept = default;
ParameterSetFile& ParameterSetFile::operator=(ParameterSetFile&&) noexcept = default;

std::vector<std::string> ParameterSetFile::names() const {
  std::vector<std::string> names;
  const Json* sets = member(&content_->json, kSets);
  if (!sets || !sets->is_object()) return names;
  for (const auto& [name, set] : sets->items()) names.push_back(name);
  return names;
}

std::optional<ParameterSet> ParameterSetFile::find(const std::string& name) const {
  const Json* values = member(member(&content_->json, kSets), name);
  if (!values || !values->is_object()) return std::nullopt;
  ParameterSet set;
  for (const auto& [variable, value] : values->items()) {
    if (value.is_structured()) continue;
    set.emplace(variable, value.is_string() ? value.get<std::string>() : value.dump());
  }
  return set;
}

bool ParameterSetFile::put(const std::string& name, const ParameterSet& set) {
  if (!content_->json.is_object()) return false;
  Json& values = object_in(object_in(content_->json, kSets), name);
  for (const auto& [variable, text] : set) values[variable] = text;
  return true;
}

void ParameterSetFile::erase(const std::string& name) {
  if (member(member(&content_->json, kSets), name)) content_->json[kSets].erase(name);
}

std::string ParameterSetFile::text() const {
  constexpr int kIndent = 4;
  return content_->json.dump(kIndent, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::optional<ParameterSet> read_parameter_set(const std::string& file, const std::string& set,
                                               Messages& messages) {
  if (file.empty() || set.empty()) return std::nullopt;
  const auto text = read_file(file);
  if (!text) {
    say_unreadable(messages, file, file + ": cannot open file");
    return std::nullopt;
  }
  try {
    return ParameterSetFile(*text).find(set);
  } catch (const ParameterSetFile::ParseError& error) {
    say_unreadable(messages, file, file + "(" + std::to_string(error.line) + "): expected value");
    return std::nullopt;
  }
}

void apply_parameter_set(Program& program, Messages& messages, const ParameterSet& set,
                         const DefaultType& type_of) {
  if (!program.units[0].scope) return;
  Scope scope = *program.units[0].scope;
  std::vector<Assignment> assignments(scope.assignments.begin(), scope.assignments.end());
  for (Assignment& assignment : assignments) {
    const auto text = set.find(program.names.text(assignment.name));
    if (text == set.end()) continue;
    const ValueType type = type_of(*assignment.value);
    const Expression* literal =
        parameter_literal(program.arena, assignment.place, text->second, type);
    if (literal) {
      assignment.value = literal;
    } else if (type == ValueType::kBool) {  // where OpenSCAD goes no further
      messages.say(MessageGroup::kError,
                   "Cannot apply Parameter Set 'conversion of data to type \"b\" failed'");
      break;
    }
  }
  scope.assignments = copy_to_arena<Assignment>(program.arena, assignments);
  program.units[0].scope = new (program.arena.allocate(sizeof(Scope), alignof(Scope))) Scope(scope);
}

}  // namespace language
