// text().
#include <string>

#include "functions/text_parameters.hpp"
#include "modules/builtin_modules.hpp"
#include "modules/node_values.hpp"

namespace language {
namespace {

Made make_text_node(const BuiltinCall& call, NodeTree& tree, const TextRequest& text) {
  set_kind(tree, NodeKind::kText);
  add_raw(tree, "text", text.text);
  add(tree, "size", text.size);
  add(tree, "spacing", text.spacing);
  add_raw(tree, "font", text.font);
  add_raw(tree, "direction", text.direction);
  add_raw(tree, "language", text.language);
  if (!text.script.empty()) add_raw(tree, "script", text.script);
  add_raw(tree, "halign", text.halign);
  add_raw(tree, "valign", text.valign);
  add_fragments(tree, fragments_of(call));
  return Made::kNode;
}

}  // namespace

Made make_text(const BuiltinCall& call, NodeTree& tree) {
  return make_text_node(call, tree, text_request(call.parameters, "left", "baseline"));
}

Made make_text_2026(const BuiltinCall& call, NodeTree& tree) {
  check_text_types("text", call.parameters, [&](std::string text) { warn(call, std::move(text)); });
  return make_text_node(call, tree, text_request(call.parameters, "default", "default"));
}

}  // namespace language
