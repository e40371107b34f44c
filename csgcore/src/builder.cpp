#include "builder.hpp"

#include <tbb/global_control.h>
#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <thread>
#include <utility>

namespace csgcore {
namespace {

/// A cell whose longest side is below this many overlaps is not divided further.
constexpr double kSmallestCellOverlaps = 16;

/// A cell in whose ancestors' last so many divisions not one primitive left, and hardly any empty
/// space was cut off, is not divided further: what still crosses it coincides with, or meets, the
/// rest there (paper, figure 2). With a pixel threshold the paper's own rule (case 4) ends the
/// cells where surfaces meet in a point, which one half of each division contains. Surfaces that
/// coincide over a face stand in both halves; such cells end here under every rule, as else the
/// whole face would be dropped.
constexpr uint32_t kStalledDivisions = 9;
/// Where it is the view that never ends a division (at the eye), coincident surfaces end after so
/// many of which both halves kept every primitive.
constexpr uint32_t kCoincidentDivisions = 14;
/// A cell below the threshold is asked whether its surfaces coincide if so many divisions in a row
/// have repeated them all. If so, all of them cross at least n² of n³ smaller cells; surfaces that
/// meet in a point or along a curve cross about n or fewer.
constexpr uint32_t kSuspectDivisions = 4;

/// Dividing a cell repeats the primitives that cross both halves. The leaves may hold so many
/// literals for each of the solid's, and this many in any case; a cell whose share is used up is
/// not divided further. It bounds memory and time where surfaces lie so close that dividing hardly
/// separates them (a thousand nested shells). CSn and CCn need 3 to 6 for each at K = 8, and 70 to
/// 120 by the paper's rule.
constexpr double kLiteralsPerLiteral = 128;
constexpr double kLiteralsInAnyCase = 0x1p18;
/// With a pixel threshold, which bounds the number of cells, lists this short go on all the same:
/// so short are they where surfaces meet in points, whose cells the paper's rule alone ends.
constexpr uint32_t kFewLiterals = 32;

/// Lists longer than this are divided as two tasks. A property of the data alone, so that the
/// result is the same for every number of threads.
constexpr uint32_t kTaskLiterals = 256;

bool has_repeats(std::span<const Literal> literals, size_t primitives) {
  std::vector<bool> seen(primitives);
  for (const Literal& literal : literals) {
    if (seen[literal.primitive]) return true;
    seen[literal.primitive] = true;
  }
  return false;
}

/// Whether the list has at most `limit` distinct primitives. `seen` is working memory.
bool has_at_most(uint32_t limit, const CellList& list, std::vector<uint32_t>& seen) {
  seen.clear();
  for (const uint32_t primitive : list.primitives()) {
    const uint32_t index = primitive & kPrimitiveBits;
    if (std::find(seen.begin(), seen.end(), index) != seen.end()) continue;
    if (seen.size() == limit) return false;
    seen.push_back(index);
  }
  return true;
}

Cell child_of(const Cell& cell, const Split& split, bool above) {
  Cell child = cell;
  (above ? child.box.min : child.box.max)[static_cast<int>(split.axis)] = split.position;
  ++child.depth;
  return child;
}

/// One half of a divided cell; `count` literals were divided into `halves`.
Cell child_of(const Cell& cell, const Split& split, bool above, uint32_t count,
              const CellList (&halves)[2]) {
  Cell child = child_of(cell, split, above);
  const CellList& other = halves[!above];
  if (halves[above].count() < count) {
    child.stalled = child.doubled = 0;
  } else {
    // Cutting off more than half of the cell as empty space is progress too.
    const int axis = static_cast<int>(split.axis);
    const bool halved = child.box.size()[axis] >= 0.5 * cell.box.size()[axis];
    if (!other.is_constant() || halved) ++child.stalled;
    if (!other.is_constant()) child.doubled = other.count() == count ? cell.doubled + 1 : 0;
  }
  const double sum = static_cast<double>(halves[0].count()) + halves[1].count();
  if (sum > 0) child.allowance = cell.allowance * count / sum;
  return child;
}

void add_leaf(const Cell& cell, const CellList& list, LeafKind kind, Chunk& chunk) {
  chunk.nodes.push_back({0, KdNode::kLeafAxis, static_cast<uint32_t>(chunk.leaves.size()), 0});
  chunk.leaves.push_back(
      {cell.box, chunk.literals.size(), list.count(), kind, list.root == CellList::kTrue});
  append(chunk.literals, list);
}

}  // namespace

Builder::Builder(const Solid& solid, const SubdivisionOptions& options, double overlap,
                 const BatchSink& sink)
    : solid_(solid),
      options_(options),
      overlap_(overlap),
      sink_(sink),
      repeats_(has_repeats(solid.list().literals, solid.primitives().size())) {}

std::unique_ptr<Part> Builder::build(Cell cell, std::span<const Literal> literals) {
  CellList whole, list;
  assign(whole, literals);
  auto workspace = acquire();
  workspace->restrictor.restrict(whole, inflated(cell.box), list);
  release(std::move(workspace));
  cell.allowance = kLiteralsPerLiteral + kLiteralsInAnyCase / std::max(list.count(), 1u);
  // Small scenes don't start the thread pool; one task alone needs no assembling afterwards.
  const bool small = list.count() <= size_t{kTaskLiterals} * options_.leaf_primitives;
  in_parallel_ = options_.threads != 1 && !small;
  if (!in_parallel_) {
    return sink_ ? build_part(cell, list) : finish_part(cell, list);
  }
  const unsigned threads =
      options_.threads == 0 ? std::thread::hardware_concurrency() : options_.threads;
  // TBB warns on stderr where an arena asks for more threads than the process is allowed.
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism,
                                    std::max(threads, 1u));
  tbb::task_arena arena(static_cast<int>(std::max(threads, 1u)));
  return arena.execute([&] { return build_part(cell, list); });
}

