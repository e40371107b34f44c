// From the nodes of a tree to primitives in their frames.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "csgcore/geometry.hpp"
#include "csgcore/primitive.hpp"
#include "fonts/design_fonts.hpp"
#include "frontend/import_options.hpp"
#include "frontend/imported_design.hpp"
#include "heal/frames.hpp"
#include "heal/matrix_healing.hpp"
#include "lower/resolved_modifiers.hpp"
#include "solids/figure_solids.hpp"
#include "solids/import_files.hpp"
#include "solids/import_polyhedra.hpp"
#include "solids/solid_pool.hpp"
#include "solids/solid_shape.hpp"
#include "subtrees/lowering.hpp"
#include "subtrees/subtree_evaluation.hpp"

namespace frontend {

class Collector {
 public:
  /// Keeps references to both arguments.
  Collector(const DesignTree& tree, const ImportOptions& options);

  /// Takes all nodes, whose arguments are not looked at after that. Throws if it is stopped
  /// (throw_if_stopped).
  void collect(const std::stop_token& stop);
  /// Makes the solids that collect() has put off. Throws if it is stopped (throw_if_stopped).
  void finish(const std::stop_token& stop);

  static constexpr uint32_t kNoPrimitive = 0xFFFFFFFFu;
  std::vector<uint32_t> primitive_of;  // by node: index into `primitives`, or kNoPrimitive
  std::vector<csgcore::Primitive> primitives;
  std::vector<uint32_t> frame_of;   // by primitive
  std::vector<csgcore::Box> boxes;  // by primitive, faceted
  std::vector<int> fragments;       // by primitive; 0: it is not to be faceted
  PolyhedronPool polyhedra;
  FileImports files;
  DesignFonts fonts;
  FrameTree frames;
  NodeProblems problems;
  uint32_t primitive_nodes = 0;
  std::vector<uint32_t> places;  // by primitive node, where the options want them: the leaf
  bool any_modifiers = false;    // of the nodes that are drawn
  /// The compound leaves (leaves.hpp) that are drawn, in file order, each with its frame.
  struct CompoundLeaf {
    uint32_t node;
    uint32_t frame;
  };
  std::vector<CompoundLeaf> compound_leaves;
  /// What has become of a node that is a leaf as a whole, of several primitives: a 2D subtree, a
  /// hull, or a polyhedron whose faces run both ways.
  struct WholeLeaf {
    uint32_t node;
    uint32_t frame = 0;
    Presence presence = Presence::kEmpty;
    csgcore::CsgTree solid{};  // over `primitives`; empty unless it is solid
    csgcore::Box box{};        // of its parts, in the world
    bool is_plate = false;
    std::optional<csgcore::Box> known_box{};  // OpenSCAD's, where it need not be looked for
    std::vector<Figure> figures{};            // of a plate in a final render
    bool is_faceted = false;                  // facets stand for something round
    uint8_t inner_modifiers = 0;              // of a part inside of another one (InnerPart)
    /// Its operations are those of nodes of solids, which cut faces.
    bool has_operations = false;
    /// They count as those of the tree around it, which tells cut faces from others.
    bool keeps_operations = false;
  };
  std::vector<WholeLeaf> whole_leaves;  // in file order
  /// Returns, by primitive, whether it is part of a plate that stands for a plane figure.
  std::vector<bool> are_of_plates() const;
  NodeRange selected;  // what `!` leaves
  // After finish():
  /// Nodes that are missing, which are among the problems.
  std::vector<uint32_t> left_out;

 private:
  /// What a node hands down to its children.
  struct Context {
    uint32_t node;
    uint32_t frame;  // coordinates
    std::optional<csgcore::Color> color;
    std::optional<csgcore::Color> leaf_color;  // of the compound leaf, where in_leaf is true
    bool flattened;  // a matrix with inf or nan on the way: nothing is left
    bool in_leaf;    // a compound one, whose nodes have no colours of their own
  };

