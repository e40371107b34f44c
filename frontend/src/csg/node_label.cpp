#include "csg/node_label.hpp"

#include <algorithm>
#include <cstdio>
#include <span>
#include <string_view>

namespace frontend {
namespace {

/// Longer texts and lists are cut.
constexpr std::size_t kMostCharacters = 24, kMostElements = 4;

/// The arguments that tell what a node is, in the order in which they are shown.
std::span<const std::string_view> telling_arguments(NodeKind kind) {
  static constexpr std::string_view kSphere[] = {"r"}, kCylinder[] = {"h", "r1", "r2"},
                                    kSize[] = {"size"}, kText[] = {"text"},
                                    kLinear[] = {"height", "twist", "scale"}, kAngle[] = {"angle"},
                                    kFile[] = {"file"}, kCut[] = {"cut"},
                                    kOffset[] = {"r", "delta"}, kResize[] = {"newsize"};
  switch (kind) {
    case NodeKind::kSphere:
    case NodeKind::kCircle:
      return kSphere;
    case NodeKind::kCylinder:
      return kCylinder;
    case NodeKind::kCube:
    case NodeKind::kSquare:
      return kSize;
    case NodeKind::kText:
      return kText;
    case NodeKind::kLinearExtrude:
      return kLinear;
    case NodeKind::kRotateExtrude:
      return kAngle;
    case NodeKind::kImport:
    case NodeKind::kSurface:
      return kFile;
    case NodeKind::kProjection:
      return kCut;
    case NodeKind::kOffset:
      return kOffset;
    case NodeKind::kResize:
      return kResize;
    default:
      return {};
  }
}

class Writer {
 public:
  Writer(const SyntaxTree& tree, const SyntaxNode& node) : tree_(tree), node_(node) {}

  std::string label() {
    text_ = name_of(node_.kind);
    text_ += '(';
    if (node_.kind == NodeKind::kPolyhedron) {
      add_count("faces", "faces");
    } else if (node_.kind == NodeKind::kPolygon) {
      add_count("points", "points");
    } else {
      add_arguments();
    }
    return std::move(text_ += ')');
  }

 private:
  const Value* find(std::string_view name) const {
    for (const Argument& argument : tree_.arguments_of(node_)) {
      if (argument.name == name) return &argument.value;
    }
    return nullptr;
  }

  void add_count(std::string_view name, std::string_view unit) {
    const Value* const list = find(name);
    if (list == nullptr || list->kind != ValueKind::kList) return;
    text_ += std::to_string(list->count) += ' ';
    text_ += unit;
  }

  void add_arguments() {
    for (const Argument& argument : tree_.arguments_of(node_)) {
      if (argument.name.empty()) add({}, argument.value);
    }
    const Value *const r1 = find("r1"), *const r2 = find("r2");
    const bool is_straight = node_.kind == NodeKind::kCylinder && r1 && r2 && are_equal(*r1, *r2);
    for (const std::string_view name : telling_arguments(node_.kind)) {
      const Value* const value = find(name);
      if (value == nullptr || is_usual(name, *value)) continue;
      if (is_straight && name == "r2") continue;
      add(is_straight && name == "r1" ? "r" : name, *value);
    }
  }

  static bool are_equal(const Value& a, const Value& b) {
    return a.kind == ValueKind::kNumber && b.kind == ValueKind::kNumber && a.number == b.number;
  }

  /// Whether a value says nothing: OpenSCAD writes it where the design does not.
  bool is_usual(std::string_view name, const Value& value) const {
    if (value.kind == ValueKind::kUndef) return true;
    const double usual = name == "twist" ? 0 : name == "scale" ? 1 : name == "angle" ? 360 : -1;
    if (name == "cut") return value.kind == ValueKind::kBool && !value.boolean;
    if (usual < 0) return false;
    if (value.kind == ValueKind::kNumber) return value.number == usual;
    if (value.kind != ValueKind::kList) return false;
    const std::span<const Value> elements = tree_.elements_of(value);
    return std::all_of(elements.begin(), elements.end(), [&](const Value& element) {
      return element.kind == ValueKind::kNumber && element.number == usual;
    });
  }

  void add(std::string_view name, const Value& value) {
    if (text_.back() != '(') text_ += ", ";
    if (!name.empty()) (text_ += name) += " = ";
    add_value(value);
  }

  /// Lists within lists are not written.
  void add_value(const Value& value, bool is_element = false) {
    switch (value.kind) {
      case ValueKind::kUndef:
        text_ += "undef";
        break;
      case ValueKind::kBool:
        text_ += value.boolean ? "true" : "false";
        break;
      case ValueKind::kNumber:
        add_number(value.number);
        break;
      case ValueKind::kString:
        add_string(tree_.text_of(value));
        break;
      case ValueKind::kList:
        if (is_element) {
          text_ += "[…]";
        } else {
          add_list(tree_.elements_of(value));
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

  void add_list(std::span<const Value> elements) {
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

  const SyntaxTree& tree_;
  const SyntaxNode& node_;
  std::string text_;
};

}  // namespace

std::string label_of(const SyntaxTree& tree, const SyntaxNode& node) {
  return Writer(tree, node).label();
}

}  // namespace frontend
