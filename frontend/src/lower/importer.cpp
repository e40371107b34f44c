#include "frontend/importer.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "csg/node_sink.hpp"
#include "frontend/stop.hpp"
#include "heal/healing.hpp"
#include "lower/collector.hpp"
#include "lower/import_view_box.hpp"
#include "lower/marks.hpp"
#include "lower/node_roles.hpp"

namespace frontend {
namespace {

using csgcore::Box;
using csgcore::CsgTree;
using csgcore::CsgTreeBuilder;
using csgcore::Op;

constexpr uint32_t kNone = Collector::kNoPrimitive;

Op operation_of(NodeKind kind) {
  if (kind == NodeKind::kDifference) return Op::kDifference;
  if (kind == NodeKind::kIntersection) return Op::kIntersection;
  return Op::kUnion;
}

/// Writes parts of the file as CSG trees.
class Emitter {
 public:
  Emitter(const SyntaxTree& tree, const std::vector<uint32_t>& primitive_of, const Marks& marks)
      : tree_(tree), primitive_of_(primitive_of), marks_(marks) {}

  CsgTree model(NodeRange selected) {
    emit(selected, kNone, marks_.keeps_highlighted);
    return builder_.finish();
  }

  CsgTree parts(std::span<const uint32_t> roots) {
    for (const uint32_t root : roots) {
      emit({root, tree_.nodes[root].subtree_end}, root, true);
    }
    return builder_.finish();
  }

 private:
  struct OpenNode {
    uint32_t end;
    bool keeps_highlighted;  // it is not a union, or all its operands are highlighted
    bool in_render;          // where `#` parts are operands like others
  };

  /// The nodes of the range as operands of a union. `root` is taken whatever its modifiers say.
  void emit(NodeRange range, uint32_t root, bool keeps_highlighted) {
    std::vector<OpenNode>& open = open_;
    open.assign(1, {kNone, keeps_highlighted, false});
    for (uint32_t i = range.begin; i < range.end;) {
      const SyntaxNode& node = tree_.nodes[i];
      while (open.back().end <= i) {
        builder_.close();
        open.pop_back();
      }
      if (i != root && !is_operand(i, open.back())) {
        i = node.subtree_end;
      } else if (primitive_of_[i] != kNone) {
        builder_.primitive(primitive_of_[i]);
        i = node.subtree_end;
      } else if (role_of(node.kind) != Role::kOperation || node.subtree_end == i + 1) {
        builder_.empty();
        i = node.subtree_end;
      } else {
        const Op op = operation_of(node.kind);
        builder_.open(op);
        open.push_back(
            {node.subtree_end,
             op != Op::kUnion || (!marks_.nodes.empty() && marks_.nodes[i].keeps_highlighted),
             open.back().in_render || node.kind == NodeKind::kRender});
        ++i;
      }
    }
    for (size_t k = 1; k < open.size(); ++k) builder_.close();
  }

  bool is_operand(uint32_t node, const OpenNode& parent) const {
    if (marks_.nodes.empty()) return true;
    const Mark& mark = marks_.nodes[node];
    if (mark.presence != Presence::kSolid && mark.presence != Presence::kEmpty) return false;
    return !mark.highlighted || parent.keeps_highlighted || parent.in_render;
  }

