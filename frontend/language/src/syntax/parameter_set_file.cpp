#include "language/parameter_set_file.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

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

}  // namespace

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

}  // namespace language
