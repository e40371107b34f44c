// text().
#include <iterator>
#include <string>

#include "modules/builtin_modules.hpp"
#include "modules/node_values.hpp"
#include "modules/scripts.hpp"

namespace language {
namespace {

/// Returns the direction that a name's first letter means; empty for none.
std::string_view direction_named(std::string_view name) {
  switch (name.empty() ? '\0' : name.front() | 0x20) {
    case 'l':
      return "ltr";
    case 'r':
      return "rtl";
    case 't':
      return "ttb";
    case 'b':
      return "btt";
    default:
      return {};
  }
}

}  // namespace

namespace {

Made make(const BuiltinCall& call, NodeTree& tree, std::string_view halign,
          std::string_view valign) {
  enum : size_t { kText, kSize, kFont, kDirection, kLanguage, kScript, kHalign, kValign, kSpacing };
  const auto& given = call.parameters;
  const std::string_view text = text_or(given[kText], "");
  const std::string_view script_name = text_or(given[kScript], "");
  const std::string code =
      script_name.empty() ? std::string(script_of(text)) : script_code(script_name);
  const std::string_view script = code.empty() ? script_name : code;
  std::string_view direction = direction_named(text_or(given[kDirection], ""));
  if (direction.empty()) direction = direction_of_script(code);
  set_kind(tree, NodeKind::kText);
  add_raw(tree, "text", text);
  add(tree, "size", number_or(given[kSize], 10));
  add(tree, "spacing", number_or(given[kSpacing], 1));
  add_raw(tree, "font", text_or(given[kFont], ""));
  add_raw(tree, "direction", direction);
  add_raw(tree, "language", text_or(given[kLanguage], "en"));
  if (!script.empty()) add_raw(tree, "script", script);
  add_raw(tree, "halign", text_or(given[kHalign], halign));
  add_raw(tree, "valign", text_or(given[kValign], valign));
  add_fragments(tree, fragments_of(call));
  return Made::kNode;
}

}  // namespace

Made make_text(const BuiltinCall& call, NodeTree& tree) {
  return make(call, tree, "left", "baseline");
}

Made make_text_2026(const BuiltinCall& call, NodeTree& tree) {
  constexpr std::string_view kNames[] = {"text",   "size",   "font",   "direction", "language",
                                         "script", "halign", "valign", "spacing"};
  for (size_t i = 0; i < std::size(kNames); ++i) {
    const Value& value = call.parameters[i];
    const bool is_number = kNames[i] == "size" || kNames[i] == "spacing";
    const bool is_right = is_number ? value.is_number() : value.is_string();
    if (is_given(value) && !is_right)
      warn(call, wrong_type("text", kNames[i], is_number ? "number" : "string", value));
  }
  return make(call, tree, "default", "default");
}

}  // namespace language
