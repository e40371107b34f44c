#include "csgcore/subdivision.hpp"

#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <glm/common.hpp>
#include <memory>
#include <mutex>
#include <utility>

#include "restriction.hpp"
#include "split.hpp"

namespace csgcore {
namespace {

/// Every cell's function is valid this far beyond the cell, as a fraction of the root box's largest
/// side: 16 times the rounding (2^-24) of a float coordinate in the model's own units, which is how
/// far a renderer in float may misplace a cell's boundary.
constexpr double kOverlap = 0x1p-20;

/// A cell whose longest side is below this many overlaps is not divided further.
constexpr double kSmallestCellOverlaps = 16;

/// A cell in whose ancestors' last so many divisions not one primitive left is not divided further:
/// by then it has an eighth of the size along every axis, so that what still crosses it coincides
/// with, or meets, the rest there (CSG: paper, figure 2). With a pixel threshold the paper's own
/// rule (case 4) ends such cells instead.
constexpr uint32_t kStalledDivisions = 9;

/// Lists longer than this are divided as two tasks. A property of the data alone, so that the result
/// is the same for every number of threads.
constexpr uint32_t kTaskLiterals = 256;

/// What one task produces; indices are local to it.
struct Chunk {
  std::vector<KdNode> nodes;
  std::vector<Leaf> leaves;
  std::vector<Literal> literals;
};

/// Either a chunk, or a division whose two sides are parts of their own.
struct Part {
  Split split{KdNode::kLeafAxis, 0};
  std::unique_ptr<Part> below, above;
  Chunk chunk;
};

struct Cell {
  Box box;
  uint32_t depth = 0;
  uint32_t stalled = 0;  // divisions since a primitive last left
};

uint32_t distinct_primitives(std::span<const Literal> literals) {
  std::vector<uint32_t> indices;
  for (const Literal& literal : literals) indices.push_back(literal.primitive);
  std::sort(indices.begin(), indices.end());
  return static_cast<uint32_t>(std::unique(indices.begin(), indices.end()) - indices.begin());
}

class Builder {
 public:
  Builder(const Solid& solid, const SubdivisionOptions& options, double overlap,
          const BatchSink& sink)
      : solid_(solid), options_(options), overlap_(overlap), sink_(sink) {
    const auto& literals = solid.list().literals;
    repeats_ = distinct_primitives(literals) < literals.size();
  }

  /// `list` is valid in the cell and irreducible there.
  std::unique_ptr<Part> build(const Cell& cell, std::span<const Literal> list) {
    auto part = std::make_unique<Part>();
    if (list.size() <= kTaskLiterals || leaf_kind(cell, list) != LeafKind::kEmpty) {
      build_chunk(cell, list, part->chunk);
      return part;
    }
    part->split = choose_split(cell, list);
    const auto side = [&](bool above) {
      const Cell child = child_of(cell, part->split, above);
      std::vector<Literal> restricted;
      Restrictor restrictor(solid_.primitives());
      const uint32_t count = restrictor.restrict(list, inflated(child.box), restricted);
      if (count >= kListFalse) {
        auto leaf = std::make_unique<Part>();
        add_leaf(child, {}, count == kListTrue, LeafKind::kEmpty, leaf->chunk);
        return leaf;
      }
      return build(advanced(child, list.size(), count), restricted);
    };
    if (parallel()) {
      tbb::parallel_invoke([&] { part->below = side(false); }, [&] { part->above = side(true); });
    } else {
      part->below = side(false);
      part->above = side(true);
    }
    return part;
  }

  Box inflated(const Box& box) const { return {box.min - overlap_, box.max + overlap_}; }

 private:
  bool parallel() const { return options_.threads != 1; }

  /// The paper's conditions (§2.2), generalised by K; kEmpty: none holds, the cell is divided.
  LeafKind leaf_kind(const Cell& cell, std::span<const Literal> list) const {
    const size_t distinct =
        repeats_ && list.size() > options_.leaf_primitives ? distinct_primitives(list) : list.size();
    const bool is_union_cell =
        (options_.stop_at_unions || list.size() <= options_.leaf_primitives) && is_union(list);
    if (is_union_cell) return LeafKind::kUnion;
    if (distinct <= options_.leaf_primitives) {
      return list.size() == 2 ? LeafKind::kPair : LeafKind::kGeneral;
    }
    if (options_.threshold_px > 0 &&
        projected_size_px(*options_.view, cell.box) < options_.threshold_px) {
      return LeafKind::kDropped;
    }
    const Vec3 size = cell.box.size();
    const bool smallest =
        std::max({size.x, size.y, size.z}) < kSmallestCellOverlaps * overlap_;
    const bool stalled = options_.threshold_px <= 0 && cell.stalled >= kStalledDivisions;
    return smallest || stalled ? LeafKind::kFull : LeafKind::kEmpty;
  }

