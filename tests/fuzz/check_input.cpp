#include "check_input.hpp"

#include <optional>

#include "frontend/error.hpp"
#include "frontend/importer.hpp"
#include "frontend/parser.hpp"

namespace fuzz {
namespace {

using language::NodeTree;

/// Returns whether every subtree ends within its parent's, and no node keeps a bit that only the
/// parser uses.
bool is_nested(const NodeTree& tree) {
  constexpr uint8_t kAllModifiers = 7;
  std::vector<uint32_t> ends = {tree.size()};
  for (uint32_t i = 0; i < tree.size(); ++i) {
    while (ends.back() == i && ends.size() > 1) ends.pop_back();
    const language::Node& node = tree.nodes[i];
    if (node.end <= i || node.end > ends.back() || node.modifiers > kAllModifiers) return false;
    ends.push_back(node.end);
  }
  return true;
}

std::string fault_of(const frontend::DesignTree& design) {
  const NodeTree& tree = *design.nodes;
  if (!is_nested(tree)) return "subtrees are not nested";
  size_t arguments = 0, numbers = 0;
  for (const language::Node& node : tree.nodes) {
    if (node.first_argument != arguments) return "arguments are not in the nodes' order";
    arguments += tree.arguments_of(node).size();
    const frontend::Location location = design.location_of(node.place);
    if (location.line == 0 || location.column == 0) return "a node has no place";
  }
  if (arguments != tree.arguments.size()) return "an argument belongs to no node";
  for (const language::NodeArgument& argument : tree.arguments) {
    if (argument.number_count == 0) continue;
    if (argument.first_number != numbers) return "numbers are not in the arguments' order";
    numbers += argument.number_count;
  }
  if (numbers != tree.numbers.size()) return "a number belongs to no argument";
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
  std::optional<frontend::DesignTree> tree;
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
