#include "check_input.hpp"

#include <optional>

#include "frontend/error.hpp"
#include "frontend/importer.hpp"
#include "frontend/parser.hpp"

namespace fuzz {
namespace {

using frontend::SyntaxTree;
using frontend::Value;
using frontend::ValueKind;

bool is_within(const SyntaxTree& tree, const Value& value) {
  const size_t size = value.kind == ValueKind::kList     ? tree.values.size()
                      : value.kind == ValueKind::kString ? tree.strings.size()
                                                         : SIZE_MAX;
  return size == SIZE_MAX || (value.first <= size && value.count <= size - value.first);
}

/// Returns whether every subtree ends within its parent's, and no node keeps a bit that only the
/// parser uses.
bool is_nested(const SyntaxTree& tree) {
  std::vector<size_t> ends = {tree.nodes.size()};
  for (size_t i = 0; i < tree.nodes.size(); ++i) {
    while (ends.back() == i && ends.size() > 1) ends.pop_back();
    const frontend::SyntaxNode& node = tree.nodes[i];
    if (node.subtree_end <= i || node.subtree_end > ends.back() || node.modifiers > 15)
      return false;
    ends.push_back(node.subtree_end);
  }
  return true;
}

std::string fault_of(const SyntaxTree& tree) {
  if (!is_nested(tree)) return "subtrees are not nested";
  size_t arguments = 0;
  for (const frontend::SyntaxNode& node : tree.nodes) {
    if (node.first_argument != arguments) return "arguments are not in the nodes' order";
    arguments += node.argument_count;
    if (node.location.line == 0 || node.location.column == 0) return "a node has no place";
  }
  if (arguments != tree.arguments.size()) return "an argument belongs to no node";
  for (const frontend::Argument& argument : tree.arguments) {
    if (!is_within(tree, argument.value)) return "an argument refers out of the tree";
    for (const char c : argument.name) {
      if (c != '$' && c != '_' && !std::isalnum(static_cast<unsigned char>(c))) {
        return "an argument's name is no identifier";
      }
    }
  }
  for (size_t i = 0; i < tree.values.size(); ++i) {
    const Value& value = tree.values[i];
    if (!is_within(tree, value)) return "a value refers out of the tree";
    // Inner lists are stored first, so that walking down a list comes to an end.
    if (value.kind == ValueKind::kList && value.first + value.count > i)
      return "a list holds itself";
  }
  return "";
}

/// The result of a text: a design, or an error.
struct Outcome {
  frontend::ImportedDesign design;
  std::string error;
};

template <typename Import>
Outcome outcome_of(Import import) {
  try {
    return {import(), ""};
  } catch (const frontend::Error& error) {
    return {{}, error.what()};
  }
}

/// Returns what is wrong, or nothing. If a start of the text is beyond repair, the text must fail,
/// at the start's place.
std::string fault_of_starts(std::string_view text) {
  const auto place_of = [](std::string_view part) {
    const std::string error = outcome_of([&] {
                                return frontend::import_design(frontend::parse(part, "fuzz.csg"));
                              }).error;
    return error.substr(0, error.find(": error: "));
  };
  constexpr size_t kParts = 4;
  for (size_t i = 1; i < kParts; ++i) {
    const std::string_view start = text.substr(0, text.size() * i / kParts);
    if (!frontend::is_beyond_repair(start)) continue;
    const std::string place = place_of(start);
    if (place.empty() || place != place_of(text)) {
      return std::to_string(start.size()) + " bytes of it are beyond repair, it is not";
    }
  }
  return "";
}

}  // namespace

std::string fault_of(std::string_view text) {
  std::optional<SyntaxTree> tree;
  // The files that the corpus imports.
  const frontend::ImportOptions options{.folder = SCADRAY_FUZZ_FILES};
  const Outcome outcome = outcome_of([&] {
    tree = frontend::parse(text, "fuzz.csg");
    return frontend::import_design(*tree, options);
  });
  if (tree) {
    const std::string fault = fault_of(*tree);
    if (!fault.empty()) return fault;
  }
  if (std::string fault = fault_of_starts(text); !fault.empty()) return fault;
  const std::string& message = outcome.error;
  if (tree && !message.empty()) return "a text without an error of its own is refused: " + message;
  for (const frontend::Warning& warning : outcome.design.warnings) {
    if (!warning.text.starts_with("fuzz.csg:"))
      return "a warning without its place: " + warning.text;
  }
  if (message.empty()) return "";
  if (!message.starts_with("fuzz.csg:")) return "an error without its place: " + message;
  if (message.find(": error: ") == std::string::npos) return "an error of another form";
  return "";
}

}  // namespace fuzz
