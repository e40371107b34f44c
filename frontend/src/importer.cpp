#include "frontend/importer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "frames.hpp"
#include "frontend/stop.hpp"
#include "healing.hpp"
#include "import_arguments.hpp"
#include "import_polyhedra.hpp"
#include "import_view_box.hpp"
#include "marks.hpp"
#include "matrix_healing.hpp"

namespace frontend {
namespace {

using csgcore::Box;
using csgcore::Color;
using csgcore::CsgTree;
using csgcore::CsgTreeBuilder;
using csgcore::Op;
using csgcore::Primitive;

constexpr size_t kKinds = static_cast<size_t>(NodeKind::kRoof) + 1;
constexpr uint32_t kNone = 0xFFFFFFFFu;

enum class Role : uint8_t { kSolid, kOperation, kUnsupportedLeaf, kUnsupportedOperation };

Role role_of(NodeKind kind) {
  switch (kind) {
    case NodeKind::kSphere:
    case NodeKind::kCylinder:
    case NodeKind::kCube:
    case NodeKind::kPolyhedron:
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
    case NodeKind::kImport:
    case NodeKind::kSurface:
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

bool is_primitive_node(NodeKind kind) {
  const Role role = role_of(kind);
  return role == Role::kSolid || role == Role::kUnsupportedLeaf;
}

Op operation_of(NodeKind kind) {
  if (kind == NodeKind::kDifference) return Op::kDifference;
  if (kind == NodeKind::kIntersection) return Op::kIntersection;
  return Op::kUnion;
}

/// Without children and without a file to read (`file`, up to 2021) it makes nothing.
bool makes_nothing(const SyntaxTree& tree, const SyntaxNode& node, uint32_t index) {
  if (node.subtree_end > index + 1) return false;
  for (const Argument& argument : tree.arguments_of(node)) {
    if (argument.name == "file" && argument.value.kind == ValueKind::kString &&
        argument.value.count > 0) {
      return false;
    }
  }
  return true;
}

/// What a node hands down to its children.
struct Context {
  uint32_t end;    // the node's subtree_end
  uint32_t frame;  // coordinates
  std::optional<Color> color;
  bool flattened;  // a matrix with inf or nan on the way: nothing is left
};

/// The nodes of one kind that cannot be drawn.
struct Unsupported {
  uint32_t count = 0;
  uint32_t first = kNone;  // node
  std::string_view why;    // of the first; empty: no node of the kind can be

  void add(uint32_t node, std::string_view reason) {
    if (count++ > 0) return;
    first = node;
    why = reason;
  }
};

std::string_view why_not(Convexity convexity) {
  return convexity == Convexity::kTooLarge
             ? "it has too many faces"
             : "it is not the closed boundary of one convex solid, its faces plane and clockwise "
               "seen from outside";
}

/// From the tree to primitives in their frames.
class Collector {
 public:
  Collector(const SyntaxTree& tree, NodeRange selected, const ImportOptions& options)
      : tree_(tree), selected_(selected), options_(options) {
    primitive_of.assign(tree.nodes.size(), kNone);
  }

  void collect(const std::stop_token& stop) {
    reserve();
    contexts_.push_back({kNone, 0, std::nullopt, false});
    uint32_t skipped_until = 0;
    for (uint32_t i = 0; i < tree_.nodes.size(); ++i) {
      throw_if_stopped(stop);
      const SyntaxNode& node = tree_.nodes[i];
      const uint32_t id = primitive_nodes;
      if (is_primitive_node(node.kind)) ++primitive_nodes;
      if (i < skipped_until || i < selected_.begin || i >= selected_.end) continue;
      any_modifiers = any_modifiers || node.modifiers != 0;
      while (contexts_.back().end <= i) contexts_.pop_back();
      if ((node.modifiers & kDisable) != 0 || !visit(i, id)) skipped_until = node.subtree_end;
    }
  }

  std::vector<uint32_t> primitive_of;  // by node: index into `primitives`, or kNone
  std::vector<Primitive> primitives;
  std::vector<uint32_t> frame_of;  // by primitive
  std::vector<Box> boxes;          // by primitive, faceted
  std::vector<int> fragments;      // by primitive; 0: it is not to be faceted
  PolyhedronPool polyhedra;
  FrameTree frames;
  std::vector<uint32_t> left_out;  // nodes that cannot be drawn
  std::array<Unsupported, kKinds> unsupported;
  std::vector<Warning> warnings;
  uint32_t primitive_nodes = 0;
  bool any_modifiers = false;

 private:
  /// Growing by doubling would copy, and touch, twice the memory.
  void reserve() {
    size_t solids = 0;
    size_t matrices = 0;
    for (const SyntaxNode& node : tree_.nodes) {
      solids += role_of(node.kind) == Role::kSolid;
      matrices += node.kind == NodeKind::kMultmatrix;
    }
    primitives.reserve(solids);
    frame_of.reserve(solids);
    boxes.reserve(solids);
    fragments.reserve(solids);
    frames.reserve(matrices);
  }

  /// False: the children do not matter.
  bool visit(uint32_t index, uint32_t id) {
    const SyntaxNode& node = tree_.nodes[index];
    switch (role_of(node.kind)) {
      case Role::kSolid:
        add_solid(index, id);
        return false;
      case Role::kOperation:
        if (node.kind == NodeKind::kMultmatrix) enter_matrix(node);
        if (node.kind == NodeKind::kColor) enter_color(node);
        return true;
      case Role::kUnsupportedOperation:
        if (makes_nothing(tree_, node, index)) return false;
        break;
      case Role::kUnsupportedLeaf:
        break;
    }
    leave_out(index, "");
    return false;
  }

  void leave_out(uint32_t index, std::string_view reason) {
    unsupported[static_cast<size_t>(tree_.nodes[index].kind)].add(index, reason);
    left_out.push_back(index);
  }

  void enter_matrix(const SyntaxNode& node) {
    const FileMatrix file = read_matrix(tree_, node);
    if (is_identity(file)) return;
    Context context = contexts_.back();
    context.end = node.subtree_end;
    const csgcore::Affine divided{file.map.linear / file.divisor,
                                  file.map.translation / file.divisor};
    if (context.flattened || !divided.finite()) {
      context.flattened = true;
    } else {
      context.frame = frames.add(context.frame, heal(file));
    }
    contexts_.push_back(context);
  }

  static bool is_identity(const FileMatrix& file) {
    return file.divisor == 1 && file.map.linear == csgcore::Mat3(1.0) &&
           file.map.translation == csgcore::Vec3(0.0);
  }

  static HealedMatrix heal(const FileMatrix& file) {
    HealedMatrix matrix = heal_matrix(file.map);
    if (file.divisor != 1) {
      const double size = std::abs(file.divisor);
      matrix.map = {matrix.map.linear / file.divisor, matrix.map.translation / file.divisor};
      matrix.linear_error /= size;
      matrix.translation_error /= size;
    }
    return matrix;
  }

  void enter_color(const SyntaxNode& node) {
    const std::optional<Color> color = read_color(tree_, node, warnings);
    if (!color || options_.rendered) return;
    if (contexts_.back().color) return;  // the outermost valid one wins
    Context context = contexts_.back();
    context.end = node.subtree_end;
    context.color = color;
    contexts_.push_back(context);
  }

  void add_solid(uint32_t index, uint32_t id) {
    const SyntaxNode& node = tree_.nodes[index];
    const Context& context = contexts_.back();
    const csgcore::Affine& to_world = frames[context.frame].to_world;
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

  bool keeps_facets(const Primitive& primitive, const csgcore::FacetSettings& facets) const {
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

  const SyntaxTree& tree_;
  NodeRange selected_;
  const ImportOptions& options_;
  std::vector<Context> contexts_;
};

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

std::string counted(uint32_t count, NodeKind kind) {
  return std::to_string(count) + ' ' + std::string(name_of(kind));
}

[[noreturn]] void throw_unsupported(const SyntaxTree& tree, const Collector& collected) {
  std::string kinds;
  for (size_t i = 0; i < kKinds; ++i) {
    if (collected.unsupported[i].count == 0) continue;
    if (!kinds.empty()) kinds += ", ";
    kinds += counted(collected.unsupported[i].count, static_cast<NodeKind>(i));
  }
  const SyntaxNode& first = tree.nodes[collected.left_out.front()];
  const std::string why(collected.unsupported[static_cast<size_t>(first.kind)].why);
  throw Error(tree.file_name, first.location,
              std::string(name_of(first.kind)) + " cannot be drawn" +
                  (why.empty() ? "" : ", since " + why) + "; of all nodes " +
                  std::to_string(collected.left_out.size()) + " cannot: " + kinds,
              "--skip-unsupported draws the rest");
}

void warn_of_unsupported(const SyntaxTree& tree, const Collector& collected,
                         std::vector<Warning>& warnings) {
  for (size_t i = 0; i < kKinds; ++i) {
    const Unsupported& kind = collected.unsupported[i];
    if (kind.count == 0) continue;
    warnings.push_back(make_warning(
        tree.file_name, tree.nodes[kind.first].location,
        counted(kind.count, static_cast<NodeKind>(i)) +
            (kind.count == 1 ? " node is left out" : " nodes are left out; this is the first"),
        kind.why.empty() ? "it cannot be drawn" : std::string(kind.why)));
  }
}

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

Marks marks_of(const SyntaxTree& tree, NodeRange selected, const Collector& collected) {
  if (!collected.any_modifiers && collected.left_out.empty()) return {};
  std::vector<Presence> leaves(tree.nodes.size(), Presence::kEmpty);
  for (size_t i = 0; i < leaves.size(); ++i) {
    if (collected.primitive_of[i] != kNone) leaves[i] = Presence::kSolid;
  }
  for (const uint32_t node : collected.left_out) leaves[node] = Presence::kLeftOut;
  return find_marks(tree, selected, leaves);
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

}  // namespace

Location place_of_primitive(const SyntaxTree& tree, uint32_t id) {
  for (const SyntaxNode& node : tree.nodes) {
    if (is_primitive_node(node.kind) && id-- == 0) return node.location;
  }
  return {};
}

ImportedDesign import_design(const SyntaxTree& tree, const ImportOptions& options,
                             const std::stop_token& stop) {
  const NodeRange selected = selected_nodes(tree);
  Collector collected(tree, selected, options);
  collected.collect(stop);
  if (!collected.left_out.empty() && !options.skip_unsupported) throw_unsupported(tree, collected);

  ImportedDesign design;
  design.warnings = std::move(collected.warnings);
  warn_of_unsupported(tree, collected, design.warnings);
  design.primitive_nodes = collected.primitive_nodes;

  const std::vector<Box>& boxes = collected.boxes;
  merge_features(collected.primitives, collected.frame_of, collected.frames, union_of(boxes));
  throw_if_stopped(stop);
  facet(tree, collected, design.warnings);
  throw_if_stopped(stop);
  Marks marks = marks_of(tree, selected, collected);
  if (options.rendered) keep_solid_alone(marks);
  Emitter emitter(tree, collected.primitive_of, marks);
  design.scene.model = emitter.model(selected);
  design.scene.background = emitter.parts(marks.background);
  design.scene.highlight = emitter.parts(marks.highlight);
  design.scene.primitives = std::move(collected.primitives);
  for (const CsgTree* part :
       {&design.scene.model, &design.scene.background, &design.scene.highlight}) {
    design.view_box.merge(view_box(*part, boxes));
  }
  return design;
}

}  // namespace frontend