std::unique_ptr<Part> Builder::replace(const Leaf& leaf, uint32_t depth, const CellList& list) {
  Cell cell{leaf.box, depth};
  cell.allowance = kLiteralsPerLiteral;
  // What no division separated is divided again only where that now helps at once: else it would
  // become hundreds of cells, and each of them again with the next edit.
  if (leaf.kind == LeafKind::kFull) cell.stalled = kStalledDivisions - 1;
  return finish_part(cell, list);
}

std::unique_ptr<Part> Builder::build_part(const Cell& cell, const CellList& list) {
  if (list.count() <= kTaskLiterals) return finish_part(cell, list);
  auto workspace = acquire();
  if (leaf_kind(cell, list, workspace->distinct) != LeafKind::kEmpty) {
    release(std::move(workspace));
    return finish_part(cell, list);
  }
  auto part = std::make_unique<Part>();
  part->split = choose_split(cell, list);
  CellList halves[2];
  workspace->restrictor.restrict(list, halves_of(cell, part->split), halves[0], halves[1]);
  release(std::move(workspace));
  const auto side = [&](bool above) {
    return build_part(child_of(cell, part->split, above, list.count(), halves), halves[above]);
  };
  if (!in_parallel_) {
    part->below = side(false);
    part->above = side(true);
  } else {
    tbb::parallel_invoke([&] { part->below = side(false); }, [&] { part->above = side(true); });
  }
  return part;
}

/// The part as one chunk, delivered to the sink.
std::unique_ptr<Part> Builder::finish_part(const Cell& cell, const CellList& list) {
  auto part = std::make_unique<Part>();
  auto workspace = acquire();
  divide(cell, list, 0, *workspace, part->chunk);
  release(std::move(workspace));
  if (sink_) {
    const std::lock_guard lock(sink_mutex_);
    sink_({part->chunk.leaves, part->chunk.literals});
  }
  return part;
}

