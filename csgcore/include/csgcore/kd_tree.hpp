// The parts of a subdivision, and the rules that it is made by.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>

#include "csgcore/blist.hpp"
#include "csgcore/geometry.hpp"
#include "csgcore/view.hpp"

namespace csgcore {

enum class SplitRule : uint8_t {
  kCyclic,       // paper §2.1: in the middle, along x, y, z in turn
  kSurfaceArea,  // the plane of least Σ area · primitives, over both sides
};

struct SubdivisionOptions {
  /// K ≥ 1: a cell is a leaf if the surfaces of at most K distinct primitives cross it.
  uint32_t leaf_primitives = 8;
  /// Paper §2.2 case 2: a cell in which the solid is a union of any number of primitives is a leaf.
  bool stop_at_unions = false;
  /// Paper §2.2 case 4: a cell whose projection in `view` is smaller than so many pixels (see
  /// projected_size_px) is dropped. 0: no cell is.
  double threshold_px = 0;
  /// Must be set if threshold_px > 0; not used otherwise.
  std::optional<View> view;
  SplitRule split = SplitRule::kSurfaceArea;
  /// How many bytes the cells may take, which bounds the time, too. When they are used up, the
  /// cells that are still to be divided become leaves (LeafKind::kGivenUp). 0: subdivision_budget()
  /// of the number of the solid's tests.
  uint64_t budget_bytes = 0;
  /// Number of worker threads; 0: as many as there are. The result does not depend on it.
  unsigned threads = 0;

  /// Returns the paper's own rules: K = 2, unions of any number, splits in the middle.
  static SubdivisionOptions paper(double threshold_px, const View& view);
};

enum class LeafKind : uint8_t {
  kEmpty,    // case 1: no surface crosses the cell
  kUnion,    // case 2: one primitive, or the union of several
  kPair,     // case 3: an intersection of two, complemented or not
  kGeneral,  // up to K primitives, any function
  kFull,  // More than K that no sensible subdivision separates: they coincide, meet in a point, or
          // lie so close that dividing repeats more than it separates. Evaluated in full.
  kDropped,   // case 4: below the threshold
  kGivenUp,   // More than K; not divided since the budget is used up. Evaluated in full.
  kReplaced,  // no part of the tree any longer: other leaves stand in its place (refine)
};
constexpr size_t kLeafKinds = 8;

/// A leaf cell. The Subdivision's tests [first_test, first_test + test_count) are the function of
/// the cell; their jump targets count from first_test.
struct Leaf {
  Box box;
  uint64_t first_test = 0;
  uint32_t test_count = 0;
  LeafKind kind = LeafKind::kEmpty;
  bool solid = false;  // for kEmpty: whether the cell lies within the solid
};

/// A node of the kd-tree. If axis is 0, 1 or 2, the cell is divided at coordinate `split` into the
/// nodes `below` and `above`. If axis is kLeafAxis, `below` is the index of a leaf.
struct KdNode {
  static constexpr uint32_t kLeafAxis = 3;
  double split = 0;
  uint32_t axis = kLeafAxis;
  uint32_t below = 0;
  uint32_t above = 0;
};

/// Leaves that one part of the subdivision has finished, with the tests that they index. Later
/// batches hold the leaves that stand in place of those that are kReplaced.
struct LeafBatch {
  std::span<const Leaf> leaves;
  std::span<const BlistTest> tests;
};

/// Is called with each batch as soon as it is ready (paper §2.3, "render the CSG object while
/// subdividing it"), from any thread, but never by two at a time. The spans are valid during the
/// call only.
using BatchSink = std::function<void(const LeafBatch&)>;

/// Returns the default budget, in bytes, for a solid whose list has so many tests: 64 MiB plus an
/// amount in proportion to them, at most 2 GiB. Ordinary designs need a tenth of it.
uint64_t subdivision_budget(size_t tests);

}  // namespace csgcore
