#include "cells/builder.hpp"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <utility>

#include "base/worker_threads.hpp"
#include "cells/cell_budget.hpp"
#include "cells/chunk.hpp"

namespace csgcore {
namespace {

/// A cell whose longest side is below this many overlaps is not divided further.
constexpr double kSmallestCellOverlaps = 16;

/// A cell is not divided further if so many divisions above it dropped not one test and cut off
/// hardly any empty space: the surfaces that still cross it coincide or meet there (paper, figure
/// 2). With a pixel threshold this rule applies only to surfaces that coincide over a face, which
/// stay in both halves of each division: the whole face would be dropped otherwise. Where surfaces
/// meet in a point, one half of each division contains it, and the paper's own rule (case 4) ends
/// these cells.
constexpr uint32_t kStalledDivisions = 9;
/// At the eye, the pixel threshold never ends a division. There, a cell is taken for one whose
/// surfaces coincide after so many divisions in a row in which both halves kept every test.
constexpr uint32_t kCoincidentDivisions = 14;
/// A cell below the threshold is searched for coincident surfaces if so many divisions in a row
/// have kept every test in both halves. If the surfaces coincide, all of them cross at least n² of
/// n³ smaller cells; surfaces that meet in a point or along a curve cross about n or fewer.
constexpr uint32_t kSuspectDivisions = 4;

/// Dividing a cell repeats the primitives that cross both halves. For each test of the solid, the
/// leaves may hold kTestsPerTest tests, and kTestsInAnyCase tests besides. A cell whose share is
/// used up is not divided further. This bounds memory and time if surfaces lie so close that
/// dividing hardly separates them (a thousand nested shells). CSn and CCn need 3 to 6 tests for
/// each at K = 8, and 70 to 120 by the paper's rules.
constexpr double kTestsPerTest = 128;
constexpr double kTestsInAnyCase = 0x1p18;
/// With a pixel threshold, which bounds the number of cells, cells with lists this short are
/// divided all the same. Lists are this short where surfaces meet in points, and only the paper's
/// rule (case 4) should end these cells.
constexpr uint32_t kFewTests = 32;

/// The halves of a list longer than this become two tasks. That depends on the data alone, so that
/// the result is the same for every number of threads.
constexpr uint32_t kTaskTests = 256;
/// One task resumes so many paused cells, which are small.
constexpr size_t kResumedTogether = 64;
/// Fewer paused cells than this are resumed by one thread.
constexpr size_t kPausedForTasks = 1024;
/// The first round may use up the budget divided by these numbers before cells are paused: by
/// kFirstShare if there are several tasks, since few designs, if any, should pause cells; by
/// kFirstShareAlone if there is one task, so that expensive designs are continued in parallel.
constexpr uint64_t kFirstShare = 2;
constexpr uint64_t kFirstShareAlone = 8;
/// As long as that lasts, each cell may take so many times its share.
constexpr uint64_t kOvercommitment = 256;

bool has_repeats(std::span<const BlistTest> tests, size_t primitives) {
  std::vector<bool> seen(primitives);
  for (const BlistTest& test : tests) {
    if (seen[test.primitive]) return true;
    seen[test.primitive] = true;
  }
  return false;
}

/// Returns whether the list has at most `limit` distinct primitives. `seen` is working memory.
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

/// Returns one half of a divided cell, whose `count` tests were divided into `halves` at this cost.
Cell child_of(const Cell& cell, const Split& split, bool above, uint32_t count,
              const CellList (&halves)[2], int64_t cost) {
  Cell child = child_of(cell, split, above);
  const CellList& other = halves[!above];
  if (halves[above].count() < count) {
    child.stalled = child.doubled = 0;
  } else {
    // Cutting off more than half of the cell as empty space is progress, too.
    const int axis = static_cast<int>(split.axis);
    const bool halved = child.box.size()[axis] >= 0.5 * cell.box.size()[axis];
    if (!other.is_constant() || halved) ++child.stalled;
    if (!other.is_constant()) child.doubled = other.count() == count ? cell.doubled + 1 : 0;
  }
  const uint64_t both = uint64_t{halves[0].count()} + halves[1].count();
  if (both == 0) return child;
  child.allowance = cell.allowance * count / static_cast<double>(both);
  child.credit = (cell.credit - static_cast<uint64_t>(cost)) * halves[above].count() / both;
  return child;
}

void add_leaf(const Cell& cell, const CellList& list, LeafKind kind, Chunk& chunk) {
  chunk.nodes.push_back({0, KdNode::kLeafAxis, static_cast<uint32_t>(chunk.leaves.size()), 0});
  chunk.leaves.push_back(
      {cell.box, chunk.tests.size(), list.count(), kind, list.root == CellList::kTrue});
  append(chunk.tests, list);
}

void pause(const Cell& cell, const CellList& list, uint64_t needed, Chunk& chunk) {
  chunk.paused_nodes.push_back(static_cast<uint32_t>(chunk.nodes.size()));
  chunk.paused.push_back({cell, needed});
  add_leaf(cell, list, LeafKind::kReplaced, chunk);
}

/// Adds a subtree that is one paused cell, or an empty leaf if the list is constant.
void add_start(const Cell& cell, const CellList& list, uint64_t needed, Chunk& starts) {
  starts.begin_root();
  if (list.is_constant()) {
    add_leaf(cell, list, LeafKind::kEmpty, starts);
  } else {
    pause(cell, list, needed, starts);
  }
}

uint64_t mean_test_cost(const Solid& solid) {
  uint64_t sum = 0;
  for (const BlistTest& test : solid.list().tests) {
    sum += test_cost(solid.primitives()[test.primitive]);
  }
  const uint64_t count = solid.list().tests.size();
  return (sum + count / 2) / std::max<uint64_t>(count, 1);
}

double first_allowance(const CellList& list) {
  return kTestsPerTest + kTestsInAnyCase / std::max(list.count(), 1u);
}

/// Collects the part's chunks in the order of their nodes. The recursion is as deep as parts are
/// nested.
void collect_chunks(Part& part, std::vector<Chunk*>& chunks) {
  if (part.split.axis == KdNode::kLeafAxis) {
    chunks.push_back(&part.chunk);
    return;
  }
  collect_chunks(*part.below, chunks);
  collect_chunks(*part.above, chunks);
}

}  // namespace

Builder::Builder(const Solid& solid, const SubdivisionOptions& options, double overlap,
                 const BatchSink& sink)
    : solid_(solid),
      options_(options),
      overlap_(overlap),
      sink_(sink),
      repeats_(has_repeats(solid.list().tests, solid.primitives().size())),
      costs_(mean_test_cost(solid)),
      budget_(options.budget_bytes > 0 ? std::min(options.budget_bytes, kLargestBudget)
                                       : subdivision_budget(solid.list().tests.size())) {}

/// Calls `work`, in parallel with as many threads as the options say, or in this thread.
template <typename Work>
void Builder::run(bool in_parallel, Work&& work) {
  in_parallel_ = in_parallel && options_.threads != 1;
  if (in_parallel_) {
    with_threads(options_.threads, work);
  } else {
    work();
  }
}

Chunk Builder::build(const Box& root_box) {
  Cell cell{root_box};
  CellList whole, list;
  assign(whole, solid_.list().tests);
  auto workspace = acquire();
  workspace->restrictor.restrict(whole, inflated(cell.box), list);
  release(std::move(workspace));
  cell.allowance = first_allowance(list);
  const uint64_t left = budget_ - std::min(budget_, leaf_bytes(list.count()));
  // Small scenes do not start the thread pool, and a single task needs no assembling.
  const bool small = list.count() <= size_t{kTaskTests} * options_.leaf_primitives;
  cell.credit = left / (small ? kFirstShareAlone : kFirstShare);
  std::unique_ptr<Part> part;
  run(!small, [&] { part = small && !sink_ ? finish_part(cell, list) : build_part(cell, list); });
  std::vector<Chunk*> chunks;
  collect_chunks(*part, chunks);
  resume_paused(chunks, static_cast<int64_t>(left));
  return assemble(std::move(part));
}

void Builder::start(const Leaf& leaf, uint32_t depth, std::span<const BlistTest> tests,
                    Chunk& starts) {
  CellList whole, list;
  assign(whole, tests);
  auto workspace = acquire();
  workspace->restrictor.restrict(whole, inflated(leaf.box), list);
  release(std::move(workspace));
  Cell cell{leaf.box, depth};
  cell.allowance = first_allowance(list);
  add_start(cell, list, costs_.most_division(list.count()), starts);
}

int64_t Builder::left_to(const Chunk& starts, uint64_t stored_bytes) const {
  return static_cast<int64_t>(budget_) - static_cast<int64_t>(stored_bytes + bytes_of(starts));
}

bool Builder::can_divide(const Chunk& starts, uint64_t stored_bytes) const {
  int64_t needed = 0;
  for (const Paused& paused : starts.paused) needed += static_cast<int64_t>(paused.needed);
  return needed <= left_to(starts, stored_bytes);
}

void Builder::finish(Chunk& starts, uint64_t stored_bytes) {
  resume_paused({&starts}, left_to(starts, stored_bytes));
}

/// Resumes the paused cells of the chunks. `left` is the part of the budget that is left to the
/// chunks, from which their own costs are subtracted first.
void Builder::resume_paused(const std::vector<Chunk*>& chunks, int64_t left) {
  size_t paused = 0;
  for (const Chunk* chunk : chunks) {
    left -= chunk->cost;
    paused += chunk->paused.size();
  }
  if (paused == 0) return;
  run(paused >= kPausedForTasks, [&] { resume_in_rounds(chunks, left); });
}

void Builder::resume_in_rounds(std::vector<Chunk*> chunks, int64_t left) {
  while (true) {
    int64_t needed = 0;
    Deal deal{0, 0};
    for (const Chunk* chunk : chunks) {
      for (size_t i = 0; i < chunk->paused.size(); ++i) {
        needed += static_cast<int64_t>(chunk->paused[i].needed);
        deal.tests += chunk->paused_leaf(i).test_count;
      }
    }
    if (needed == 0) return;
    if (needed > left) break;
    deal.rest = static_cast<uint64_t>(left - needed);
    std::vector<Resumption> resumptions;
    for (Chunk* chunk : chunks) {
      const size_t count = chunk->paused.size();
      chunk->resumed.resize((count + kResumedTogether - 1) / kResumedTogether);
      for (size_t i = 0; i < chunk->resumed.size(); ++i) {
        const size_t first = i * kResumedTogether;
        resumptions.push_back(
            {chunk, first, std::min(first + kResumedTogether, count), &chunk->resumed[i]});
      }
    }
    if (in_parallel_) {
      tbb::parallel_for(size_t{0}, resumptions.size(),
                        [&](size_t i) { resume(resumptions[i], deal); });
    } else {
      for (const Resumption& resumption : resumptions) resume(resumption, deal);
    }
    for (Chunk* chunk : chunks) chunk->paused = {};
    chunks.clear();
    for (const Resumption& resumption : resumptions) {
      left -= resumption.result->cost;
      if (!resumption.result->paused.empty()) chunks.push_back(resumption.result);
    }
  }
  for (Chunk* chunk : chunks) give_up(*chunk);
}

void Builder::resume(const Resumption& resumption, const Deal& deal) {
  const Chunk& owner = *resumption.owner;
  Chunk& chunk = *resumption.result;
  auto workspace = acquire();
  CellList list;
  for (size_t i = resumption.first; i < resumption.end; ++i) {
    const Paused& paused = owner.paused[i];
    const Leaf& leaf = owner.paused_leaf(i);
    assign(list, std::span(owner.tests).subspan(leaf.first_test, leaf.test_count));
    Cell cell = paused.cell;
    cell.credit = paused.needed + deal.rest * list.count() / deal.tests;
    chunk.begin_root();
    divide(cell, list, 0, *workspace, chunk);
  }
  release(std::move(workspace));
  deliver(chunk.leaves, chunk);
}

void Builder::give_up(Chunk& chunk) {
  std::vector<Leaf> leaves;
  for (size_t i = 0; i < chunk.paused.size(); ++i) {
    Leaf& leaf = chunk.paused_leaf(i);
    leaf.kind = LeafKind::kGivenUp;
    if (sink_) leaves.push_back(leaf);
  }
  chunk.paused = {};
  deliver(leaves, chunk);
}

void Builder::deliver(std::span<const Leaf> leaves, const Chunk& chunk) {
  if (!sink_) return;
  const std::lock_guard lock(sink_mutex_);
  sink_({leaves, chunk.tests});
}

std::unique_ptr<Part> Builder::build_part(const Cell& cell, const CellList& list) {
  if (list.count() <= kTaskTests) return finish_part(cell, list);
  auto workspace = acquire();
  if (cell.credit < costs_.most_division(list.count()) ||
      leaf_kind(cell, list, workspace->distinct) != LeafKind::kEmpty) {
    release(std::move(workspace));
    return finish_part(cell, list);
  }
  auto part = std::make_unique<Part>();
  part->split = choose_split(cell, list);
  CellList halves[2];
  workspace->restrictor.restrict(list, halves_of(cell, part->split), halves[0], halves[1]);
  release(std::move(workspace));
  const int64_t cost = part->chunk.cost =
      costs_.division(list.count(), halves[0].count(), halves[1].count());
  const auto side = [&](bool above) {
    return build_part(child_of(cell, part->split, above, list.count(), halves, cost),
                      halves[above]);
  };
  if (!in_parallel_) {
    part->below = side(false);
    part->above = side(true);
  } else {
    tbb::parallel_invoke([&] { part->below = side(false); }, [&] { part->above = side(true); });
  }
  return part;
}

/// Builds the part as one chunk, and delivers it to the sink.
std::unique_ptr<Part> Builder::finish_part(const Cell& cell, const CellList& list) {
  auto part = std::make_unique<Part>();
  auto workspace = acquire();
  part->chunk.begin_root();
  part->chunk.limit = static_cast<int64_t>(cell.credit);
  Cell start = cell;
  start.credit = std::min(cell.credit * kOvercommitment, kLargestBudget);
  divide(start, list, 0, *workspace, part->chunk);
  release(std::move(workspace));
  deliver(part->chunk.leaves, part->chunk);
  return part;
}

/// Divides the cell recursively. The depth is bounded: a division halves the longest side, or takes
/// at least an eighth off a side if that separates primitives, down to kSmallestCellOverlaps.
void Builder::divide(const Cell& cell, const CellList& list, size_t level, Workspace& workspace,
                     Chunk& chunk) const {
  LeafKind kind = list.is_constant() ? LeafKind::kEmpty : leaf_kind(cell, list, workspace.distinct);
  const uint64_t credit = std::min(cell.credit, chunk.credit());
  if (kind == LeafKind::kDropped && cell.doubled >= kSuspectDivisions) {
    uint64_t needed = 0;
    const std::optional<bool> coincident = coincides(cell, list, credit, workspace, needed);
    if (!coincident) {
      pause(cell, list, needed, chunk);
      return;
    }
    chunk.cost += static_cast<int64_t>(needed);
    if (*coincident) kind = LeafKind::kFull;
  }
  if (list.is_constant() || kind != LeafKind::kEmpty) {
    add_leaf(cell, list, kind, chunk);
    return;
  }
  const uint64_t needed = costs_.most_division(list.count());
  if (credit < needed) {
    pause(cell, list, needed, chunk);
    return;
  }
  if (workspace.levels.size() <= level) workspace.levels.push_back(std::make_unique<Level>());
  auto& halves = workspace.levels[level]->halves;
  const Split split = choose_split(cell, list);
  workspace.restrictor.restrict(list, halves_of(cell, split), halves[0], halves[1]);
  const int64_t cost = costs_.division(list.count(), halves[0].count(), halves[1].count());
  chunk.cost += cost;
  const size_t node = chunk.nodes.size();
  chunk.nodes.push_back({split.position, split.axis, 0, 0});
  for (const bool above : {false, true}) {
    const uint32_t index = static_cast<uint32_t>(chunk.nodes.size());
    (above ? chunk.nodes[node].above : chunk.nodes[node].below) = index;
    divide(child_of(cell, split, above, list.count(), halves, cost), halves[above], level + 1,
           workspace, chunk);
  }
}

/// Returns whether the cell's surfaces coincide over a face, as far as grids of smaller cells tell:
/// a coarse grid, which rules most cells out, then a finer one. Returns nothing if the credit does
/// not suffice. `cost` gets the actual cost, or else the highest possible cost of the next grid.
std::optional<bool> Builder::coincides(const Cell& cell, const CellList& list, uint64_t credit,
                                       Workspace& workspace, uint64_t& cost) const {
  uint32_t probed = 0;
  for (const uint32_t side : {2, 4}) {
    const uint32_t wanted = side * side, probes = wanted * side;
    cost = costs_.probes(list.count(), probed + probes);
    if (credit < cost) return std::nullopt;
    const Vec3 step = cell.box.size() / double(side);
    uint32_t crossed = 0, probe = 0;
    for (; crossed < wanted && crossed + (probes - probe) >= wanted; ++probe) {
      const Vec3 place{probe % side, probe / side % side, probe / (side * side)};
      const Vec3 low = cell.box.min + step * place;
      crossed += workspace.restrictor.decides_none(list, inflated({low, low + step}));
    }
    probed += probe;
    cost = costs_.probes(list.count(), probed);
    if (crossed < wanted) return false;
  }
  return true;
}

/// Returns the kind of leaf by the paper's conditions (§2.2), generalised to K primitives; kEmpty
/// if none holds, so that the cell is to be divided.
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
  const bool few = options_.threshold_px > 0 && list.count() <= kFewTests;
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
  // If coordinates are too coarse for a plane there, the longest side still has room for one
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
