#include "frontend/importer.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/geometry_dialect.hpp"
#include "frontend/stop.hpp"
#include "heal/healing.hpp"
#include "heal/turned_frames.hpp"
#include "lower/assembly_parts.hpp"
#include "lower/collector.hpp"
#include "lower/composition.hpp"
#include "lower/leaf_boxes.hpp"
#include "lower/plates.hpp"
#include "lower/products.hpp"
#include "lower/resolved_modifiers.hpp"
#include "solids/leaves.hpp"

namespace frontend {
namespace {

using csgcore::Box;
using csgcore::CsgTree;
using csgcore::CsgTreeBuilder;
using csgcore::Op;

constexpr uint32_t kNone = Collector::kNoPrimitive;

/// Writes parts of the file as trees over leaves. With `marks_cut_faces` it marks those primitives
/// whose faces OpenSCAD's development snapshots colour as cut ones where they evaluate a solid: all
/// that a node around them subtracts.
class Emitter {
 public:
  Emitter(const NodeTree& tree, Collector& collected, const ResolvedModifiers& modifiers,
          Leaves& leaves, PictureKind picture, bool marks_cut_faces)
      : tree_(tree),
        collected_(collected),
        modifiers_(modifiers),
        leaves_(leaves),
        is_rendered_(picture == PictureKind::kRendered),
        marks_cut_faces_(marks_cut_faces) {}

  Design design() {
    Design design;
    using Kind = csgcore::Layer::Kind;
    LeafTree model = emit(collected_.selected, kNone, modifiers_.keeps_highlighted);
    design.parts.push_back({Kind::kModel, std::move(model)});
    add_parts(Kind::kBackground, modifiers_.background, design);
    add_parts(Kind::kHighlight, modifiers_.highlight, design);
    design.highlighted_leaves = std::move(highlighted_leaves_);
    std::sort(design.highlighted_leaves.begin(), design.highlighted_leaves.end());
    return design;
  }

 private:
  struct OpenNode {
    uint32_t end;
    const Collector::CompoundLeaf* compound;  // null: it is none
    bool keeps_highlighted;  // it is not a union, or all its operands are highlighted
    bool is_highlighted;     // it has `#`, or a node around it has
    Op op = Op::kUnion;
    bool is_cut = false;    // a node around it, within the solid that is evaluated, subtracts it
    uint32_t operands = 0;  // so far
  };

  void add_parts(csgcore::Layer::Kind kind, std::span<const uint32_t> roots, Design& design) {
    for (const uint32_t root : roots) {
      LeafTree tree = emit({root, tree_.nodes[root].end}, root, true);
      if (!tree.empty()) design.parts.push_back({kind, std::move(tree)});
    }
  }

  /// The nodes of the range as operands of a union. `root` is taken whatever its modifiers say.
  LeafTree emit(NodeRange range, uint32_t root, bool keeps_highlighted) {
    open_.assign(1, {kNone, nullptr, keeps_highlighted, false, Op::kUnion, false, 0});
    for (uint32_t i = range.begin; i < range.end;) {
      const Node& node = tree_.nodes[i];
      close_until(i);
      if (i != root && !is_operand(i)) {
        i = node.end;
        continue;
      }
      const bool is_cut = is_next_cut();
      if (const Collector::WholeLeaf* leaf = leaf_at(collected_.whole_leaves, i)) {
        add_whole_leaf(i, *leaf, is_cut);
        i = node.end;
      } else if (collected_.primitive_of[i] != kNone) {
        add_primitive(i, is_cut);
        i = node.end;
      } else if (row_of(node.kind).role != Role::kOperation || node.end == i + 1) {
        builder().empty();
        i = node.end;
      } else {
        i = enter(i, is_cut);
      }
    }
    close_until(kNone);
    return builder_.finish();
  }

  void close_until(uint32_t position) {
    while (open_.size() > 1 && open_.back().end <= position) {
      const OpenNode done = open_.back();
      open_.pop_back();
      if (done.compound != nullptr) {
        finish_leaf(done);
      } else {
        builder().close();
      }
    }
  }

  /// Returns whether the operand that follows is subtracted where it is, or with what is around it.
  bool is_next_cut() {
    OpenNode& around = open_.back();
    return (around.operands++ > 0 && around.op == Op::kDifference) || around.is_cut;
  }

  /// Marks a primitive of a solid that is evaluated as a whole.
  void mark(uint32_t primitive, bool is_cut) {
    if (!marks_cut_faces_ || !(in_leaf_ || is_rendered_)) return;
    collected_.primitives[primitive].cut_faces =
        is_cut ? csgcore::CutFaces::kAlways : csgcore::CutFaces::kNever;
  }