/// Recursion is bounded: a division halves the cell's longest side, or takes an eighth off a side
/// where that separates primitives, down to kSmallestCellOverlaps.
void Builder::divide(const Cell& cell, const CellList& list, size_t level, Workspace& workspace,
                     Chunk& chunk) const {
  LeafKind kind = list.is_constant() ? LeafKind::kEmpty : leaf_kind(cell, list, workspace.distinct);
  if (kind == LeafKind::kDropped && cell.doubled >= kSuspectDivisions &&
      coincides(cell, list, workspace)) {
    kind = LeafKind::kFull;
  }
  if (list.is_constant() || kind != LeafKind::kEmpty) {
    add_leaf(cell, list, kind, chunk);
    return;
  }
  if (workspace.levels.size() <= level) workspace.levels.push_back(std::make_unique<Level>());
  auto& halves = workspace.levels[level]->halves;
  const Split split = choose_split(cell, list);
  workspace.restrictor.restrict(list, halves_of(cell, split), halves[0], halves[1]);
  const size_t node = chunk.nodes.size();
  chunk.nodes.push_back({split.position, split.axis, 0, 0});
  for (const bool above : {false, true}) {
    const uint32_t index = static_cast<uint32_t>(chunk.nodes.size());
    (above ? chunk.nodes[node].above : chunk.nodes[node].below) = index;
    divide(child_of(cell, split, above, list.count(), halves), halves[above], level + 1, workspace,
           chunk);
  }
}

/// Whether the cell's surfaces coincide over a face, as far as grids of smaller cells tell: a
/// coarse one, which answers no to most, and a finer one.
bool Builder::coincides(const Cell& cell, const CellList& list, Workspace& workspace) const {
  for (const int side : {2, 4}) {
    const Vec3 step = cell.box.size() / double(side);
    int crossed = 0;
    for (int probe = 0; probe < side * side * side; ++probe) {
      const Vec3 place{probe % side, probe / side % side, probe / (side * side)};
      const Vec3 low = cell.box.min + step * place;
      workspace.restrictor.restrict(list, inflated({low, low + step}), workspace.probe);
      crossed += workspace.probe.count() == list.count();
    }
    if (crossed < side * side) return false;
  }
  return true;
}

/// The paper's conditions (§2.2), generalised by K; kEmpty: none holds, the cell is divided.
LeafKind Builder::leaf_kind(const Cell& cell, const CellList& list,
                            std::vector<uint32_t>& distinct) const {
  const uint32_t limit = options_.leaf_primitives;
  const bool coincident = cell.doubled >= kCoincidentDivisions;
  if ((options_.stop_at_unions || list.count() <= limit) && is_union(list)) {
    return LeafKind::kUnion;
  }
  if (list.count() <= limit || (repeats_ && has_at_most(limit, list, distinct))) {
    return list.count() == 2 ? LeafKind::kPair : LeafKind::kGeneral;
  }
  if (!coincident && options_.threshold_px > 0 &&
      projects_below(*options_.view, cell.box, options_.threshold_px)) {
    return LeafKind::kDropped;
  }
  const bool stalled = options_.threshold_px <= 0 && cell.stalled >= kStalledDivisions;
  const bool few = options_.threshold_px > 0 && list.count() <= kFewLiterals;
  const bool spent = cell.allowance < 1 && !few;
  return stalled || coincident || spent || is_small(cell) ? LeafKind::kFull : LeafKind::kEmpty;
}

bool Builder::is_small(const Cell& cell) const {
  const Vec3 size = cell.box.size();
  return std::max({size.x, size.y, size.z}) < kSmallestCellOverlaps * overlap_;
}

Split Builder::choose_split(const Cell& cell, const CellList& list) const {
  const Split split = options_.split == SplitRule::kCyclic
                          ? cyclic_split(cell.box, cell.depth)
                          : surface_area_split(solid_.extents(), list, cell.box);
  // Where coordinates are too coarse for a plane there, the longest side still has room for one
  // (is_small).
  const int axis = static_cast<int>(split.axis);
  const bool divides = split.position > cell.box.min[axis] && split.position < cell.box.max[axis];
  return divides ? split : longest_split(cell.box);
}

Halves Builder::halves_of(const Cell& cell, const Split& split) const {
  return {inflated(child_of(cell, split, false).box), inflated(child_of(cell, split, true).box),
          split.axis};
}

std::unique_ptr<Builder::Workspace> Builder::acquire() {
  const std::lock_guard lock(workspaces_mutex_);
  if (workspaces_.empty()) return std::make_unique<Workspace>(solid_);
  auto workspace = std::move(workspaces_.back());
  workspaces_.pop_back();
  return workspace;
}

void Builder::release(std::unique_ptr<Workspace> workspace) {
  const std::lock_guard lock(workspaces_mutex_);
  workspaces_.push_back(std::move(workspace));
}

}  // namespace csgcore
