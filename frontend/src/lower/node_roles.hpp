// What the importer does with each kind of node.
#pragma once

#include <cstdint>

#include "frontend/import_options.hpp"
#include "frontend/syntax_tree.hpp"

namespace frontend {

enum class Role : uint8_t { kSolid, kOperation, kUnsupportedLeaf, kUnsupportedOperation };

inline Role role_of(NodeKind kind) {
  switch (kind) {
    case NodeKind::kSphere:
    case NodeKind::kCylinder:
    case NodeKind::kCube:
    case NodeKind::kPolyhedron:
    case NodeKind::kImport:
    case NodeKind::kSurface:
      return Role::kSolid;
    case NodeKind::kMultmatrix:
    case NodeKind::kColor:
    case NodeKind::kGroup:
    case NodeKind::kRender:
    case NodeKind::kUnion:
    case NodeKind::kDifference:
    case NodeKind::kIntersection:
      return Role::kOperation;
    case NodeKind::kCircle:
    case NodeKind::kSquare:
    case NodeKind::kPolygon:
    case NodeKind::kText:
      return Role::kUnsupportedLeaf;
    case NodeKind::kHull:
    case NodeKind::kFill:
    case NodeKind::kMinkowski:
    case NodeKind::kProjection:
    case NodeKind::kOffset:
    case NodeKind::kResize:
    case NodeKind::kLinearExtrude:
    case NodeKind::kRotateExtrude:
    case NodeKind::kRoof:
      break;
  }
  return Role::kUnsupportedOperation;
}

/// A node that OpenSCAD's preview evaluates as a whole, to one leaf (leaves.hpp). Its final render
/// has no leaves.
inline bool is_compound_leaf(NodeKind kind, PictureKind picture) {
  return kind == NodeKind::kRender && picture != PictureKind::kRendered;
}

/// A node that has a place among Primitive::id.
inline bool is_primitive_node(NodeKind kind) {
  const Role role = role_of(kind);
  return role == Role::kSolid || role == Role::kUnsupportedLeaf;
}

}  // namespace frontend