  /// Marks the primitives of a solid that is of operations on solids, in postfix order.
  void mark_operands(std::span<const csgcore::CsgToken> tokens) {
    const CsgSubtrees subtrees(tokens);
    std::vector<bool> is_cut(tokens.size());
    for (uint32_t i = 0; i < tokens.size(); ++i) {
      if (tokens[i].is_primitive || tokens[i].op != Op::kDifference) continue;
      const uint32_t first = subtrees.operands(i).front();
      std::fill(is_cut.begin() + first + 1, is_cut.begin() + i, true);
    }
    for (size_t i = 0; i < tokens.size(); ++i) {
      if (!tokens[i].is_primitive) continue;
      collected_.primitives[tokens[i].value].cut_faces =
          is_cut[i] ? csgcore::CutFaces::kAlways : csgcore::CutFaces::kNever;
    }
  }

  /// Opens the node, and returns the one to look at next.
  uint32_t enter(uint32_t index, bool is_cut) {
    const Node& node = tree_.nodes[index];
    const bool is_highlighted = is_highlighted_within(index);
    const auto* compound = in_leaf_ ? nullptr : leaf_at(collected_.compound_leaves, index);
    if (compound != nullptr && leaf_of_.contains(index)) {
      add_leaf(leaf_of_[index], is_highlighted);
      return node.end;
    }
    const Op op = row_of(node.kind).op;
    const bool keeps_highlighted = op != Op::kUnion || (!modifiers_.nodes.empty() &&
                                                        modifiers_.nodes[index].keeps_highlighted);
    if (compound == nullptr) {
      builder().open(op);
    } else {
      in_leaf_ = true;
    }
    open_.push_back({node.end, compound, keeps_highlighted, is_highlighted, op,
                     compound == nullptr && is_cut, 0});
    return index + 1;
  }

  void finish_leaf(const OpenNode& node) {
    in_leaf_ = false;
    csgcore::CsgTree solid = leaf_builder_.finish();
    if (solid.empty()) {
      builder_.empty();
      return;
    }
    const auto& [root, frame] = *node.compound;
    leaf_of_[root] = leaf_of(std::move(solid), frame);
    add_leaf(leaf_of_[root], node.is_highlighted);
  }

  /// One primitive is a leaf by itself.
  uint32_t leaf_of(CsgTree solid, uint32_t frame, const std::optional<Box>& box = std::nullopt) {
    if (solid.tokens().size() == 1) return solid.tokens().front().value;
    return leaves_.add(std::move(solid), frame, box);
  }

  void add_primitive(uint32_t node, bool is_cut) {
    const uint32_t primitive = collected_.primitive_of[node];
    mark(primitive, is_cut);
    if (in_leaf_) {
      leaf_builder_.primitive(primitive);
      return;
    }
    add_leaf(primitive, is_highlighted_within(node));
  }

  void add_whole_leaf(uint32_t node, const Collector::WholeLeaf& whole, bool is_cut) {
    if (whole.solid.empty()) {
      builder().empty();
      return;
    }
    if (marks_cut_faces_ && whole.has_operations && !is_cut) {
      mark_operands(whole.solid.tokens());
    } else {
      for (const csgcore::CsgToken& token : whole.solid.tokens()) {
        if (token.is_primitive) mark(token.value, is_cut);
      }
    }
    if (in_leaf_ || whole.keeps_operations) {
      add_tree(whole.solid.tokens(), builder());
      return;
    }
    const auto [entry, is_new] = leaf_of_.try_emplace(node, 0);
    if (is_new) entry->second = leaf_of(whole.solid, whole.frame, whole.known_box);
    add_leaf(entry->second, is_highlighted_within(node));
  }

  /// Returns whether the node has `#`, or a node that is open.
  bool is_highlighted_within(uint32_t node) const {
    const uint8_t own = modifiers_of(tree_, collected_.selected, node);
    return open_.back().is_highlighted || (own & language::kHighlightModifier) != 0;
  }

  void add_leaf(uint32_t leaf, bool is_highlighted) {
    builder_.primitive(leaf);
    if (is_highlighted) highlighted_leaves_.push_back(leaf);
  }

  CsgTreeBuilder& builder() { return in_leaf_ ? leaf_builder_ : builder_; }

  bool is_operand(uint32_t node) const {
    if (modifiers_.nodes.empty()) return true;
    const ResolvedNode& state = modifiers_.nodes[node];
    if (state.presence != Presence::kSolid && state.presence != Presence::kEmpty) return false;
    return !state.highlighted || open_.back().keeps_highlighted || in_leaf_;
  }

