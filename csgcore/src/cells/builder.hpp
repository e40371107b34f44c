// Builds kd subtrees by the recursive division of paper §2.2, in parallel tasks.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "cells/cell_budget.hpp"
#include "cells/chunk.hpp"
#include "csgcore/kd_tree.hpp"
#include "csgcore/solid.hpp"
#include "solid/restriction.hpp"

namespace csgcore {

class Builder {
 public:
  /// Keeps references to all arguments but the overlap.
  Builder(const Solid& solid, const SubdivisionOptions& options, double overlap,
          const BatchSink& sink);

  /// Builds the whole tree, with as many threads as the options say. The result does not depend on
  /// their number.
  Chunk build(const Box& root_box);

  /// Adds to `starts` a cell of an existing tree that is to be divided: a dropped leaf at this
  /// depth, with its tests.
  void start(const Leaf& leaf, uint32_t depth, std::span<const BlistTest> tests, Chunk& starts);
  /// Returns whether the budget, of which `stored_bytes` are used, suffices to divide each of the
  /// starts at least once.
  bool can_divide(const Chunk& starts, uint64_t stored_bytes) const;
  /// Divides the starts: `starts` gets a subtree for each of them, in order.
  void finish(Chunk& starts, uint64_t stored_bytes);

 private:
  /// The lists of one level of the recursion, reused by all cells of that level.
  struct Level {
    CellList halves[2];
  };
  /// The working memory of a task.
  struct Workspace {
    explicit Workspace(const Solid& solid)
        : classifier(solid.primitives()), restrictor(solid.extents(), classifier) {}
    WorldClassifier classifier;
    Restrictor restrictor;
    std::vector<std::unique_ptr<Level>> levels;
    std::vector<uint32_t> distinct;
  };

  /// Paused cells of one chunk that one task resumes.
  struct Resumption {
    Chunk* owner;
    size_t first, end;
    Chunk* result;
  };
  /// The credit that is dealt out to paused cells: each gets what it needs, and a share of `rest`
  /// in proportion to its part of all `tests`.
  struct Deal {
    uint64_t rest, tests;
  };

  template <typename Work>
  void run(bool in_parallel, Work&& work);
  std::unique_ptr<Part> build_part(const Cell& cell, const CellList& list);
  std::unique_ptr<Part> finish_part(const Cell& cell, const CellList& list);
  void divide(const Cell& cell, const CellList& list, size_t level, Workspace& workspace,
              Chunk& chunk) const;
  int64_t left_to(const Chunk& starts, uint64_t stored_bytes) const;
  void resume_paused(const std::vector<Chunk*>& chunks, int64_t left);
  void resume_in_rounds(std::vector<Chunk*> chunks, int64_t left);
  void resume(const Resumption& resumption, const Deal& deal);
  void give_up(Chunk& chunk);
  void deliver(std::span<const Leaf> leaves, const Chunk& chunk);

  LeafKind leaf_kind(const Cell& cell, const CellList& list, std::vector<uint32_t>& distinct) const;
  std::optional<bool> coincides(const Cell& cell, const CellList& list, uint64_t credit,
                                Workspace& workspace, uint64_t& cost) const;
  bool is_small(const Cell& cell) const;
  Split choose_split(const Cell& cell, const CellList& list) const;
  Box inflated(const Box& box) const { return {box.min - overlap_, box.max + overlap_}; }
  Halves halves_of(const Cell& cell, const Split& split) const;

  std::unique_ptr<Workspace> acquire();
  void release(std::unique_ptr<Workspace> workspace);

  const Solid& solid_;
  const SubdivisionOptions& options_;
  const double overlap_;
  const BatchSink& sink_;
  bool repeats_ = false;  // the list names some primitive more than once
  bool in_parallel_ = false;
  const CellCosts costs_;
  const uint64_t budget_;  // bytes
  std::mutex sink_mutex_;
  std::mutex workspaces_mutex_;
  std::vector<std::unique_ptr<Workspace>> workspaces_;  // not in use
};

}  // namespace csgcore
