#include "csg/evaluated_tree.hpp"

#include <filesystem>
#include <memory>
#include <system_error>
#include <utility>

#include "base/name_table.hpp"
#include "csg/node_sink.hpp"
#include "language/call_modifier.hpp"

namespace frontend {
namespace {

constexpr NameTable kNodeTable(kNodeNames);

/// Returns the name of a file that is read beside the main one: seen from the working folder, if it
/// is within.
std::string shown_name(const std::string& path) {
  std::error_code failed;
  const std::filesystem::path from_here =
      std::filesystem::path(path).lexically_relative(std::filesystem::current_path(failed));
  if (failed || from_here.empty() || *from_here.begin() == "..") return path;
  return from_here.string();
}

uint8_t modifiers_of(uint8_t call_modifiers) {
  uint8_t modifiers = 0;
  if ((call_modifiers & language::kBackgroundModifier) != 0) modifiers |= kBackground;
  if ((call_modifiers & language::kHighlightModifier) != 0) modifiers |= kHighlight;
  return modifiers;
}

class TreeBuilder {
 public:
  TreeBuilder(const language::SourceFiles& files, SyntaxTree& tree) : files_(files), tree_(tree) {}

  /// Adds a node and all below it.
  void add(const language::Node& top) {
    open(top);
    while (!open_.empty()) {
      Open& innermost = open_.back();
      if (innermost.next < innermost.node->children.size()) {
        open(*innermost.node->children[innermost.next++]);
      } else {
        tree_.nodes[innermost.index].subtree_end = static_cast<uint32_t>(tree_.nodes.size());
        open_.pop_back();
      }
    }
  }

 private:
  struct Open {
    const language::Node* node;
    size_t next;     // child
    uint32_t index;  // in the tree
  };

  void open(const language::Node& node) {
    SyntaxNode made;
    made.kind = static_cast<NodeKind>(kNodeTable.find(node.name));
    made.modifiers = modifiers_of(node.modifiers);
    if (node.place.file < files_.size()) {
      made.location = {files_.line(node.place), files_.column(node.place), node.place.file};
    }
    made.first_argument = static_cast<uint32_t>(tree_.arguments.size());
    made.argument_count = static_cast<uint32_t>(node.arguments.size());
    made.subtree_end = kOpenSubtree;
    for (const language::NodeArgument& argument : node.arguments) {
      const Value value = whole_value(argument.value);
      tree_.arguments.push_back({argument.name, value});
    }
    open_.push_back({&node, 0, static_cast<uint32_t>(tree_.nodes.size())});
    tree_.nodes.push_back(made);
    tree_.offsets.push_back(node.place.offset);
  }

  /// Returns a value; the elements of its lists are added to the tree level by level.
  Value whole_value(const language::Value& value) {
    Value whole = value_of(value);
    while (!lists_.empty()) {
      const auto [elements, first] = lists_.back();
      lists_.pop_back();
      for (size_t i = 0; i < elements.size(); ++i) {
        const Value element = value_of(elements[i]);
        tree_.values[first + i] = element;
      }
    }
    return whole;
  }

  /// Returns a value; of a list, with room for its elements, which is put off.
  Value value_of(const language::Value& value) {
    Value made;
    switch (value.type()) {
      case language::ValueType::kBool:
        made.kind = ValueKind::kBool;
        made.boolean = value.boolean();
        break;
      case language::ValueType::kNumber:
        made.kind = ValueKind::kNumber;
        made.number = value.number();
        break;
      case language::ValueType::kString:
        made.kind = ValueKind::kString;
        made.count = static_cast<uint32_t>(value.text().size());
        made.first = tree_.strings.size();
        tree_.strings.insert(tree_.strings.end(), value.text().begin(), value.text().end());
        break;
      case language::ValueType::kVector:
        made.kind = ValueKind::kList;
        made.count = static_cast<uint32_t>(value.elements().size());
        made.first = tree_.values.size();
        tree_.values.resize(tree_.values.size() + made.count);
        lists_.emplace_back(value.elements(), made.first);
        break;
      default:
        break;
    }
    return made;
  }

  const language::SourceFiles& files_;
  SyntaxTree& tree_;
  std::vector<Open> open_;
  std::vector<std::pair<std::span<const language::Value>, size_t>> lists_;  // to be filled
};

}  // namespace

SyntaxTree tree_of(const language::Node& root, const language::SourceFiles& files,
                   std::string name) {
  SyntaxTree tree;
  tree.has_all_digits = true;
  for (language::FileId file = 0; file < files.size(); ++file) {
    tree.file_names.push_back(file == 0         ? name
                              : files.has(file) ? shown_name(files[file].path)
                                                : std::string());
  }
  tree.file_name = std::move(name);
  TreeBuilder builder(files, tree);
  if (const language::Node* const shown = language::root_modifiers(root).shown) {
    builder.add(*shown);
    tree.nodes.front().modifiers = 0;
  } else {
    for (const std::shared_ptr<language::Node>& node : root.children) builder.add(*node);
  }
  return tree;
}

}  // namespace frontend
