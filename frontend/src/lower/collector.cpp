#include "lower/collector.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/elapsed.hpp"
#include "base/geometry_dialect.hpp"
#include "base/primitive_traits.hpp"
#include "csgcore/stop_scope.hpp"
#include "frontend/stop.hpp"
#include "hulls/point_hull.hpp"
#include "lower/typed_numbers.hpp"
#include "solids/faceted_box.hpp"
#include "solids/leaves.hpp"
#include "solids/solid_shape.hpp"
#include "subtrees/inner_parts.hpp"

namespace frontend {
namespace {

using csgcore::Affine;
using csgcore::Primitive;

constexpr std::string_view kBecauseTooLarge =
    "it is too large, or too far from the origin: scale the design to between 1e-90 and 1e90 "
    "across";
constexpr std::string_view kBecauseTooSmall =
    "it is too small: scale the design to between 1e-90 and 1e90 across";

constexpr double kLargestSize = 0x1p300;
static_assert(kLargestExponent == 300);

bool is_near(const csgcore::Vec3& point) {
  return std::abs(point.x) <= kLargestSize && std::abs(point.y) <= kLargestSize &&
         std::abs(point.z) <= kLargestSize;
}

enum class Fit : uint8_t { kFits, kTooLarge, kTooSmall, kFlat /* nothing is left of it */ };

/// Returns how a primitive fits into what can be drawn. Its shape is valid; the matrix may be any.
Fit fit_of(const Primitive& primitive) {
  const bool is_valid = csgcore::is_valid(primitive);
  const Affine& map = primitive.local_to_world;
  if (!is_valid && !map.finite()) return Fit::kTooLarge;
  const double size = size_of(primitive);
  if (size > kLargestSize || !is_near(map.translation)) return Fit::kTooLarge;
  if (size < 1 / kLargestSize) {
    return map.linear == csgcore::Mat3(0.0) ? Fit::kFlat : Fit::kTooSmall;
  }
  return is_valid ? Fit::kFits : Fit::kFlat;
}

/// Tells that a mesh is open: a hole in it shows what is behind it (csgcore/NUMERICS.md, "Meshes").
/// `file` is empty where the node lists the faces.
void note_open_mesh(const Node& node, const csgcore::TriangleMesh& mesh, const std::string& file,
                    NodeProblems& problems) {
  const uint64_t edges = mesh.open_edges();
  problems.add(node,
               {" is not closed: " + std::to_string(edges) + (edges == 1 ? " edge" : " edges") +
                    (file.empty() ? "" : " of '" + file + "'") + (edges == 1 ? " has" : " have") +
                    " a face on one side only",
                "it is drawn as thin sheets where a ray passes a hole"});
}

/// Tells that a body has no volume: OpenSCAD shows the faces of one that is closed.
void note_sheet(const Node& node, const std::string& file, NodeProblems& problems) {
  problems.add(node, {(file.empty() ? "" : ": '" + file + "'") + " has no volume",
                      "it is drawn as a thin sheet, and cuts nothing"});
}

/// Returns the faces of a polyhedron or a mesh under its matrix.
FaceSet flat_faces_of(const Primitive& primitive) {
  FaceSet faces;
  const auto add_all = [&](std::span<const csgcore::Vec3> vertices, const auto& triangles) {
    for (const csgcore::Vec3& vertex : vertices) {
      faces.points.push_back(primitive.local_to_world.point(vertex));
    }
    for (const auto& t : triangles) faces.corners.insert(faces.corners.end(), t.begin(), t.end());
  };
  if (primitive.mesh()) add_all(primitive.mesh()->vertices(), primitive.mesh()->triangles());
  if (primitive.polyhedron()) {
    const std::vector<csgcore::Vec3>& vertices = primitive.polyhedron()->vertices();
    add_all(vertices, point_hull(on_grid(vertices)).triangles);
  }
  return faces;
}

/// Returns by how much a node stretches its children, at most, as far as it tells. A revolution
/// and a roof count as 2: they have half of the tolerance, and their figures the other half.
double stretch_of(const NodeData& data) {
  if (const auto* matrix = std::get_if<FileMatrix>(&data)) {
    const double stretch = is_affine(*matrix) ? stretch_bound(heal(*matrix).map.linear) : 1;
    return stretch > 0 && std::isfinite(stretch) ? stretch : 1;
  }
  if (const auto* extrusion = std::get_if<LinearExtrudeNode>(&data)) {
    const Vec2& scale = extrusion->arguments.top_scale;
    return std::max({1.0, scale.x, scale.y});
  }
  const bool has_half =
      std::holds_alternative<RotateExtrudeNode>(data) || std::holds_alternative<RoofNode>(data);
  return has_half ? 2 : 1;
}

/// Returns whether the colours of nodes and of files count.
bool shows_colors(const ImportOptions& options) {
  return options.picture != PictureKind::kRendered || options.keeps_colors ||
         GeometryDialect(options.language).keeps_colors;
}

/// Tells that a part of a final render has another dimension than the first one.
void note_mixing(const Node& node, int dimension, NodeProblems& problems) {
  problems.add(node, {dimension == 2 ? ": Ignoring 2D child object for 3D operation"
                                     : ": Ignoring 3D child object for 2D operation",
                      "Mixing 2D and 3D objects is not supported: the first part is kept"});
}

}  // namespace

Collector::Collector(const DesignTree& tree, const ImportOptions& options)
    : polyhedra(options.keeps_meshes, options.picture == PictureKind::kThrownTogether),
      files(options.folder, polyhedra, shows_colors(options)),
      fonts(options.font_files),
      tree_(*tree.nodes),
      options_(options),
      keeps_colors_(GeometryDialect(options.language).keeps_colors),
      shows_colors_(shows_colors(options)),
      solids_(options.solids ? options.solids : std::make_shared<SolidPool>()),
      sources_{polyhedra, files, figure_solids_, *solids_} {
  contexts_.push_back({0, 0, std::nullopt, std::nullopt, false, false});
}

void Collector::collect(const std::stop_token& stop) {
  survey();
  for (uint32_t i = selected.begin; i < selected.end;) {
    throw_if_stopped(stop);
    while (contexts_.size() > 1 && !is_within(i, contexts_.back().node)) contexts_.pop_back();
    i = visit(i) ? i + 1 : tree_.nodes[i].end;
  }
}

/// Counts the nodes and makes room for them, since growing by doubling would copy, and touch, twice
/// the memory; and finds the subtree that `!` selects.
void Collector::survey() {
  const auto count = static_cast<uint32_t>(tree_.nodes.size());
  ids_.reserve(count + 1);
  size_t solids = 0, matrices = 0;
  for (uint32_t i = 0; i < count; ++i) {
    const Node& node = tree_.nodes[i];
    ids_.push_back(primitive_nodes);
    if (has_place(tree_, node)) {
      ++primitive_nodes;
      if (options_.keeps_places) places.push_back(i);
    }
    solids += row_of(node.kind).role == Role::kSolid;
    matrices += node.kind == NodeKind::kMultmatrix;
  }
  ids_.push_back(primitive_nodes);
  const std::optional<uint32_t> root = language::root_modifiers(tree_).shown;
  selected = root ? NodeRange{*root, tree_.nodes[*root].end, true} : NodeRange{0, count};
  for (uint32_t i = selected.begin; i < selected.end && !any_modifiers; ++i) {
    any_modifiers = modifiers_of(tree_, selected, i) != 0;
  }
  if (options_.tolerance > 0) find_stretches();
  primitive_of.assign(count, kNoPrimitive);
  primitives.reserve(solids);
  frame_of.reserve(solids);
  boxes.reserve(solids);
  fragments.reserve(solids);
  frames.reserve(matrices);
}

/// Finds by how much the nodes around each one stretch it, at most. What resize() stretches is not
/// known yet.
void Collector::find_stretches() {
  struct Open {
    uint32_t end;
    double stretch;
  };
  std::vector<Open> open = {{kNoPrimitive, 1}};
  NodeProblems told;  // when the node is taken
  stretches_.reserve(tree_.nodes.size());
  for (uint32_t i = 0; i < tree_.nodes.size(); ++i) {
    while (open.back().end <= i) open.pop_back();
    stretches_.push_back(open.back().stretch);
    const Node& node = tree_.nodes[i];
    if (node.end == i + 1) continue;
    NodeReader reader(tree_, node, told);
    const double own =
        row_of(node.kind).read == nullptr ? 1 : stretch_of(read_node(reader, {options_, fonts}));
    if (own != 1) open.push_back({node.end, open.back().stretch * own});
  }
}

NodeSources Collector::sources_of(uint32_t node) {
  return {options_, fonts, stretches_.empty() ? 1 : stretches_[node]};
}

void Collector::finish(const std::stop_token& stop) {
  add_pending(stop);
  std::ranges::sort(whole_leaves, {}, &WholeLeaf::node);
}

std::vector<bool> Collector::are_of_plates() const {
  std::vector<bool> result(primitives.size());
  for (const WholeLeaf& leaf : whole_leaves) {
    if (!leaf.is_plate) continue;
    for (const csgcore::CsgToken& token : leaf.solid.tokens()) {
      if (token.is_primitive) result[token.value] = true;
    }
  }
  return result;
}

/// Takes a node. Returns false if its children do not matter, or are taken already.
bool Collector::visit(uint32_t index) {
  const Node& node = tree_.nodes[index];
  if (is_of_either_dimension(index) && add_if_plane(index)) return false;
  if (contexts_.back().in_leaf && (node.modifiers & language::kBackgroundModifier) != 0) {
    leave_leaf(index);
  }
  const NodeRow& row = row_of(node.kind);
  switch (names_drawing(tree_, node) ? Role::kWhole : row.role) {
    case Role::kSolid:
      add_solid(index);
      return false;
    case Role::kOperation:
      if (node.kind == NodeKind::kMultmatrix || node.kind == NodeKind::kColor) enter(index);
      if (row.is_one_leaf && options_.picture != PictureKind::kRendered) enter_leaf(index);
      if (node.kind == NodeKind::kFill && has_children(index)) {
        problems.add(node, {": fill() not yet implemented for 3D", "it is drawn as a union"});
      }
      return true;
    case Role::kWhole:
      add_whole(index);
      return false;
  }
  return false;
}

void Collector::leave_out(uint32_t node, const std::string& why) {
  left_out.push_back(node);
  problems.add(tree_.nodes[node], {" is left out", why});
}

/// Enters a multmatrix or a color node.
void Collector::enter(uint32_t node) {
  NodeReader reader(tree_, tree_.nodes[node], problems);
  const NodeData data = read_node(reader, {options_, fonts});
  const auto* matrix = std::get_if<FileMatrix>(&data);
  if (matrix != nullptr ? is_identity(*matrix) : !shows_colors_) return;
  contexts_.push_back(within(contexts_.back(), data));
  contexts_.back().node = node;
}

Collector::Context Collector::within(Context around, const NodeData& node) {
  if (const auto* color = std::get_if<NodeColor>(&node)) {
    around.color = inner_color(around.color, *color);
    return around;
  }
  const auto& file = std::get<FileMatrix>(node);
  around.flattened = around.flattened || !is_affine(file);
  if (!around.flattened) around.frame = frames.add(around.frame, heal(file));
  return around;
}

void Collector::enter_leaf(uint32_t node) {
  if (contexts_.back().in_leaf) return;
  Context context = contexts_.back();
  context.node = node;
  context.in_leaf = true;
  context.leaf_color = context.color;
  compound_leaves.push_back({node, context.frame});
  contexts_.push_back(context);
}

/// Ends the compound leaf for a `%` part, which is drawn beside it.
void Collector::leave_leaf(uint32_t node) {
  Context context = contexts_.back();
  context.node = node;
  context.in_leaf = false;
  contexts_.push_back(context);
}

/// The node's solid, where its sheet stands for what has no volume. Nothing: it is the empty set,
/// or left out.
std::optional<SolidShape> Collector::read_solid(uint32_t index) {
  const Node& node = tree_.nodes[index];
  NodeReader reader(tree_, node, problems);
  std::optional<SolidShape> shape =
      solid_shape(read_node(reader, sources_of(index)), node, sources_, problems);
  if (!shape || shape->faces == nullptr) return shape;
  const SolidOfFaces& faces = *shape->faces;
  if (faces.is_empty()) {
    // Next to the largest coordinate the others are nothing.
    if (faces.exponent > kLargestExponent) leave_out(index, std::string(kBecauseTooLarge));
    return std::nullopt;
  }
  if (faces.sheet) {
    shape->primitive = faces.under(faces.sheet, {});
    note_sheet(node, shape->file, problems);
  } else if (faces.mesh && !faces.mesh->is_closed()) {
    note_open_mesh(node, *faces.mesh, shape->file, problems);
  }
  return shape;
}

void Collector::add_solid(uint32_t index) {
  const Context& context = contexts_.back();
  std::optional<SolidShape> shape = read_solid(index);
  if (!shape || context.flattened) return;
  auto& [primitive, facets, faces, file, color] = *shape;
  primitive.local_to_world = compose(frames[context.frame].to_world, primitive.local_to_world);
  uint32_t frame = context.frame;
  if (primitive.local_to_world.determinant() == 0 && fit_of(primitive) == Fit::kFlat) {
    if (!flatten(index, facets, primitive)) return;
    faces = nullptr;
    frame = 0;
  }
  primitive.id = ids_[index];
  if (faces != nullptr && faces->inner_faces && !context.in_leaf) {
    return add_sides(index, primitive, *faces, context);
  }
  const csgcore::Box box = faceted_box(primitive, facets);
  const int count = keeps_facets(options_, facets)
                        ? traits_of(primitive.shape()).fragments(primitive, facets)
                        : 0;
  primitive_of[index] =
      add_primitive(std::move(primitive), index, context, typed_frame(index, frame), box, count);
  if (primitive_of[index] == kNoPrimitive) return;
  if (!primitives.back().color) primitives.back().color = color;
  const bool is_inside_out =
      options_.picture == PictureKind::kThrownTogether && faces != nullptr && faces->is_inside_out;
  if (is_inside_out) primitives.back().color = kSeenFromWithin;
}

/// Makes a sheet in the world's coordinates of a solid that its matrix flattens, as OpenSCAD maps
/// its facets. Returns false if nothing is left.
bool Collector::flatten(uint32_t index, const csgcore::FacetSettings& facets,
                        Primitive& primitive) {
  const int count = traits_of(primitive.shape()).fragments(primitive, facets);
  const Affine to_world = std::exchange(primitive.local_to_world, {});
  if (count > 0) polyhedra.facet(primitive, count);
  primitive.local_to_world = compose(to_world, primitive.local_to_world);
  FaceSet faces = flat_faces_of(primitive);
  uint64_t unfinite_faces = 0;
  const SolidOfFaces& solid = polyhedra.solid(std::move(faces), unfinite_faces);
  if (!solid.sheet) return false;
  primitive = solid.under(solid.sheet, {});
  note_sheet(tree_.nodes[index], {}, problems);
  return true;
}

/// Returns the frame of a node's shape: that around it, or one within, which bears the errors of
/// its typed numbers.
uint32_t Collector::typed_frame(uint32_t node, uint32_t frame) {
  if (!tree_.has_all_digits) return frame;
  const HealedMatrix typed = typed_numbers(tree_, node);
  return typed.exact ? frame : frames.add(frame, typed);
}

Collector::Context Collector::typed_context(uint32_t node) {
  Context context = contexts_.back();
  context.frame = typed_frame(node, context.frame);
  return context;
}

/// Makes one leaf of the faces of a solid that are seen from outside, and of those that are not.
void Collector::add_sides(uint32_t node, const Primitive& solid, const SolidOfFaces& faces,
                          const Context& context) {
  const Affine& to_world = frames[context.frame].to_world;
  const csgcore::Box box = faceted_box(solid, {});
  csgcore::CsgTreeBuilder builder;
  for (const bool is_inner : {false, true}) {
    Primitive side = faces.under(is_inner ? faces.inner_faces : faces.outer_faces, to_world);
    side.id = solid.id;
    const uint32_t primitive = add_primitive(std::move(side), node, context, context.frame, box, 0);
    if (primitive == kNoPrimitive) return;
    if (is_inner) primitives.back().color = kSeenFromWithin;
    builder.primitive(primitive);
  }
  whole_leaves.push_back(
      {node, context.frame, Presence::kSolid, builder.finish(), box, false, box});
}

uint32_t Collector::add_primitive(Primitive primitive, uint32_t node, const Context& context,
                                  uint32_t frame, const csgcore::Box& box, int count) {
  switch (fit_of(primitive)) {
    case Fit::kFits:
      break;
    case Fit::kTooLarge:
      leave_out(node, std::string(kBecauseTooLarge));
      return kNoPrimitive;
    case Fit::kTooSmall:
      leave_out(node, std::string(kBecauseTooSmall));
      return kNoPrimitive;
    case Fit::kFlat:
      if (primitive.local_to_world.linear != csgcore::Mat3(0.0)) {
        problems.add(tree_.nodes[node], {" has no volume", "a matrix flattens it to nothing"});
      }
      return kNoPrimitive;
  }
  const NodeColor& around = context.in_leaf && !keeps_colors_ ? context.leaf_color : context.color;
  primitive.color = primitive.color ? inner_color(around, primitive.color) : around;
  boxes.push_back(box);
  fragments.push_back(count);
  frame_of.push_back(frame);
  primitives.push_back(std::move(primitive));
  return static_cast<uint32_t>(primitives.size()) - 1;
}

Subtree Collector::read_subtree(uint32_t root) {
  Subtree subtree(tree_, root);
  for (uint32_t i = root; i < tree_.nodes[root].end; ++i) {
    subtree.take(ids_[i], sources_of(i), files, problems);
  }
  // The leaf's primitives have the id of its first primitive node.
  const bool has_id = ids_[tree_.nodes[root].end] > ids_[root];
  if (options_.keeps_places && has_id) places[ids_[root]] = root;
  return subtree;
}

/// Adds a subtree of 2D nodes, or of an operation on solids, as one leaf.
void Collector::add_whole(uint32_t root) {
  const Subtree subtree = read_subtree(root);
  const Context context = typed_context(root);
  add_whole_leaf(subtree, root, context, problems);
  // Among solids a final render ignores a plane figure.
  WholeLeaf& leaf = whole_leaves.back();
  if (options_.picture == PictureKind::kRendered && leaf.is_plate) {
    leaf.presence = Presence::kEmpty;
    leaf.solid = {};
    leaf.figures.clear();
  }
  if (any_modifiers) add_inner_parts(subtree, context);
}

/// OpenSCAD's render() and fill() nodes, and in its final render all that stands at the top, is a
/// plane figure if its first child is one.
bool Collector::is_of_either_dimension(uint32_t node) {
  if (options_.picture != PictureKind::kRendered) {
    return row_of(tree_.nodes[node].kind).is_one_leaf && !contexts_.back().in_leaf;
  }
  if (node < top_node_end_) return false;
  top_node_end_ = tree_.nodes[node].end;
  return true;
}

int Collector::dimension_of(uint32_t root) const {
  for (uint32_t i = root; i < tree_.nodes[root].end;) {
    const Node& node = tree_.nodes[i];
    const NodeRow& row = row_of(node.kind);
    const bool is_background =
        (modifiers_of(tree_, selected, i) & language::kBackgroundModifier) != 0;
    if (is_background) {
      i = node.end;
      continue;
    }
    if (row.role == Role::kSolid && names_drawing(tree_, node)) return 2;
    if (row.dimension != 0) return row.dimension;
    ++i;
  }
  return 0;
}

/// Returns true, with no node left to visit, if the subtree is a plane figure, which is added as
/// one leaf, or is not kept.
bool Collector::add_if_plane(uint32_t root) {
  const int dimension = dimension_of(root);
  if (dimension != 0 && !keeps_dimension(root, dimension)) return true;
  if (dimension != 2) return false;
  add_whole_leaf(read_subtree(root), root, typed_context(root), problems);
  return true;
}

bool Collector::keeps_dimension(uint32_t root, int dimension) {
  if (options_.picture != PictureKind::kRendered) return true;
  if (rendered_dimension_ == 0) rendered_dimension_ = dimension;
  if (rendered_dimension_ == dimension) return true;
  note_mixing(tree_.nodes[root], dimension, problems);
  whole_leaves.push_back({root});
  return false;
}

void Collector::add_whole_leaf(const Subtree& subtree, uint32_t root, const Context& context,
                               NodeProblems& told) {
  WholeLeaf leaf{root, context.frame};
  leaf.presence = lower_subtree(subtree, context, told, leaf);
  whole_leaves.push_back(std::move(leaf));
}

/// Gives each part inside that is drawn by itself a leaf of its own.
void Collector::add_inner_parts(const Subtree& subtree, const Context& context) {
  if (context.in_leaf || options_.picture == PictureKind::kRendered) return;
  NodeProblems told;  // already
  for (const InnerPart& part : inner_parts(subtree)) {
    Context inner = context;
    for (const uint32_t node : part.around) inner = within(inner, subtree.data(node));
    add_whole_leaf(subtree, part.node, inner, told);
    whole_leaves.back().inner_modifiers = part.modifiers;
  }
}

/// Leaves nodes out that are not lowered; the rest is, as if they were not there.
Presence Collector::lower_subtree(const Subtree& subtree, const Context& context,
                                  NodeProblems& told, WholeLeaf& leaf) {
  SubtreeEvaluation evaluation(
      subtree, leaf.node, options_, sources_, told,
      [&](uint32_t node, std::string_view why) { leave_out(node, std::string(why)); });
  if (evaluation.presence(leaf.node) != Presence::kSolid) return evaluation.presence(leaf.node);
  if (context.flattened) return Presence::kEmpty;
  if (evaluation.is_solid()) {
    std::optional<SolidValue> value = evaluation.solid();
    if (!value) return Presence::kLeftOut;
    if (value->is_empty()) return Presence::kEmpty;
    pending_.push_back({whole_leaves.size(), context, subtree.id(leaf.node), primitives.size(),
                        std::move(*value)});
    return Presence::kSolid;
  }
  const bool is_rendered = options_.picture == PictureKind::kRendered;
  LoweredSubtree lowered =
      lower_figures(evaluation, is_rendered ? Plate::kFlat : Plate::kPreview, leaf.frame, frames);
  if (lowered.is_plate && is_rendered) leaf.figures = evaluation.figures(leaf.node);
  return take_lowered(std::move(lowered), context, leaf);
}

/// Makes the solids that were put off, and puts their primitives where their nodes stand among the
/// others.
void Collector::add_pending(const std::stop_token& stop) {
  std::vector<LoweredSubtree> lowered(pending_.size());
  const auto lower = [&](size_t begin, size_t end) {
    const csgcore::StopScope scope(&stop);
    for (size_t i = begin; i < end; ++i) {
      const uint32_t frame = pending_[i].context.frame;
      lowered[i] =
          lower_solid(pending_[i].value, frames[frame].to_world, frame, pending_[i].id, *solids_);
    }
  };
  // Fewer take less than the threads take to start.
  constexpr size_t kAtOnce = 8;
  if (pending_.size() <= kAtOnce) {
    lower(0, pending_.size());
  } else {
    tbb::parallel_for(tbb::blocked_range<size_t>(0, pending_.size(), kAtOnce),
                      [&](const auto& range) { lower(range.begin(), range.end()); });
  }
  solids_->end_version();
  if (pending_.empty()) return;
  const auto visit_lists = [this](const auto& visit) {
    visit(primitives);
    visit(boxes);
    visit(frame_of);
    visit(fragments);
  };
  size_t count = primitives.size();
  for (const LoweredSubtree& solid : lowered) count += solid.solid.parts.size();
  visit_lists([&](auto& list) { list.reserve(count); });
  const auto old_end = static_cast<uint32_t>(primitives.size());
  std::vector<uint32_t> order;  // the primitives, which are added at the end, as they are to stand
  order.reserve(count);
  const auto add = [&](uint32_t begin, size_t end) {
    for (uint32_t i = begin; i < end; ++i) order.push_back(i);
  };
  uint32_t next_old = 0;
  for (size_t i = 0; i < pending_.size(); ++i) {
    const auto first = static_cast<uint32_t>(primitives.size());
    WholeLeaf& leaf = whole_leaves[pending_[i].leaf];
    leaf.presence = take_lowered(std::exchange(lowered[i], {}), pending_[i].context, leaf);
    add(next_old, pending_[i].primitives_before);
    next_old = static_cast<uint32_t>(pending_[i].primitives_before);
    add(first, primitives.size());
  }
  add(next_old, old_end);
  visit_lists([&](auto& list) {
    auto ordered = std::exchange(list, {});
    list.reserve(order.size());
    for (const uint32_t from : order) list.push_back(std::move(ordered[from]));
  });
  std::vector<uint32_t> place(order.size());  // of each, where it has been
  for (uint32_t i = 0; i < order.size(); ++i) place[order[i]] = i;
  for (uint32_t& primitive : primitive_of) {
    if (primitive != kNoPrimitive) primitive = place[primitive];
  }
  for (WholeLeaf& leaf : whole_leaves) {
    leaf.solid = renamed(leaf.solid, [&](uint32_t primitive) { return place[primitive]; });
  }
}

Presence Collector::take_lowered(LoweredSubtree lowered, const Context& context, WholeLeaf& leaf) {
  leaf.is_plate = lowered.is_plate;
  leaf.is_faceted = std::ranges::any_of(lowered.solid.parts, &SolidPart::is_faceted);
  // OpenSCAD's final render resizes a solid with the marks of its cut faces.
  leaf.has_operations = lowered.has_operations;
  leaf.keeps_operations = options_.picture == PictureKind::kRendered && lowered.has_operations;
  csgcore::CsgTreeBuilder builder;
  rebuild(lowered.solid.tree.tokens(), builder, [&](csgcore::CsgTreeBuilder& to, uint32_t index) {
    SolidPart& part = lowered.solid.parts[index];
    part.primitive->color = part.color;
    const uint32_t primitive =
        add_primitive(std::move(*part.primitive), leaf.node, context, part.frame, part.box, 0);
    if (primitive == kNoPrimitive) return to.empty();
    to.primitive(primitive);
  });
  leaf.solid = builder.finish();
  if (leaf.solid.empty()) return Presence::kEmpty;
  leaf.box = box_of_positive_leaves(leaf.solid, boxes);
  if (lowered.box) {
    leaf.box = lowered.is_union ? *lowered.box : csgcore::intersection(leaf.box, *lowered.box);
  }
  if (lowered.box || lowered.is_plate) leaf.known_box = leaf.box;
  return Presence::kSolid;
}

}  // namespace frontend