  const SyntaxTree& tree_;
  const std::vector<uint32_t>& primitive_of_;
  const Marks& marks_;
  CsgTreeBuilder builder_;
  std::vector<OpenNode> open_;
};

/// Healing is done by then: it knows axes and caps of what is round.
void facet(const SyntaxTree& tree, Collector& collected, std::vector<Warning>& warnings) {
  uint32_t count = 0;
  uint32_t first = kNone;  // primitive
  for (uint32_t i = 0; i < collected.primitives.size(); ++i) {
    const int fragments = collected.fragments[i];
    if (fragments == 0 || collected.polyhedra.facet(collected.primitives[i], fragments)) continue;
    if (count++ == 0) first = i;
  }
  if (count == 0) return;
  const auto node = std::find(collected.primitive_of.begin(), collected.primitive_of.end(), first);
  warnings.push_back(
      make_warning(tree.file_name, tree.nodes[node - collected.primitive_of.begin()].location,
                   std::to_string(count) + " round primitive" +
                       (count == 1 ? " is smooth" : "s are smooth; this is the first") +
                       ": more than " + std::to_string(kMostFacets) + " facets would be needed",
                   "give a smaller $fn"));
}

Marks marks_of(const SyntaxTree& tree, const Collector& collected) {
  if (!collected.any_modifiers && collected.left_out.empty()) return {};
  std::vector<Presence> leaves(tree.nodes.size(), Presence::kEmpty);
  for (size_t i = 0; i < leaves.size(); ++i) {
    if (collected.primitive_of[i] != kNone) leaves[i] = Presence::kSolid;
  }
  for (const uint32_t node : collected.left_out) leaves[node] = Presence::kLeftOut;
  return find_marks(tree, collected.selected, leaves);
}

/// Nothing is overlaid: `#` parts become operands like others.
void keep_solid_alone(Marks& marks) {
  for (Mark& mark : marks.nodes) mark.highlighted = false;
  marks.background.clear();
  marks.highlight.clear();
}

Box union_of(std::span<const Box> boxes) {
  Box result;
  for (const Box& box : boxes) result.merge(box);
  return result;
}

/// What comes after the last node was taken. Frees what the collector holds as soon as it can: of a
/// large design each part of it has hundreds of MB.
ImportedDesign finish_import(const SyntaxTree& tree, Collector& collected,
                             const ImportOptions& options, const std::stop_token& stop) {
  collected.finish();
  ImportedDesign design;
  design.warnings = collected.problems.warnings(tree.file_name);
  design.primitive_nodes = collected.primitive_nodes;
  design.places = std::move(collected.places);

  const std::vector<Box>& boxes = collected.boxes;
  merge_features(collected.primitives, collected.frame_of, collected.frames, union_of(boxes));
  collected.frames = {};
  collected.frame_of = {};
  throw_if_stopped(stop);
  facet(tree, collected, design.warnings);
  throw_if_stopped(stop);
  Marks marks = marks_of(tree, collected);
  if (options.rendered) keep_solid_alone(marks);
  Emitter emitter(tree, collected.primitive_of, marks);
  design.scene.model = emitter.model(collected.selected);
  design.scene.background = emitter.parts(marks.background);
  design.scene.highlight = emitter.parts(marks.highlight);
  design.scene.primitives = std::move(collected.primitives);
  for (const CsgTree* part :
       {&design.scene.model, &design.scene.background, &design.scene.highlight}) {
    design.view_box.merge(view_box(*part, boxes));
  }
  return design;
}

}  // namespace

ImportedDesign import_design(const SyntaxTree& tree, const ImportOptions& options,
                             const std::stop_token& stop) {
  ImportOptions without_places = options;
  without_places.keeps_places = false;
  Collector collected(tree, without_places);
  size_t solids = 0;
  size_t matrices = 0;
  for (const SyntaxNode& node : tree.nodes) {
    solids += role_of(node.kind) == Role::kSolid;
    matrices += node.kind == NodeKind::kMultmatrix;
  }
  collected.reserve(tree.nodes.size(), solids, matrices);
  for (uint32_t i = 0; i < tree.nodes.size(); ++i) {
    throw_if_stopped(stop);
    collected.take(i, 0);
  }
  return finish_import(tree, collected, options, stop);
}

struct TextImport::Impl {
  Impl(std::string file_name, const ImportOptions& import_options)
      : options(import_options), collector(tree, options) {
    tree.file_name = std::move(file_name);
  }

  const ImportOptions options;
  SyntaxTree tree;
  Collector collector;
};

TextImport::TextImport(std::string_view text, std::string file_name, const ImportOptions& options,
                       const std::stop_token& stop)
    : impl_(std::make_unique<Impl>(std::move(file_name), options)) {
  // About what OpenSCAD's files have, as the parser's own: growing copies.
  constexpr size_t kBytesPerNode = 48, kBytesPerLeaf = 128;
  const size_t leaves = text.size() / kBytesPerLeaf;
  impl_->collector.reserve(text.size() / kBytesPerNode, leaves, leaves);
  parse_nodes(text, impl_->tree, impl_->collector, stop);
}

TextImport::TextImport(TextImport&&) noexcept = default;
TextImport& TextImport::operator=(TextImport&&) noexcept = default;
TextImport::~TextImport() = default;

size_t TextImport::nodes() const { return impl_->tree.nodes.size(); }

ImportedDesign TextImport::finish(const std::stop_token& stop) {
  return finish_import(impl_->tree, impl_->collector, impl_->options, stop);
}

}  // namespace frontend
