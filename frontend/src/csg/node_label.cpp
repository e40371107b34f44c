#include "csg/node_label.hpp"

#include <algorithm>
#include <cstdio>
#include <span>
#include <string_view>

#include "csg/argument_value.hpp"

namespace frontend {
namespace {

/// Longer texts and lists are cut.
constexpr std::size_t kMostCharacters = 24, kMostElements = 4;

/// The arguments that tell what a node is, in the order in which they are shown.
std::span<const language::ArgumentName> telling_arguments(NodeKind kind) {
  static constexpr language::ArgumentName kSphere[] = {"r"}, kCylinder[] = {"h", "r1", "r2"},
                                          kSize[] = {"size"}, kText[] = {"text"},
                                          kLinear[] = {"height", "twist", "scale"},
                                          kAngle[] = {"angle"}, kFile[] = {"file"},
                                          kCut[] = {"cut"}, kOffset[] = {"r", "delta"},
                                          kResize[] = {"newsize"};
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
  Writer(const NodeTree& tree, const Node& node) : tree_(tree), node_(node) {}

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
  /// Returns the argument of that name; undef if there is none.
  ArgumentValue find(language::ArgumentName name) const {
    for (const language::NodeArgument& argument : tree_.arguments_of(node_)) {
      if (argument.name == name) return {tree_, argument};
    }
    return {};
  }

  void add_count(language::ArgumentName name, std::string_view unit) {
    const ArgumentValue list = find(name);
    if (!list.is_list()) return;
    text_ += std::to_string(list.elements().size()) += ' ';
    text_ += unit;
  }

  void add_arguments() {
    for (const language::NodeArgument& argument : tree_.arguments_of(node_)) {
      if (argument.name.is_positional()) add({}, {tree_, argument});
    }
    const bool is_straight = node_.kind == NodeKind::kCylinder && are_equal(find("r1"), find("r2"));
    for (const language::ArgumentName name : telling_arguments(node_.kind)) {
      const ArgumentValue value = find(name);
      if (is_usual(name, value)) continue;
      if (is_straight && name == "r2") continue;
      add(is_straight && name == "r1" ? "r" : name.text(), value);
    }
  }

  static bool are_equal(const ArgumentValue& a, const ArgumentValue& b) {
    return a.is_number() && b.is_number() && a.number() == b.number();
  }

  /// Whether a value says nothing: OpenSCAD writes it where the design does not.
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
  std::string text_;
};

}  // namespace

std::string label_of(const NodeTree& tree, const Node& node) { return Writer(tree, node).label(); }

}  // namespace frontend