  const NodeTree& tree_;
  Collector& collected_;
  const ResolvedModifiers& modifiers_;
  Leaves& leaves_;
  const bool is_rendered_;
  const bool marks_cut_faces_;
  CsgTreeBuilder builder_, leaf_builder_;
  bool in_leaf_ = false;
  std::vector<OpenNode> open_;
  std::unordered_map<uint32_t, uint32_t> leaf_of_;  // by node, of those that are leaves as a whole
  std::vector<uint32_t> highlighted_leaves_;
};

/// Healing is done by then: it knows axes and caps of what is round.
void facet(const DesignTree& tree, Collector& collected, const ImportOptions& options,
           std::vector<Warning>& warnings) {
  uint32_t count = 0;
  uint32_t first = kNone;  // primitive
  for (uint32_t i = 0; i < collected.primitives.size(); ++i) {
    const int fragments = collected.fragments[i];
    if (fragments == 0 || collected.polyhedra.facet(collected.primitives[i], fragments)) continue;
    if (count++ == 0) first = i;
  }
  if (count == 0) return;
  const auto node = std::find(collected.primitive_of.begin(), collected.primitive_of.end(), first);
  const language::Place first_place =
      tree.nodes->nodes[static_cast<size_t>(node - collected.primitive_of.begin())].place;
  warnings.push_back(
      make_warning(tree.file_of(first_place), tree.location_of(first_place),
                   std::to_string(count) + " round primitive" +
                       (count == 1 ? " is smooth" : "s are smooth; this is the first") +
                       ": more than " + std::to_string(kMostFacets) + " facets would be needed",
                   options.tolerance > 0 ? "give a larger --tolerance" : "give a smaller $fn"));
}

/// Parts of a hull are drawn beside it, or over it, as those of a group are.
void add_inner_parts(const Collector& collected, ResolvedModifiers& modifiers) {
  for (const Collector::WholeLeaf& leaf : collected.whole_leaves) {
    if (leaf.presence != Presence::kSolid) continue;
    const uint8_t own = leaf.inner_modifiers;
    if ((own & language::kBackgroundModifier) != 0) modifiers.background.push_back(leaf.node);
    if ((own & language::kHighlightModifier) != 0) modifiers.highlight.push_back(leaf.node);
  }
  std::sort(modifiers.background.begin(), modifiers.background.end());
  std::sort(modifiers.highlight.begin(), modifiers.highlight.end());
}

ResolvedModifiers modifiers_of(const NodeTree& tree, const Collector& collected,
                               PictureKind picture) {
  if (!collected.any_modifiers && collected.left_out.empty()) return {};
  std::vector<LeafState> leaves(tree.nodes.size());
  for (size_t i = 0; i < leaves.size(); ++i) {
    const uint32_t primitive = collected.primitive_of[i];
    if (primitive != kNone) leaves[i] = {Presence::kSolid, collected.boxes[primitive]};
  }
  for (const uint32_t node : collected.left_out) leaves[node].presence = Presence::kLeftOut;
  for (const Collector::WholeLeaf& leaf : collected.whole_leaves) {
    if (leaf.inner_modifiers == 0) leaves[leaf.node] = {leaf.presence, leaf.box, true};
  }
  ResolvedModifiers modifiers = resolve_modifiers(tree, collected.selected, leaves, picture);
  if (picture != PictureKind::kRendered) {
    add_inner_parts(collected, modifiers);
    return modifiers;
  }
  // Nothing is overlaid: `#` parts are operands like others.
  for (ResolvedNode& node : modifiers.nodes) node.highlighted = false;
  modifiers.background.clear();
  modifiers.highlight.clear();
  return modifiers;
}

/// Returns whether boxes decide about products: what is opaque needs none.
bool needs_layers(const Collector& collected, PictureKind picture) {
  const auto& primitives = collected.primitives;
  return picture == PictureKind::kThrownTogether || collected.any_modifiers ||
         std::any_of(primitives.begin(), primitives.end(),
                     [](const csgcore::Primitive& p) { return p.color && p.color->a < 1; });
}

/// Finds out whether the design is a plane figure, and sets the outlines of its final render.
void set_flat_outlines(const Collector& collected, PictureKind picture, ImportedDesign& design) {
  if (picture != PictureKind::kRendered) {
    const std::vector<bool> are_of_plates = collected.are_of_plates();
    const bool has_plates_alone = std::ranges::find(are_of_plates, false) == are_of_plates.end();
    design.is_plane_figure = has_plates_alone && !are_of_plates.empty();
    return;
  }
  std::vector<Figure> figures;
  for (const Collector::WholeLeaf& leaf : collected.whole_leaves) {
    figures.insert(figures.end(), leaf.figures.begin(), leaf.figures.end());
  }
  design.is_plane_figure = !figures.empty();
  const std::optional<SimplePolygons> outlines = united(figures);
  design.is_tangle = !outlines;
  for (const Polygon& polygon : outlines.value_or(SimplePolygons{})) {
    std::vector<csgcore::Vec3>& outline = design.flat_outlines.emplace_back();
    for (const Vec2& point : polygon) outline.emplace_back(point, 0.0);
  }
}

/// A leaf that several trees name counts once for each.
void count_leaves(const Design& trees, const Leaves& leaves, ImportedDesign& design) {
  for (const auto& [kind, tree] : trees.parts) {
    for (const csgcore::CsgToken& token : tree.tokens()) {
      if (!token.is_primitive) continue;
      ++design.leaves;
      if (leaves.is_compound(token.value)) ++design.compound_leaves;
    }
  }
}

/// Makes the design of what the collector holds, which it frees as soon as it can: of a large
/// design each part of it has hundreds of MB.
ImportedDesign finish_import(const DesignTree& tree, Collector& collected,
                             const ImportOptions& options, const std::stop_token& stop) {
  ImportedDesign design;
  design.warnings = collected.problems.warnings(tree);
  design.primitive_nodes = collected.primitive_nodes;
  design.places = std::move(collected.places);
  design.parts = assembly_parts(*tree.nodes, collected.selected, design.places);
  set_flat_outlines(collected, options.picture, design);

  merge_features(collected.primitives, collected.frame_of, collected.frames,
                 box_around(collected.boxes));
  if (options.keeps_frames) {
    design.turned_frames = turned_frames(collected.frames, collected.frame_of);
  }
  collected.frame_of = {};
  if (collected.compound_leaves.empty() && collected.whole_leaves.empty()) collected.frames = {};
  throw_if_stopped(stop);
  facet(tree, collected, options, design.warnings);
  design.meshes = collected.polyhedra.take_meshes();
  design.files = collected.files.paths();
  const std::vector<std::string>& fonts = collected.fonts.files();
  design.files.insert(design.files.end(), fonts.begin(), fonts.end());
  throw_if_stopped(stop);
  Leaves leaves(static_cast<uint32_t>(collected.primitives.size()));
  const ResolvedModifiers modifiers = modifiers_of(*tree.nodes, collected, options.picture);
  const GeometryDialect dialect(options.language);
  Design trees =
      Emitter(*tree.nodes, collected, modifiers, leaves, options.picture, dialect.keeps_colors)
          .design();
  count_leaves(trees, leaves, design);
  design.faceted_leaves = static_cast<uint32_t>(
      std::count_if(collected.whole_leaves.begin(), collected.whole_leaves.end(),
                    [](const Collector::WholeLeaf& leaf) { return leaf.is_faceted; }));
  design.left_out = static_cast<uint32_t>(collected.left_out.size());
  const bool decides = needs_layers(collected, options.picture);
  LeafBoxes boxes = boxes_of_leaves(collected, leaves, trees, options.measures_leaves, decides);
  const std::vector<Box> thick =
      boxes_of_thick_plates(dialect.figure_thickness, collected, leaves, boxes.seen);
  design.axes_reach = dialect.axes_reach;
  design.view_box = view_box(trees, thick.empty() ? boxes.seen : thick, dialect.intersects_boxes);
  if (!collected.whole_leaves.empty()) {
    thicken_cutting_plates(options.picture, trees, collected, leaves, boxes);
  }
  if (options.picture == PictureKind::kRendered && options.measures_leaves) {
    design.view_box = box_of_result(collected, leaves.expanded(trees.model()), design.view_box);
  }
  throw_if_stopped(stop);
  design.scene.primitives = std::move(collected.primitives);
  if (!compose(std::move(trees), leaves, decides ? boxes.deciding : boxes.seen, options.picture,
               dialect.keeps_colors, design.scene)) {
    design.warnings.push_back(make_warning(tree.name, {},
                                           "the translucent parts make more than " +
                                               std::to_string(kMostProducts) +
                                               " products: some show their nearest surfaces alone",
                                           "give color() an alpha within fewer operations"));
  }
  return design;
}

}  // namespace

ImportedDesign import_design(const DesignTree& tree, const ImportOptions& options,
                             const std::stop_token& stop) {
  const csgcore::StopScope scope(&stop);
  Collector collected(tree, options);
  collected.collect(stop);
  collected.finish(stop);
  return finish_import(tree, collected, options, stop);
}

}  // namespace frontend
