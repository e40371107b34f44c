#include "protocol.hpp"

#include <charconv>
#include <limits>
#include <utility>

#include "language/text_overlay.hpp"

namespace serve {
namespace {

constexpr std::string_view kScheme = "file://";

bool is_plain(char c) {
  const bool is_letter = ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z');
  return is_letter || ('0' <= c && c <= '9') ||
         std::string_view("-._~/").find(c) != std::string_view::npos;
}

}  // namespace

RequestError invalid(const std::string& what) { return {ErrorCode::kInvalidParams, what}; }

std::string path_of_uri(std::string_view uri) {
  if (!uri.starts_with(kScheme)) return "-";
  uri.remove_prefix(kScheme.size());
  uri.remove_prefix(std::min(uri.find('/'), uri.size()));  // the host
  std::string path;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    unsigned byte = 0;
    const char* const digits = uri.data() + i + 1;
    if (uri[i] == '%' && i + 2 < uri.size() &&
        std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2) {
      path += static_cast<char>(byte);
      i += 2;
    } else {
      path += uri[i];
    }
  }
  const bool is_path = path.size() > 1 && path.find('\0') == path.npos;
  return is_path ? path : "-";
}

std::string uri_of_path(std::string_view path) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  std::string uri(kScheme);
  for (const char c : path) {
    const auto byte = static_cast<unsigned char>(c);
    if (is_plain(c))
      uri += c;
    else
      uri += {'%', kDigits[byte / 16], kDigits[byte % 16]};
  }
  return uri;
}

std::string key_of_uri(const std::string& uri) {
  const std::string path = path_of_uri(uri);
  return path == "-" ? uri : language::TextOverlay::key_of(path);
}

Json json_of(Range range) {
  const auto position = [](Position at) {
    return Json{{"line", at.line}, {"character", at.character}};
  };
  return {{"start", position(range.start)}, {"end", position(range.end)}};
}

const Json& member_of(const Json& json, const char* name) {
  const auto found = json.is_object() ? json.find(name) : json.end();
  if (!json.is_object() || found == json.end())
    throw invalid("\"" + std::string(name) + "\" is missing");
  return *found;
}

const Json& find_member(const Json& json, std::initializer_list<const char*> path) {
  static const Json kNothing;
  const Json* at = &json;
  for (const char* name : path) {
    if (!at->is_object() || !at->contains(name)) return kNothing;
    at = &(*at)[name];
  }
  return *at;
}

std::string text_of(const Json& json, const char* name) {
  const Json& text = member_of(json, name);
  if (!text.is_string()) throw invalid("\"" + std::string(name) + "\" is no string");
  return text.get<std::string>();
}

uint32_t number_of(const Json& json) {
  if (!json.is_number_integer() || json < 0) throw invalid("a number is not whole, or negative");
  constexpr uint32_t kMost = std::numeric_limits<int32_t>::max();
  return json > kMost ? kMost : json.get<uint32_t>();
}

Position position_of(const Json& json) {
  return {number_of(member_of(json, "line")), number_of(member_of(json, "character"))};
}

Range range_of(const Json& json) {
  return {position_of(member_of(json, "start")), position_of(member_of(json, "end"))};
}

TextPointer changed_text(TextPointer text, const Json& changes, PositionEncoding encoding) {
  if (!changes.is_array()) throw invalid("\"contentChanges\" is no array");
  for (const Json& change : changes) {
    std::string added = text_of(change, "text");
    if (change.contains("range")) {
      const Range range = range_of(change["range"]);
      const uint32_t begin = text->offset_of(range.start, encoding);
      const uint32_t end = text->offset_of(range.end, encoding);
      if (end < begin) throw invalid("a range ends before it begins");
      std::string bytes = text->bytes();
      bytes.replace(begin, end - begin, added);
      added = std::move(bytes);
    }
    text = std::make_shared<const Text>(std::move(added));
  }
  return text;
}

int completion_kind(ItemKind kind) {
  switch (kind) {
    case ItemKind::kModule:
      return 9;
    case ItemKind::kFunction:
      return 3;
    case ItemKind::kVariable:
      return 6;
    case ItemKind::kParameter:
      return 5;
    case ItemKind::kWord:
      return 14;
    case ItemKind::kFile:
      return 17;
    case ItemKind::kFolder:
      return 19;
  }
  return 1;
}

int symbol_kind(ItemKind kind) {
  constexpr int kModule = 2, kFunction = 12, kVariable = 13;
  return kind == ItemKind::kModule ? kModule : kind == ItemKind::kFunction ? kFunction : kVariable;
}

Json markup(const std::string& code, const std::string& about) {
  std::string text;
  if (!code.empty()) text = "```scad\n" + code + "\n```\n";
  if (!about.empty()) text += (text.empty() ? "" : "\n") + about;
  return {{"kind", "markdown"}, {"value", text}};
}

Json json_of(const Symbol& symbol, const Text& text, PositionEncoding encoding) {
  Json json = {{"name", symbol.name},
               {"kind", symbol_kind(symbol.kind)},
               {"range", json_of(text.range_of(symbol.span, encoding))},
               {"selectionRange", json_of(text.range_of(symbol.name_span, encoding))}};
  if (!symbol.detail.empty()) json["detail"] = symbol.detail;
  if (!symbol.children.empty()) {
    json["children"] = Json::array();
    for (const Symbol& child : symbol.children)
      json["children"].push_back(json_of(child, text, encoding));
  }
  return json;
}

Json json_of(const Said& said, PositionEncoding encoding) {
  using language::MessageGroup;
  constexpr int kError = 1, kWarning = 2, kDeprecatedTag = 2;
  const bool is_error = said.group == MessageGroup::kError;
  Json json = {{"range", json_of(said.text ? said.text->range_of(said.span, encoding) : Range{})},
               {"severity", is_error ? kError : kWarning},
               {"source", "scadray"},
               {"message", said.what}};
  if (said.group == MessageGroup::kDeprecated) json["tags"] = {kDeprecatedTag};
  return json;
}

}  // namespace serve
