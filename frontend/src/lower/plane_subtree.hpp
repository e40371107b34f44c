// A subtree that OpenSCAD evaluates as a whole, of 2D nodes: what its nodes' arguments say.
#pragma once

#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "frontend/design_tree.hpp"
#include "frontend/import_options.hpp"
#include "heal/matrix_healing.hpp"
#include "lower/import_files.hpp"
#include "lower/node_problems.hpp"
#include "lower/read_2d.hpp"
#include "lower/read_text.hpp"
#include "lower/solid_node.hpp"

namespace frontend {

/// What the figure of a circle, square or polygon node is in its own coordinates.
struct FigureNode {
  /// Nothing: it is empty. A circle is a disc, or OpenSCAD's polygon if its facets are kept.
  std::optional<Figure> figure;
  /// Of a circle: OpenSCAD's polygon, whose box it draws a picture of. 0: not a circle.
  int fragments = 0;
};

/// The letters of a text node, whose union it is; none: it is empty.
struct TextNode {
  std::vector<PlacedGlyph> letters;
};

struct MatrixNode {
  HealedMatrix matrix;
  bool is_finite = true;
};

struct LinearExtrudeNode {
  LinearExtrudeArguments arguments;
  bool is_faceted = false;  // a twisted one has OpenSCAD's slices
};

struct RotateExtrudeNode {
  RotateExtrudeArguments arguments;
  bool is_faceted = false;
};

struct ProjectionNode {
  bool is_cut = false;  // it is a section; else it is a shadow
};

using PlaneNodeData =
    std::variant<std::monostate, FigureNode, TextNode, MatrixNode, OffsetSettings, ResizeArguments,
                 LinearExtrudeNode, RotateExtrudeNode, ProjectionNode>;

/// Where nodes get what the design does not hold itself.
struct PlaneSources {
  DesignFonts& fonts;
  FileImports& files;
};

/// The nodes of the subtree, in the tree's order, as far as they were taken.
class PlaneSubtree {
 public:
  PlaneSubtree(const NodeTree& tree, uint32_t root) : tree_(tree), root_(root) {}

  /// Reads the arguments of a node of the subtree, and the drawing that it names. `id` is its place
  /// among the primitive nodes. The files must outlive this.
  void take(uint32_t node, uint32_t id, const ImportOptions& options, const PlaneSources& sources,
            NodeProblems& problems);

  /// Returns the node's own subtree.
  PlaneSubtree part(uint32_t node) const;

  const NodeTree& tree() const { return tree_; }
  uint32_t root() const { return root_; }
  /// Of the last descendant, one more.
  uint32_t end() const { return root_ + static_cast<uint32_t>(nodes_.size()); }
  /// One past the node's last descendant; of the root, end().
  uint32_t end_of(uint32_t node) const;
  const Node& syntax(uint32_t node) const { return tree_.nodes[node]; }
  /// Returns the id of the primitives of the node, which is that of its first primitive node.
  uint32_t id(uint32_t node) const { return nodes_[node - root_].id; }
  /// Returns the drawing that the node names; null if it names none.
  const ImportedDrawing* drawing(uint32_t node) const { return nodes_[node - root_].drawing; }
  template <typename Data>
  const Data& data(uint32_t node) const {
    return std::get<Data>(nodes_[node - root_].data);
  }
  /// What the node of a solid says.
  const SolidNode& solid(uint32_t node) const { return nodes_[node - root_].solid; }

 private:
  struct Taken {
    uint32_t id = 0;
    PlaneNodeData data;
    const ImportedDrawing* drawing = nullptr;
    SolidNode solid;
  };
  const NodeTree& tree_;
  uint32_t root_;
  std::vector<Taken> nodes_;
};

/// Whether what OpenSCAD draws with these settings is drawn in facets, if it has any.
bool keeps_facets(const ImportOptions& options, const csgcore::FacetSettings& facets);

}  // namespace frontend
