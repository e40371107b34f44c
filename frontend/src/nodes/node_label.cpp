#include "nodes/node_label.hpp"

#include <algorithm>
#include <cstdio>
#include <span>
#include <string_view>

#include "subtrees/node_row.hpp"

namespace frontend {
namespace {

/// Longer texts and lists are cut.
constexpr std::size_t kMostCharacters = 24, kMostElements = 4;

class Writer {
 public:
  Writer(const NodeTree& tree, const Node& node)
      : tree_(tree), node_(node), row_(row_of(node.kind)) {}

  std::string label() {
    text_ = name_of(node_.kind);
    text_ += '(';
    if (row_.counted.is_positional()) {
      add_arguments();
    } else {
      add_count();
    }
    return std::move(text_ += ')');
  }

 private:
  ArgumentValue find(language::ArgumentName name) {
    NodeProblems untold;
    return NodeReader(tree_, node_, untold).find(name);
  }

  void add_count() {
    const ArgumentValue list = find(row_.counted);
    if (!list.is_list()) return;
    text_ += std::to_string(list.elements().size()) += ' ';
    text_ += row_.counted.text();
  }

  void add_arguments() {
    for (const language::NodeArgument& argument : tree_.arguments_of(node_)) {
      if (argument.name.is_positional()) add({}, {tree_, argument});
    }
    const bool is_straight = node_.kind == NodeKind::kCylinder && are_equal(find("r1"), find("r2"));
    for (const language::ArgumentName name : row_.label) {
      const ArgumentValue value = find(name);
      if (is_usual(name, value)) continue;
      if (is_straight && name == "r2") continue;
      add(is_straight && name == "r1" ? "r" : name.text(), value);
    }
  }

  static bool are_equal(const ArgumentValue& a, const ArgumentValue& b) {
    return a.is_number() && b.is_number() && a.number() == b.number();
  }

  /// Returns whether a value says nothing: OpenSCAD writes it where the design does not.
  bool is_usual(language::ArgumentName name, const ArgumentValue& value) const {
    if (value.is_undef()) return true;
    const double usual = name == "twist" ? 0 : name == "scale" ? 1 : name == "angle" ? 360 : -1;
    if (name == "cut") return value.kind() == ValueKind::kBool && !value.boolean();
    if (usual < 0) return false;
    if (value.is_number()) return value.number() == usual;
    if (!value.is_list()) return false;
    for (const ArgumentValue element : value.elements()) {
      if (!element.is_number() || element.number() != usual) return false;
    }
    return true;
  }

  void add(std::string_view name, const ArgumentValue& value) {
    if (text_.back() != '(') text_ += ", ";
    if (!name.empty()) (text_ += name) += " = ";
    add_value(value);
  }

  /// Lists within lists are not written.
  void add_value(const ArgumentValue& value, bool is_element = false) {
    switch (value.kind()) {
      case ValueKind::kUndef:
        text_ += "undef";
        break;
      case ValueKind::kBool:
        text_ += value.boolean() ? "true" : "false";
        break;
      case ValueKind::kNumber:
        add_number(value.number());
        break;
      case ValueKind::kString:
        add_string(value.text());
        break;
      case ValueKind::kList:
        if (is_element) {
          text_ += "[…]";
        } else {
          add_list(value.elements());
        }
        break;
    }
  }

  void add_number(double number) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.6g", number);
    text_ += buffer;
  }

  void add_string(std::string_view string) {
    std::size_t length = std::min({string.size(), kMostCharacters, string.find_first_of("\r\n")});
    const auto is_inside = [&](std::size_t i) {  // of a UTF-8 sequence
      return i < string.size() && (static_cast<unsigned char>(string[i]) & 0xC0) == 0x80;
    };
    while (length > 0 && is_inside(length)) --length;
    ((text_ += '"') += string.substr(0, length)) += length < string.size() ? "…\"" : "\"";
  }

  void add_list(const ValueList& elements) {
    text_ += '[';
    for (std::size_t i = 0; i < elements.size(); ++i) {
      if (i > 0) text_ += ", ";
      if (i == kMostElements) {
        text_ += "…";
        break;
      }
      add_value(elements[i], true);
    }
    text_ += ']';
  }

  const NodeTree& tree_;
  const Node& node_;
  const NodeRow& row_;
  std::string text_;
};

}  // namespace

std::string label_of(const NodeTree& tree, const Node& node) { return Writer(tree, node).label(); }

}  // namespace frontend