  Split choose_split(const Cell& cell, std::span<const Literal> list) const {
    return options_.split == SplitRule::kCyclic
               ? cyclic_split(cell.box, cell.depth)
               : surface_area_split(solid_.primitives(), list, cell.box);
  }

  static Cell child_of(const Cell& cell, const Split& split, bool above) {
    Cell child = cell;
    (above ? child.box.min : child.box.max)[split.axis] = split.position;
    ++child.depth;
    return child;
  }

  static Cell advanced(Cell child, size_t parent_count, size_t count) {
    child.stalled = count < parent_count ? 0 : child.stalled + 1;
    return child;
  }

  static void add_leaf(const Cell& cell, std::span<const Literal> list, bool solid, LeafKind kind,
                       Chunk& chunk) {
    chunk.nodes.push_back({0, KdNode::kLeafAxis, static_cast<uint32_t>(chunk.leaves.size()), 0});
    chunk.leaves.push_back({cell.box, chunk.literals.size(), static_cast<uint32_t>(list.size()),
                            kind, solid});
    chunk.literals.insert(chunk.literals.end(), list.begin(), list.end());
  }

  void build_chunk(const Cell& cell, std::span<const Literal> list, Chunk& chunk) {
    Restrictor restrictor(solid_.primitives());
    ListStack lists;
    divide(cell, list, 0, restrictor, lists, chunk);
    if (sink_) {
      const std::lock_guard lock(sink_mutex_);
      sink_({chunk.leaves, chunk.literals});
    }
  }

  /// One list per level of the recursion, reused by all cells of that level.
  using ListStack = std::vector<std::vector<Literal>>;

  /// Recursion is bounded: every third division halves the cell's longest side at least, down to
  /// kSmallestCellOverlaps.
  void divide(const Cell& cell, std::span<const Literal> list, size_t level, Restrictor& restrictor,
              ListStack& lists, Chunk& chunk) {
    const LeafKind kind = leaf_kind(cell, list);
    if (kind != LeafKind::kEmpty) {
      add_leaf(cell, list, false, kind, chunk);
      return;
    }
    if (lists.size() <= level) lists.emplace_back();
    const Split split = choose_split(cell, list);
    const size_t node = chunk.nodes.size();
    chunk.nodes.push_back({split.position, split.axis, 0, 0});
    for (const bool above : {false, true}) {
      const uint32_t index = static_cast<uint32_t>(chunk.nodes.size());
      (above ? chunk.nodes[node].above : chunk.nodes[node].below) = index;
      const Cell child = child_of(cell, split, above);
      lists[level].clear();
      const uint32_t count = restrictor.restrict(list, inflated(child.box), lists[level]);
      if (count >= kListFalse) {
        add_leaf(child, {}, count == kListTrue, LeafKind::kEmpty, chunk);
      } else {
        // `lists` may grow below this level, which moves the vectors but not what they hold.
        divide(advanced(child, list.size(), count), std::span(lists[level].data(), count),
               level + 1, restrictor, lists, chunk);
      }
    }
  }

  const Solid& solid_;
  const SubdivisionOptions& options_;
  double overlap_;
  const BatchSink& sink_;
  std::mutex sink_mutex_;
  bool repeats_ = false;
};

/// Concatenates the parts' chunks in the order of the tree.
class Assembler {
 public:
  Assembler(std::vector<KdNode>& nodes, std::vector<Leaf>& leaves, std::vector<Literal>& literals)
      : nodes_(nodes), leaves_(leaves), literals_(literals) {}

  /// Appends the part and returns the index of its root.
  uint32_t append(const Part& part) {
    const uint32_t root = static_cast<uint32_t>(nodes_.size());
    if (part.split.axis == KdNode::kLeafAxis) {
      append_chunk(part.chunk);
      return root;
    }
    nodes_.push_back({part.split.position, part.split.axis, 0, 0});
    const uint32_t below = append(*part.below);
    const uint32_t above = append(*part.above);
    nodes_[root].below = below;
    nodes_[root].above = above;
    return root;
  }

 private:
  void append_chunk(const Chunk& chunk) {
    const uint32_t node_base = static_cast<uint32_t>(nodes_.size());
    const uint32_t leaf_base = static_cast<uint32_t>(leaves_.size());
    const uint64_t literal_base = literals_.size();
    for (KdNode node : chunk.nodes) {
      const bool is_leaf = node.axis == KdNode::kLeafAxis;
      node.below += is_leaf ? leaf_base : node_base;
      node.above += is_leaf ? 0 : node_base;
      nodes_.push_back(node);
    }
    for (Leaf leaf : chunk.leaves) {
      leaf.first_literal += literal_base;
      leaves_.push_back(leaf);
    }
    literals_.insert(literals_.end(), chunk.literals.begin(), chunk.literals.end());
  }