  /// A solid whose primitives are made later, with those of others at once.
  struct PendingSolid {
    size_t leaf;  // among whole_leaves
    Context context;
    uint32_t id;               // of its primitives
    size_t primitives_before;  // of the design
    SolidValue value;
  };

  bool is_within(uint32_t node, uint32_t ancestor) const {
    return node < tree_.nodes[ancestor].end;
  }
  bool has_children(uint32_t node) const { return tree_.nodes[node].end > node + 1; }
  void survey();
  void find_stretches();
  NodeSources sources_of(uint32_t node);
  bool visit(uint32_t node);
  void leave_out(uint32_t node, const std::string& why);
  void enter(uint32_t node);
  /// Returns what a multmatrix or color node hands down where it is handed `around`.
  Context within(Context around, const NodeData& node);
  void enter_leaf(uint32_t node);
  void leave_leaf(uint32_t node);
  void add_solid(uint32_t node);
  bool flatten(uint32_t node, const csgcore::FacetSettings& facets, csgcore::Primitive& primitive);
  uint32_t typed_frame(uint32_t node, uint32_t frame);
  /// Returns what a node that is one leaf as a whole is handed down, with its typed frame.
  Context typed_context(uint32_t node);
  /// Returns the primitive's index, or kNoPrimitive: it is flat, or left out.
  uint32_t add_primitive(csgcore::Primitive primitive, uint32_t node, const Context& context,
                         uint32_t frame, const csgcore::Box& box, int fragments);
  std::optional<SolidShape> read_solid(uint32_t node);
  void add_sides(uint32_t node, const csgcore::Primitive& solid, const SolidOfFaces& faces,
                 const Context& context);
  Subtree read_subtree(uint32_t root);
  void add_whole(uint32_t root);
  bool is_of_either_dimension(uint32_t node);
  /// The dimension of the first geometry of a subtree: 2, 3, or 0 if it has none.
  int dimension_of(uint32_t root) const;
  bool add_if_plane(uint32_t root);
  /// Returns whether a final render keeps a part of that dimension. One that it does not keep is
  /// empty, with a warning.
  bool keeps_dimension(uint32_t root, int dimension);
  void add_whole_leaf(const Subtree& subtree, uint32_t root, const Context& context,
                      NodeProblems& told);
  Presence lower_subtree(const Subtree& subtree, const Context& context, NodeProblems& told,
                         WholeLeaf& leaf);
  void add_inner_parts(const Subtree& subtree, const Context& context);
  void add_pending(const std::stop_token& stop);
  Presence take_lowered(LoweredSubtree lowered, const Context& context, WholeLeaf& leaf);

  const NodeTree& tree_;
  const ImportOptions& options_;
  const bool keeps_colors_;  // GeometryDialect::keeps_colors
  const bool shows_colors_;  // of nodes and of files
  std::vector<Context> contexts_;
  /// By node, and behind the last one: how many primitive nodes stand before it.
  std::vector<uint32_t> ids_;
  /// By node: NodeSources::stretch. Empty: all are 1.
  std::vector<double> stretches_;
  /// The end of the node at the top that was entered last, and the dimension of the first one that
  /// has any, which all others must have (0: there was none). Only final renders keep them.
  uint32_t top_node_end_ = 0;
  int rendered_dimension_ = 0;
  FigureSolids figure_solids_;
  const std::shared_ptr<SolidPool> solids_;
  const SolidSources sources_;
  std::vector<PendingSolid> pending_;  // in file order
};

/// Returns the one of the leaves, which are in file order, that the node is; null: it is none.
template <typename Leaf>
const Leaf* leaf_at(const std::vector<Leaf>& leaves, uint32_t node) {
  const auto found = std::ranges::lower_bound(leaves, node, {}, &Leaf::node);
  return found != leaves.end() && found->node == node ? &*found : nullptr;
}

}  // namespace frontend
