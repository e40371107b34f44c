// Builds kd subtrees: the recursive division of paper §2.2, as tasks.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "csgcore/subdivision.hpp"
#include "restriction.hpp"
#include "split.hpp"

namespace csgcore {

/// What one task produces; indices are local to it, node 0 is its root.
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
  uint32_t doubled = 0;  // divisions in a row of which both halves kept every primitive, but for
                         // those that only cut off empty space
  /// How many literals the leaves below may hold for each of the cell's own. Each division hands
  /// its cell's share on to the halves, in proportion to what they hold.
  double allowance = 0;
};

class Builder {
 public:
  /// Keeps references to all but the overlap.
  Builder(const Solid& solid, const SubdivisionOptions& options, double overlap,
          const BatchSink& sink);

  /// `literals`, not empty, equal the solid within the cell. Uses as many threads as the options
  /// say; the result does not depend on them.
  std::unique_ptr<Part> build(Cell cell, std::span<const Literal> literals);

  /// What takes the place of a leaf at this depth whose function has become `list`, which is
  /// restricted to it. In one chunk.
  std::unique_ptr<Part> replace(const Leaf& leaf, uint32_t depth, const CellList& list);

 private:
  /// The lists of one level of the recursion, reused by all cells of that level.
  struct Level {
    CellList halves[2];
  };
  /// What a task works with.
  struct Workspace {
    explicit Workspace(const Solid& solid)
        : classifier(solid.primitives()), restrictor(solid.extents(), classifier) {}
    WorldClassifier classifier;
    Restrictor restrictor;
    std::vector<std::unique_ptr<Level>> levels;
    std::vector<uint32_t> distinct;
    CellList probe;
  };

  std::unique_ptr<Part> build_part(const Cell& cell, const CellList& list);
  std::unique_ptr<Part> finish_part(const Cell& cell, const CellList& list);
  void divide(const Cell& cell, const CellList& list, size_t level, Workspace& workspace,
              Chunk& chunk) const;

  LeafKind leaf_kind(const Cell& cell, const CellList& list, std::vector<uint32_t>& distinct) const;
  bool coincides(const Cell& cell, const CellList& list, Workspace& workspace) const;
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
  bool repeats_ = false;  // some primitive stands in the list more than once
  bool in_parallel_ = false;
  std::mutex sink_mutex_;
  std::mutex workspaces_mutex_;
  std::vector<std::unique_ptr<Workspace>> workspaces_;  // not in use
};

}  // namespace csgcore
