// The table of nodes: what scadray knows of each kind. A node is one file of the room `nodes`, with
// its row; what differs from kind to kind asks the row.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "arguments/node_data.hpp"
#include "arguments/node_reader.hpp"
#include "csgcore/csg_tree.hpp"
#include "fonts/design_fonts.hpp"
#include "frontend/import_options.hpp"
#include "plane/figure.hpp"
#include "solids/solid_value.hpp"

namespace frontend {

class SubtreeEvaluation;
struct Extrusion;
struct LoweredSubtree;

/// What the preview does with a node.
enum class Role : uint8_t {
  kSolid,      // it is a primitive
  kOperation,  // its children are leaves, or hold them
  kWhole,      // it is one leaf with all below it: a plane figure, an extrusion, a hull
};

/// Which parts with `%` and `#` within a node are drawn by themselves.
enum class InnerParts : uint8_t {
  kNone,
  kOwn,        // it is one, and those below it are others
  kOfMembers,  // its children are
};

/// Where nodes get what the design does not hold itself.
struct NodeSources {
  const ImportOptions& options;
  DesignFonts& fonts;
  /// The most that nodes around this one stretch it by, for ImportOptions::tolerance.
  double stretch = 1;
};

struct NodeRow {
  Role role;
  /// Of what it makes: 2 or 3; 0: that of what it holds.
  uint8_t dimension = 0;
  /// What it does with its children.
  csgcore::Op op = csgcore::Op::kUnion;
  /// OpenSCAD makes one leaf of it and all below it, whether it holds solids or plane figures.
  bool is_one_leaf = false;
  /// OpenSCAD takes 2D children, whatever the first one is.
  bool takes_figures = false;
  /// The figure that it makes needs the figures of its children together, not the operations on
  /// them alone.
  bool joins_figures = false;
  InnerParts inner_parts = InnerParts::kNone;
  /// The arguments that tell what the node is, in the order in which the window shows them.
  std::span<const language::ArgumentName> label{};
  /// The list whose length tells what the node is.
  language::ArgumentName counted{};
  /// Reads the arguments, and tells of wrong ones. Null: they do not matter.
  NodeData (*read)(NodeReader& reader, const NodeSources& sources) = nullptr;
  /// Returns figures whose union is the node's, which is solid, from those of its operands; nothing
  /// if their edges cross too often. Null: they are those of the operands.
  std::optional<std::vector<Figure>> (*figures)(SubtreeEvaluation& evaluation,
                                                uint32_t node) = nullptr;
  /// Returns the node's solid from those of its operands. Null: `op` is what it does with them.
  SolidValue (*solid)(SubtreeEvaluation& evaluation, uint32_t node) = nullptr;
  /// Of an extrusion: returns the primitives, with the operations on its figures. Null: they are
  /// those of `solid`.
  LoweredSubtree (*extruded)(const Extrusion& extrusion) = nullptr;

  bool is_extrusion() const { return takes_figures && dimension == 3; }
  /// Returns whether it has a place among Primitive::id, though it names no drawing.
  bool is_primitive() const {
    return role == Role::kSolid || (role == Role::kWhole && dimension == 2 && figures == nullptr);
  }
};

const NodeRow& row_of(NodeKind kind);

/// Returns whether the node has a place among Primitive::id.
inline bool has_place(const NodeTree& tree, const Node& node) {
  const NodeRow& row = row_of(node.kind);
  return row.is_primitive() || (row.is_extrusion() && names_drawing(tree, node));
}

inline NodeData read_node(NodeReader& reader, const NodeSources& sources) {
  const NodeRow& row = row_of(reader.node().kind);
  return row.read == nullptr ? NodeData() : row.read(reader, sources);
}

/// Returns a node's facets, or those that the user asks for in their place.
csgcore::FacetSettings chosen(const NodeSources& sources, csgcore::FacetSettings facets);
RoundNode chosen(const NodeSources& sources, RoundNode round);
csgcore::FacetSettings chosen(const ImportOptions& options, csgcore::FacetSettings facets);
RoundNode chosen(const ImportOptions& options, RoundNode round);
/// Returns whether what OpenSCAD draws with these settings is drawn in facets, if it has any.
bool keeps_facets(const ImportOptions& options, const csgcore::FacetSettings& facets);
/// A circle of more corners cannot be told from a round one, which it then is.
constexpr int kMostFragments = 3600;

// One of each file.
extern const NodeRow kSphereRow, kCylinderRow, kCubeRow, kPolyhedronRow, kCircleRow, kSquareRow,
    kPolygonRow, kTextRow, kMultmatrixRow, kColorRow, kGroupRow, kRenderRow, kUnionRow,
    kDifferenceRow, kIntersectionRow, kHullRow, kFillRow, kMinkowskiRow, kProjectionRow, kOffsetRow,
    kResizeRow, kLinearExtrudeRow, kRotateExtrudeRow, kImportRow, kSurfaceRow, kRoofRow;

}  // namespace frontend
