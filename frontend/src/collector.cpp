#include "collector.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "import_arguments.hpp"
#include "import_view_box.hpp"
#include "node_roles.hpp"

namespace frontend {
namespace {

using csgcore::Affine;
using csgcore::Primitive;

bool is_identity(const FileMatrix& file) {
  return file.divisor == 1 && file.map.linear == csgcore::Mat3(1.0) &&
         file.map.translation == csgcore::Vec3(0.0);
}

HealedMatrix heal(const FileMatrix& file) {
  HealedMatrix matrix = heal_matrix(file.map);
  if (file.divisor != 1) {
    const double size = std::abs(file.divisor);
    matrix.map = {matrix.map.linear / file.divisor, matrix.map.translation / file.divisor};
    matrix.linear_error /= size;
    matrix.translation_error /= size;
  }
  return matrix;
}

/// A file to read (`file`, up to 2021) makes something of a node without children.
bool names_file(const SyntaxTree& tree, const SyntaxNode& node) {
  const auto arguments = tree.arguments_of(node);
  return std::any_of(arguments.begin(), arguments.end(), [](const Argument& argument) {
    return argument.name == "file" && argument.value.kind == ValueKind::kString &&
           argument.value.count > 0;
  });
}

std::string_view why_not(Convexity convexity) {
  return convexity == Convexity::kTooLarge
             ? "it has too many faces"
             : "it is not the closed boundary of one convex solid, its faces plane and clockwise "
               "seen from outside";
}

}  // namespace

Collector::Collector(const SyntaxTree& tree, const ImportOptions& options)
    : tree_(tree), options_(options) {
  contexts_.push_back({0, 0, std::nullopt, false});
}

void Collector::reserve(size_t nodes, size_t solids, size_t matrices) {
  primitive_of.reserve(nodes);
  primitives.reserve(solids);
  frame_of.reserve(solids);
  boxes.reserve(solids);
  fragments.reserve(solids);
  frames.reserve(matrices);
}

void Collector::take(uint32_t index) {
  const SyntaxNode& node = tree_.nodes[index];
  primitive_of.push_back(kNoPrimitive);
  const uint32_t id = primitive_nodes;
  if (is_primitive_node(node.kind)) ++primitive_nodes;
  if (root_ && !is_within(index, *root_)) return;
  if (disabled_ && is_within(index, *disabled_)) return;
  const bool is_disabled = (node.modifiers & kDisable) != 0;
  if (is_disabled) disabled_ = index;
  if (!root_ && !is_disabled && (node.modifiers & kRoot) != 0) select(index);
  if (error_ || (skipped_ && is_within(index, *skipped_))) return;
  any_modifiers = any_modifiers || node.modifiers != 0;
  while (contexts_.size() > 1 && !is_within(index, contexts_.back().node)) contexts_.pop_back();
  try {
    if (is_disabled || !visit(index, id)) skipped_ = index;
  } catch (Error& error) {
    error_ = std::move(error);
  }
}

void Collector::finish() {
  if (error_) throw std::move(*error_);
  const auto count = static_cast<uint32_t>(tree_.nodes.size());
  selected = root_ ? NodeRange{*root_, tree_.nodes[*root_].subtree_end} : NodeRange{0, count};
  for (const LeftOut& out : maybe_left_out_) {
    const SyntaxNode& node = tree_.nodes[out.node];
    if (out.unless_empty && node.subtree_end == out.node + 1) continue;
    left_out.push_back(out.node);
    Unsupported& kind = unsupported[static_cast<size_t>(node.kind)];
    if (kind.count++ == 0) kind = {1, out.node, out.why};
  }
  maybe_left_out_ = {};
}

/// Nothing counts but the subtree, and that as if it stood alone.
void Collector::select(uint32_t root) {
  root_ = root;
  std::fill(primitive_of.begin(), primitive_of.end(), kNoPrimitive);
  primitives.clear();
  frame_of.clear();
  boxes.clear();
  fragments.clear();
  frames = {};
  warnings.clear();
  any_modifiers = false;
  contexts_.resize(1);
  skipped_.reset();
  maybe_left_out_.clear();
  error_.reset();
}

/// False: the children do not matter.
bool Collector::visit(uint32_t index, uint32_t id) {
  const SyntaxNode& node = tree_.nodes[index];
  switch (role_of(node.kind)) {
    case Role::kSolid:
      add_solid(index, id);
      return false;
    case Role::kOperation:
      if (node.kind == NodeKind::kMultmatrix) enter_matrix(index);
      if (node.kind == NodeKind::kColor) enter_color(index);
      return true;
    case Role::kUnsupportedOperation:
      leave_out(index, "", !names_file(tree_, node));
      return false;
    case Role::kUnsupportedLeaf:
      break;
  }
  leave_out(index, "");
  return false;
}

void Collector::leave_out(uint32_t node, std::string_view why, bool unless_empty) {
  maybe_left_out_.push_back({node, unless_empty, why});
}

void Collector::enter_matrix(uint32_t node) {
  const FileMatrix file = read_matrix(tree_, tree_.nodes[node]);
  if (is_identity(file)) return;
  Context context = contexts_.back();
  context.node = node;
  const Affine divided{file.map.linear / file.divisor, file.map.translation / file.divisor};
  if (context.flattened || !divided.finite()) {
    context.flattened = true;
  } else {
    context.frame = frames.add(context.frame, heal(file));
  }
  contexts_.push_back(context);
}

void Collector::enter_color(uint32_t node) {
  const std::optional<csgcore::Color> color = read_color(tree_, tree_.nodes[node], warnings);
  if (!color || options_.rendered) return;
  if (contexts_.back().color) return;  // the outermost valid one wins
  Context context = contexts_.back();
  context.node = node;
  context.color = color;
  contexts_.push_back(context);
}

void Collector::add_solid(uint32_t index, uint32_t id) {
  const SyntaxNode& node = tree_.nodes[index];
  const Context& context = contexts_.back();
  const Affine& to_world = frames[context.frame].to_world;
  Primitive primitive;
  csgcore::FacetSettings facets;
  if (node.kind == NodeKind::kCube) {
    primitive = polyhedra.box(read_cube(tree_, node), to_world);
  } else if (node.kind == NodeKind::kPolyhedron) {
    const PolyhedronArguments arguments = read_polyhedron(tree_, node);
    const Convexity convexity = polyhedra.convex(arguments, to_world, primitive);
    if (convexity == Convexity::kNothing || context.flattened) return;
    if (convexity != Convexity::kConvex) return leave_out(index, why_not(convexity));
  } else {
    RoundPrimitive round = read_round_primitive(tree_, node);
    primitive = std::move(round.primitive);
    primitive.local_to_world = to_world;
    facets = round.facets;
    if (options_.fn) facets.fn = *options_.fn;
  }
  primitive.color = context.color;
  primitive.id = id;
  if (context.flattened || !csgcore::is_valid(primitive)) return;
  primitive_of[index] = static_cast<uint32_t>(primitives.size());
  boxes.push_back(faceted_box(primitive, facets));
  fragments.push_back(keeps_facets(primitive, facets) ? fragment_count(primitive, facets) : 0);
  frame_of.push_back(context.frame);
  primitives.push_back(std::move(primitive));
}

bool Collector::keeps_facets(const Primitive& primitive,
                             const csgcore::FacetSettings& facets) const {
  if (primitive.shape == csgcore::Shape::kPolyhedron) return false;
  switch (options_.facets) {
    case Facets::kNone:
      return false;
    case Facets::kFew:
      return facets.fn > 0 && facets.fn <= options_.few_fragments;
    case Facets::kAll:
      return true;
  }
  return false;
}

}  // namespace frontend
