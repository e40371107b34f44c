// What the importer does with each kind of node.
#pragma once

#include <cstdint>
#include <string_view>

#include "csgcore/csg_tree.hpp"
#include "frontend/design_tree.hpp"
#include "frontend/import_options.hpp"

namespace frontend {

enum class Role : uint8_t {
  kSolid,
  kOperation,
  kPlane,  // a 2D primitive, or a node of 2D ones that OpenSCAD evaluates as a whole
  kUnsupportedOperation,
};

constexpr std::string_view kBecauseUnknown = "OpenSCAD 2021.01 does not know it";

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
    case NodeKind::kFill:
    case NodeKind::kUnion:
    case NodeKind::kDifference:
    case NodeKind::kIntersection:
      return Role::kOperation;
    case NodeKind::kCircle:
    case NodeKind::kSquare:
    case NodeKind::kPolygon:
    case NodeKind::kText:
    case NodeKind::kHull:
    case NodeKind::kMinkowski:
    case NodeKind::kOffset:
    case NodeKind::kResize:
    case NodeKind::kLinearExtrude:
    case NodeKind::kRotateExtrude:
    case NodeKind::kProjection:
      return Role::kPlane;
    case NodeKind::kRoof:
      break;
  }
  return Role::kUnsupportedOperation;
}

/// A node that is one leaf of OpenSCAD's preview, whether it is of solids or of plane figures.
inline bool is_leaf_of_either(NodeKind kind) {
  return kind == NodeKind::kRender || kind == NodeKind::kFill;
}

/// A node of solids that OpenSCAD's preview evaluates as a whole, to one leaf (leaves.hpp). Its
/// final render has no leaves.
inline bool is_compound_leaf(NodeKind kind, PictureKind picture) {
  return is_leaf_of_either(kind) && picture != PictureKind::kRendered;
}

inline bool is_plane_primitive(NodeKind kind) {
  return kind == NodeKind::kCircle || kind == NodeKind::kSquare || kind == NodeKind::kPolygon ||
         kind == NodeKind::kText;
}

/// A node that has a place among Primitive::id.
inline bool is_primitive_node(NodeKind kind) {
  return role_of(kind) == Role::kSolid || is_plane_primitive(kind);
}

inline bool is_extrusion(NodeKind kind) {
  return kind == NodeKind::kLinearExtrude || kind == NodeKind::kRotateExtrude;
}

/// The operation of a node on its children: for most kinds the union.
inline csgcore::Op operation_of(NodeKind kind) {
  if (kind == NodeKind::kDifference) return csgcore::Op::kDifference;
  if (kind == NodeKind::kIntersection) return csgcore::Op::kIntersection;
  return csgcore::Op::kUnion;
}

}  // namespace frontend
