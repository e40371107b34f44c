#include "subtree_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

#include "subtrees/node_row.hpp"

namespace validation {
namespace {

using frontend::ArgumentValue;
using frontend::ImportOptions;
using frontend::Node;
using frontend::NodeKind;
using frontend::NodeTree;
using frontend::ValueKind;
using frontend::ValueList;

std::string number_text(double number) {
  if (std::isnan(number)) return "(0/0)";
  if (std::isinf(number)) return number > 0 ? "(1/0)" : "(-1/0)";
  std::array<char, 32> digits;
  const char* const end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
  return std::string(digits.data(), static_cast<size_t>(end - digits.data()));
}

std::string string_literal(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + '"';
}

std::string matrix_text(const csgcore::Affine& map) {
  std::string text = "multmatrix([";
  for (int row = 0; row < 3; ++row) {
    text += '[';
    for (int column = 0; column < 3; ++column) text += number_text(map.linear[column][row]) + ',';
    text += number_text(map.translation[row]) + "],";
  }
  return text + "[0,0,0,1]])";
}

class SubtreeText {
 public:
  SubtreeText(const NodeTree& tree, uint32_t root, const ImportOptions& options)
      : tree_(tree), root_(root), options_(options) {}

  void write() {
    const uint32_t end = tree_.nodes[root_].end;
    std::vector<uint32_t> open;
    for (uint32_t i = root_; i < end;) {
      for (; !open.empty() && open.back() <= i; open.pop_back()) text_ += '}';
      const Node& node = tree_.nodes[i];
      if (i != root_ && (node.modifiers & language::kBackgroundModifier) != 0) {
        i = node.end;
        continue;
      }
      write_node(i);
      if (node.end == i + 1) {
        text_ += ';';
      } else {
        text_ += '{';
        open.push_back(node.end);
      }
      ++i;
    }
    text_.append(open.size(), '}');
  }

  bool has_text() const { return has_text_; }
  std::string take_text() { return std::move(text_); }

 private:
  void write_node(uint32_t index) {
    const Node& node = tree_.nodes[index];
    has_text_ = has_text_ || node.kind == NodeKind::kText;
    if (node.kind == NodeKind::kMultmatrix) {
      write_matrix(index);
    } else if (node.kind == NodeKind::kColor) {
      text_ += "group()";
    } else {
      write_call(index);
    }
  }

  void write_matrix(uint32_t index) {
    frontend::NodeProblems told;  // when the node was taken
    frontend::NodeReader reader(tree_, tree_.nodes[index], told);
    const auto file = std::get<frontend::FileMatrix>(read_node(reader, {options_, fonts_}));
    if (!is_affine(file)) {  // nothing is left
      text_ += "multmatrix([[0,0,0,0],[0,0,0,0],[0,0,0,0],[0,0,0,1]])";
      return;
    }
    text_ += matrix_text(heal(file).map);
  }

  void write_call(uint32_t index) {
    const Node& node = tree_.nodes[index];
    const double fn = is_round(node.kind) ? options_.fn.value_or(0) : 0;
    text_ += std::string(name_of(node.kind)) + '(';
    for (const language::NodeArgument& argument : tree_.arguments_of(node)) {
      const std::string_view name = argument.name.text();
      const bool is_unknown = name.empty() && !argument.name.is_positional();
      if (is_unknown || name == "timestamp" || (fn > 0 && name == "$fn")) continue;
      if (!name.empty()) text_ += std::string(name) + '=';
      const ArgumentValue value(tree_, argument);
      if (names_file(node.kind, argument)) {
        write_file(value.text());
      } else {
        write_value(value);
      }
      text_ += ',';
    }
    if (fn > 0) {
      text_ += "$fn=" + number_text(fn);
    } else if (text_.back() == ',') {
      text_.pop_back();
    }
    text_ += ')';
  }

  static bool is_round(NodeKind kind) {
    switch (kind) {
      case NodeKind::kSphere:
      case NodeKind::kCylinder:
      case NodeKind::kCircle:
      case NodeKind::kRotateExtrude:
      case NodeKind::kOffset:
      case NodeKind::kText:
        return true;
      default:
        return false;
    }
  }

  static bool names_file(NodeKind kind, const language::NodeArgument& argument) {
    if (!argument.value.is_string()) return false;
    const bool may_be_unnamed = kind == NodeKind::kImport || kind == NodeKind::kSurface;
    return argument.name == "file" || (may_be_unnamed && argument.name.is_positional());
  }

  void write_file(std::string_view name) {
    if (name.empty()) {
      text_ += "\"\"";
      return;
    }
    std::error_code failed;
    const std::filesystem::path path =
        std::filesystem::absolute(std::filesystem::path(options_.folder) / name, failed)
            .lexically_normal();
    text_ += string_literal(path.string());
  }

  /// Does not recurse: lists may be nested deeply.
  void write_value(const ArgumentValue& value) {
    struct OpenList {
      ValueList elements;
      size_t next;
    };
    std::vector<OpenList> lists;
    ArgumentValue current = value;
    for (;;) {
      if (current.is_list()) {
        text_ += '[';
        lists.push_back({current.elements(), 0});
      } else {
        write_scalar(current);
        if (!lists.empty()) text_ += ',';
      }
      while (!lists.empty() && lists.back().next == lists.back().elements.size()) {
        lists.pop_back();
        text_ += lists.empty() ? "]" : "],";
      }
      if (lists.empty()) return;
      current = lists.back().elements[lists.back().next++];
    }
  }

  void write_scalar(const ArgumentValue& value) {
    switch (value.kind()) {
      case ValueKind::kUndef:
      case ValueKind::kList:
        text_ += "undef";
        return;
      case ValueKind::kBool:
        text_ += value.boolean() ? "true" : "false";
        return;
      case ValueKind::kNumber:
        text_ += number_text(value.number());
        return;
      case ValueKind::kString:
        text_ += string_literal(value.text());
    }
  }

  const NodeTree& tree_;
  const uint32_t root_;
  const ImportOptions& options_;
  frontend::DesignFonts fonts_{{}};  // which no node that is read here has
  bool has_text_ = false;
  std::string text_;
};

/// Returns the lines that make fonts of files known.
std::string font_lines(const std::vector<std::string>& fonts) {
  std::string lines;
  for (const std::string& font : fonts) {
    std::error_code failed;
    const std::string path = std::filesystem::absolute(font, failed).string();
    if (path.find('>') == std::string::npos) lines += "use <" + path + ">\n";
  }
  return lines;
}

}  // namespace

std::string subtree_text(const NodeTree& tree, uint32_t root, const ImportOptions& options,
                         const std::vector<std::string>& fonts) {
  SubtreeText body(tree, root, options);
  body.write();
  return (body.has_text() ? font_lines(fonts) : "") + body.take_text();
}

}  // namespace validation
