// What a subdivision is made of, and the rules that it is made by.
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
  kSurfaceArea,  // the axis and position of least Σ area · primitives
};

struct SubdivisionOptions {
  /// K: a cell is a leaf once the surfaces of at most so many distinct primitives cross it. ≥ 1.
  uint32_t leaf_primitives = 8;
  /// Paper §2.2 case 2: a cell that is a union of primitives, of any number, is a leaf.
  bool stop_at_unions = false;
  /// Paper §2.2 case 4: a cell that projects to fewer pixels in `view` is dropped. 0: none is.
  double threshold_px = 0;
  /// Must be set if threshold_px > 0; not used otherwise.
  std::optional<View> view;
  SplitRule split = SplitRule::kSurfaceArea;
  /// How many bytes the cells may take: what is left to divide when they are used up is given up
  /// (LeafKind::kGivenUp). Bounds the time, too. 0: subdivision_budget() of the solid's tests.
  uint64_t budget_bytes = 0;
  /// Worker threads; 0: as many as there are. The result does not depend on it.
  unsigned threads = 0;

  /// The paper's own rule: K = 2, unions of any number, middle splits.
  static SubdivisionOptions paper(double threshold_px, const View& view);
};

enum class LeafKind : uint8_t {
  kEmpty,    // case 1: no surface crosses the cell
  kUnion,    // case 2: one primitive, or the union of several
  kPair,     // case 3: an intersection of two, complemented or not
  kGeneral,  // up to K primitives, any function
  kFull,  // more than K that no sensible subdivision separates (they coincide, meet in a point, or
          // lie so close that dividing repeats more than it separates): evaluated in full
  kDropped,   // case 4: below the threshold
  kGivenUp,   // more than K; not divided since the budget is used up; evaluated in full
  kReplaced,  // no part of the tree any longer: others stand in its place (refine, update)
};
constexpr size_t kLeafKinds = 8;

/// `tests` of Subdivision [first_test, first_test + test_count) are the cell's
/// function.
struct Leaf {
  Box box;
  uint64_t first_test = 0;
  uint32_t test_count = 0;
  LeafKind kind = LeafKind::kEmpty;
  bool solid = false;  // kEmpty: the cell lies within the solid
};

/// axis 0, 1, 2: the cells below and above `split` are the nodes `below` and `above`.
/// axis kLeafAxis: `below` is the index of the leaf.
struct KdNode {
  static constexpr uint32_t kLeafAxis = 3;
  double split = 0;
  uint32_t axis = kLeafAxis;
  uint32_t below = 0;
  uint32_t above = 0;
};

/// Leaves that one piece of the subdivision has finished, with the tests they index. In the
/// places of those that are kReplaced others will come.
struct LeafBatch {
  std::span<const Leaf> leaves;
  std::span<const BlistTest> tests;
};

/// Called with each batch as the subdivision delivers it (paper §2.3, "render the CSG object while
/// subdividing it"), from any thread, one call at a time; the spans live during the call only.
using BatchSink = std::function<void(const LeafBatch&)>;

/// The budget of a solid of so many tests, in bytes: 64 MiB and in proportion to them, at most
/// 2 GiB. Ordinary designs need a tenth of it.
uint64_t subdivision_budget(size_t tests);

}  // namespace csgcore
