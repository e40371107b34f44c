// A .csg file as a syntax tree (frontend/OPENSCAD.md, "The .csg file"): every node with its place
// in the file.
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

/// Every node that OpenSCAD can write.
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

/// The names as they stand in a file, in NodeKind's order.
inline constexpr auto kNodeNames = std::to_array<std::string_view>({
    "sphere",     "cylinder",   "cube",         "polyhedron",     "circle",         "square",
    "polygon",    "text",       "multmatrix",   "color",          "group",          "render",
    "union",      "difference", "intersection", "hull",           "fill",           "minkowski",
    "projection", "offset",     "resize",       "linear_extrude", "rotate_extrude", "import",
    "surface",    "roof",
});
static_assert(kNodeNames.size() == static_cast<size_t>(NodeKind::kRoof) + 1);

/// The name as it stands in a file ("sphere").
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
  Location location;            // of the name
};

/// A parsed file. Nodes in preorder: the children of node i are i+1 and, from each child c, the
/// next is nodes[c].subtree_end, up to nodes[i].subtree_end. Top-level nodes start at 0. Owns all
/// that it refers to; move-only, since the arguments' names point into it.
struct SyntaxTree {
  SyntaxTree() = default;
  SyntaxTree(SyntaxTree&&) = default;
  SyntaxTree& operator=(SyntaxTree&&) = default;
  SyntaxTree(const SyntaxTree&) = delete;
  SyntaxTree& operator=(const SyntaxTree&) = delete;

  std::string file_name;  // as messages show it
  std::vector<SyntaxNode> nodes;
  std::vector<Argument> arguments;
  std::vector<Value> values;
  std::vector<char> strings;  // a vector, since its storage does not move with the tree

  std::span<const Argument> arguments_of(const SyntaxNode& node) const {
    return {arguments.data() + node.first_argument, node.argument_count};
  }
  std::span<const Value> elements_of(const Value& list) const {
    return {values.data() + list.first, list.count};
  }
  std::string_view text_of(const Value& string) const {
    return {strings.data() + string.first, string.count};
  }
};

}  // namespace frontend