  std::vector<KdNode>& nodes_;
  std::vector<Leaf>& leaves_;
  std::vector<Literal>& literals_;
};

std::unique_ptr<Part> build_with_threads(Builder& builder, unsigned threads, const Cell& cell,
                                         std::span<const Literal> list) {
  // Small scenes don't start the thread pool.
  if (threads == 1 || list.size() <= kTaskLiterals) return builder.build(cell, list);
  tbb::task_arena arena(threads == 0 ? tbb::task_arena::automatic : static_cast<int>(threads));
  return arena.execute([&] { return builder.build(cell, list); });
}

}  // namespace

SubdivisionOptions SubdivisionOptions::paper(double threshold_px, const View& view) {
  SubdivisionOptions options;
  options.leaf_primitives = 2;
  options.stop_at_unions = true;
  options.threshold_px = threshold_px;
  options.view = view;
  options.split = SplitRule::kCyclic;
  return options;
}

Subdivision::Subdivision(const Solid& solid, SubdivisionOptions options, const BatchSink& sink)
    : solid_(&solid), options_(std::move(options)) {
  const Box& bounds = solid.bounds();
  if (bounds.empty() || solid.list().literals.empty()) return;
  const Vec3 size = bounds.size();
  overlap_ = kOverlap * std::max({size.x, size.y, size.z});
  root_box_ = {bounds.min - overlap_, bounds.max + overlap_};
  Builder builder(solid, options_, overlap_, sink);

  std::vector<Literal> list;
  Restrictor restrictor(solid.primitives());
  const Cell root{root_box_};
  const uint32_t count =
      restrictor.restrict(solid.list().literals, builder.inflated(root_box_), list);
  if (count >= kListFalse) {
    nodes_.push_back({});
    leaves_.push_back({root_box_, 0, 0, LeafKind::kEmpty, count == kListTrue});
    return;
  }
  const auto part = build_with_threads(builder, options_.threads, root, list);
  Assembler(nodes_, leaves_, literals_).append(*part);
}

size_t Subdivision::bytes() const {
  return nodes_.size() * sizeof(KdNode) + leaves_.size() * sizeof(Leaf) +
         literals_.size() * sizeof(Literal);
}

bool Subdivision::refine(const View& view) {
  if (options_.threshold_px <= 0) return false;
  options_.view = view;
  bool changed = false;
  const BatchSink no_sink;
  Builder builder(*solid_, options_, overlap_, no_sink);
  struct Visit {
    uint32_t node, depth;
  };
  std::vector<Visit> stack;
  if (!nodes_.empty()) stack.push_back({0, 0});
  while (!stack.empty()) {
    const Visit visit = stack.back();
    stack.pop_back();
    const KdNode node = nodes_[visit.node];
    if (node.axis != KdNode::kLeafAxis) {
      stack.push_back({node.above, visit.depth + 1});
      stack.push_back({node.below, visit.depth + 1});
      continue;
    }
    Leaf& leaf = leaves_[node.below];
    if (leaf.kind != LeafKind::kDropped ||
        projected_size_px(view, leaf.box) < options_.threshold_px) {
      continue;
    }
    const auto own = literals_of(leaf);
    const std::vector<Literal> list(own.begin(), own.end());
    const Cell cell{leaf.box, visit.depth};
    leaf.kind = LeafKind::kRefined;
    const auto part = builder.build(cell, list);
    const uint32_t root = Assembler(nodes_, leaves_, literals_).append(*part);
    nodes_[visit.node] = nodes_[root];
    changed = true;
  }
  return changed;
}

const Leaf* Subdivision::find(const Vec3& point) const {
  if (nodes_.empty()) return nullptr;
  for (int axis = 0; axis < 3; ++axis) {
    if (!(point[axis] >= root_box_.min[axis] && point[axis] <= root_box_.max[axis])) return nullptr;
  }
  uint32_t i = 0;
  while (nodes_[i].axis != KdNode::kLeafAxis) {
    i = point[static_cast<int>(nodes_[i].axis)] < nodes_[i].split ? nodes_[i].below
                                                                  : nodes_[i].above;
  }
  return &leaves_[nodes_[i].below];
}

uint64_t LeafCensus::leaves() const {
  uint64_t sum = 0;
  for (size_t kind = 0; kind < kLeafKinds; ++kind) {
    if (kind != static_cast<size_t>(LeafKind::kRefined)) sum += by_kind[kind];
  }
  return sum;
}

LeafCensus census(const Subdivision& subdivision) {
  LeafCensus result;
  for (const Leaf& leaf : subdivision.leaves()) {
    ++result.by_kind[static_cast<size_t>(leaf.kind)];
    if (leaf.kind != LeafKind::kRefined && leaf.kind != LeafKind::kEmpty) {
      result.literals += leaf.literal_count;
    }
  }
  return result;
}

}  // namespace csgcore
