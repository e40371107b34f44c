#include "csg/evaluated_tree.hpp"

#include <filesystem>
#include <optional>
#include <span>
#include <system_error>
#include <utility>
#include <vector>

#include "base/name_table.hpp"
#include "language/call_modifier.hpp"

namespace frontend {
namespace {

constexpr NameTable kNodeKinds(kNodeNames);

uint8_t modifiers_of(uint8_t call_modifiers) {
  uint8_t modifiers = 0;
  if ((call_modifiers & language::kBackgroundModifier) != 0) modifiers |= kBackground;
  if ((call_modifiers & language::kHighlightModifier) != 0) modifiers |= kHighlight;
  return modifiers;
}

class TreeBuilder {
 public:
  TreeBuilder(const language::NodeTree& from, const language::SourceFiles& files, SyntaxTree& tree)
      : from_(from), files_(files), tree_(tree) {}

  /// Adds the nodes from `begin` to `end`, which are siblings and all below them.
  void add(uint32_t begin, uint32_t end) {
    reserve(begin, end);
    for (uint32_t i = begin; i < end; ++i) add_node(i, from_.nodes[i].end - begin);
  }

  void add_without_children(uint32_t node) { add_node(node, 1); }

 private:
  static constexpr uint32_t kRows = 4;  // of a matrix, and its columns

  void add_node(uint32_t index, uint32_t subtree_end) {
    const language::Node& node = from_.nodes[index];
    SyntaxNode made;
    made.kind = static_cast<NodeKind>(kNodeKinds.find(node.name));
    made.modifiers = modifiers_of(node.modifiers);
    if (files_.has(node.place.file)) {
      made.location = {files_.line(node.place), files_.column(node.place), node.place.file};
    }
    made.first_argument = static_cast<uint32_t>(tree_.arguments.size());
    made.subtree_end = subtree_end;
    for (const language::NodeArgument& argument : from_.arguments_of(index)) {
      tree_.arguments.push_back({argument.name, value_of(argument)});
    }
    made.argument_count = static_cast<uint32_t>(tree_.arguments.size()) - made.first_argument;
    tree_.nodes.push_back(made);
    tree_.offsets.push_back(node.place.offset);
  }

  /// Makes room for the nodes and the numbers, whose arrays are large: growing would copy them.
  void reserve(uint32_t begin, uint32_t end) {
    tree_.nodes.reserve(end - begin);
    tree_.offsets.reserve(end - begin);
    size_t arguments = 0, values = 0;
    for (uint32_t i = begin; i < end; ++i) {
      for (const language::NodeArgument& argument : from_.arguments_of(i)) {
        const bool is_matrix = argument.style == language::ArgumentStyle::kMatrix;
        ++arguments;
        values += argument.number_count + (is_matrix ? kRows : 0);
      }
    }
    tree_.arguments.reserve(arguments);
    tree_.values.reserve(values);
  }

  Value value_of(const language::NodeArgument& argument) {
    const std::span<const double> numbers = from_.numbers_of(argument);
    if (numbers.empty()) return whole_value(argument.value);
    if (argument.style != language::ArgumentStyle::kMatrix) return list_of(numbers);
    const Value rows = list(kRows);
    for (uint32_t row = 0; row < kRows; ++row) {
      const Value made = list_of(numbers.subspan(row * kRows, kRows));
      tree_.values[rows.first + row] = made;
    }
    return rows;
  }

  /// Returns a list with room for its elements.
  Value list(size_t count) {
    Value made;
    made.kind = ValueKind::kList;
    made.count = static_cast<uint32_t>(count);
    made.first = tree_.values.size();
    tree_.values.resize(tree_.values.size() + count);
    return made;
  }

  Value list_of(std::span<const double> numbers) {
    const Value made = list(numbers.size());
    for (size_t i = 0; i < numbers.size(); ++i) {
      Value& element = tree_.values[made.first + i];
      element.kind = ValueKind::kNumber;
      element.number = numbers[i];
    }
    return made;
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
        made = list(value.elements().size());
        lists_.emplace_back(value.elements(), made.first);
        break;
      default:
        break;
    }
    return made;
  }

  const language::NodeTree& from_;
  const language::SourceFiles& files_;
  SyntaxTree& tree_;
  std::vector<std::pair<std::span<const language::Value>, size_t>> lists_;  // to be filled
};

}  // namespace

std::string shown_name(const std::string& path) {
  std::error_code failed;
  const std::filesystem::path from_here =
      std::filesystem::path(path).lexically_relative(std::filesystem::current_path(failed));
  if (failed || from_here.empty() || *from_here.begin() == "..") return path;
  return from_here.string();
}

SyntaxTree tree_of(const language::NodeTree& from, const language::SourceFiles& files,
                   std::string name) {
  SyntaxTree tree;
  tree.has_all_digits = true;
  for (language::FileId file = 0; file < files.size(); ++file) {
    tree.file_names.push_back(file == 0         ? name
                              : files.has(file) ? shown_name(files[file].path)
                                                : std::string());
  }
  tree.file_name = std::move(name);
  TreeBuilder builder(from, files, tree);
  if (const std::optional<uint32_t> shown = language::root_modifiers(from).shown) {
    builder.add(*shown, from.nodes[*shown].end);
    tree.nodes.front().modifiers = 0;
  } else {
    builder.add(0, from.size());
  }
  return tree;
}

SyntaxTree tree_without_children(const language::NodeTree& from, uint32_t node,
                                 const language::SourceFiles& files) {
  SyntaxTree tree;
  TreeBuilder(from, files, tree).add_without_children(node);
  return tree;
}

}  // namespace frontend
