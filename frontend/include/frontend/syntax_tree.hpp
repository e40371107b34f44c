// The syntax tree of a .csg file (frontend/OPENSCAD.md, "The .csg file"), with each node's place in
// the file.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/error.hpp"

namespace frontend {

/// All nodes that OpenSCAD can write.
enum class NodeKind : uint8_t {
  kSphere,
  kCylinder,
  kCube,
  kPolyhedron,  // 3D primitives
  kCircle,
  kSquare,
  kPolygon,
  kText,  // 2D primitives
  kMultmatrix,
  kColor,
  kGroup,
  kRender,
  kUnion,
  kDifference,
  kIntersection,
  kHull,
  kFill,
  kMinkowski,
  kProjection,
  kOffset,
  kResize,
  kLinearExtrude,
  kRotateExtrude,
  kImport,
  kSurface,
  kRoof,
};

/// The names as they are spelled in a file, in NodeKind's order.
inline constexpr auto kNodeNames = std::to_array<std::string_view>({
    "sphere",     "cylinder",   "cube",         "polyhedron",     "circle",         "square",
    "polygon",    "text",       "multmatrix",   "color",          "group",          "render",
    "union",      "difference", "intersection", "hull",           "fill",           "minkowski",
    "projection", "offset",     "resize",       "linear_extrude", "rotate_extrude", "import",
    "surface",    "roof",
});
static_assert(kNodeNames.size() == static_cast<size_t>(NodeKind::kRoof) + 1);

/// Returns the name as it is spelled in a file ("sphere").
constexpr std::string_view name_of(NodeKind kind) { return kNodeNames[static_cast<size_t>(kind)]; }

/// Bits of SyntaxNode::modifiers.
enum Modifier : uint8_t {
  kBackground = 1 /* % */,
  kHighlight = 2 /* # */,
  kRoot = 4 /* ! */,
  kDisable = 8 /* * */
};

enum class ValueKind : uint8_t { kUndef, kBool, kNumber, kString, kList };

/// One value. Lists hold their elements contiguously in SyntaxTree::values.
struct Value {
  ValueKind kind = ValueKind::kUndef;
  bool boolean = false;
  uint32_t count = 0;  // list: elements; string: bytes
  union {
    double number;
    uint64_t first;  // list: index of the first element in SyntaxTree::values;
  };                 // string: offset into SyntaxTree::strings
  Value() : number(0) {}
};

struct Argument {
  std::string_view name;  // empty: positional. Points into SyntaxTree::strings or static storage
  Value value;
};

/// A node; its children follow it in preorder.
struct SyntaxNode {
  NodeKind kind;
  uint8_t modifiers = 0;
  uint32_t argument_count = 0;
  uint32_t first_argument = 0;  // index into SyntaxTree::arguments
  uint32_t subtree_end = 0;     // index one past this node's last descendant
  Location location;            // place of the name
};

/// A parsed file. Nodes are in preorder: node i's first child is i + 1, the sibling after child c
/// is nodes[c].subtree_end, and the last child's subtree_end is nodes[i].subtree_end. Top-level
/// nodes start at 0. The tree owns all that it refers to, and can only be moved, since argument
/// names point into it.
struct SyntaxTree {
  SyntaxTree() = default;
  SyntaxTree(SyntaxTree&&) = default;
  SyntaxTree& operator=(SyntaxTree&&) = default;
  SyntaxTree(const SyntaxTree&) = delete;
  SyntaxTree& operator=(const SyntaxTree&) = delete;

  std::string file_name;  // as messages show it
  /// The names of the files that Location::file counts, of an evaluated .scad: it and what it
  /// includes and uses. Empty: all nodes are of the file `file_name`.
  std::vector<std::string> file_names;
  /// Whether the numbers are the design's own doubles. Those of a .csg have six digits.
  bool has_all_digits = false;
  std::vector<SyntaxNode> nodes;
  /// Where the nodes' names begin in their files, in bytes: by node.
  std::vector<uint32_t> offsets;
  std::vector<Argument> arguments;
  std::vector<Value> values;
  std::vector<char> strings;  // a vector, whose storage does not move with the tree

  /// Returns the name of the file that a place is in.
  const std::string& file_of(Location location) const {
    return location.file < file_names.size() ? file_names[location.file] : file_name;
  }
  std::span<const Argument> arguments_of(const SyntaxNode& node) const {
    return {arguments.data() + node.first_argument, node.argument_count};
  }
  std::span<const Value> elements_of(const Value& list) const {
    return {values.data() + list.first, list.count};
  }
  std::string_view text_of(const Value& string) const {
    return {strings.data() + string.first, string.count};
  }
  /// Leaves the nodes without arguments, which take most of the memory.
  void free_arguments() {
    arguments = {};
    values = {};
    strings = {};
    for (SyntaxNode& node : nodes) node.argument_count = 0;
  }
};

}  // namespace frontend
