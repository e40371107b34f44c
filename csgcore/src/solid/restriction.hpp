// Restricts a cell's list to the cell's two halves (paper §2.2.1).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "csgcore/canonical_primitive.hpp"
#include "solid/extent_tests.hpp"
#include "solid/operand_groups.hpp"
#include "tree/cell_list.hpp"

namespace csgcore {

/// Classifies primitives that their extents do not decide. A cell of the kd-tree is a box in the
/// world, and a tile of a picture is a box on the screen; restriction is the same for both but for
/// the extents and this classifier.
class OpenClassifier {
 public:
  virtual ~OpenClassifier() = default;
  struct Answers {
    uint64_t outside = 0;
    uint64_t inside = 0;
  };
  /// Classifies those of up to 64 primitives (indices, whose top bit is ignored) that have their
  /// bit set in `open`. Returns the bits of those that certainly lie outside of the cell, and of
  /// those that contain all of it. Their extents meet the cell.
  virtual Answers classify(const uint32_t* primitives, uint64_t open, const Box& cell) const = 0;
  /// Returns, for up to 64 members of a group from `first` on, the bits of those that certainly lie
  /// outside of the cell, by SoA bounds that are kept for groups. Returns nothing if there are no
  /// such bounds.
  virtual std::optional<uint64_t> members_outside(const OperandGroups::Members&, uint32_t /*first*/,
                                                  uint32_t /*count*/, const Box& /*cell*/) const {
    return std::nullopt;
  }
};

/// Classifies primitives against boxes in world space.
class WorldClassifier final : public OpenClassifier {
 public:
  explicit WorldClassifier(std::span<const CanonicalPrimitive> primitives)
      : primitives_(primitives) {}
  Answers classify(const uint32_t* primitives, uint64_t open, const Box& cell) const override;

 private:
  std::span<const CanonicalPrimitive> primitives_;
};

/// Restricts lists to cells. It keeps its working memory, so that each thread needs its own.
class Restrictor {
 public:
  /// Keeps references to extents and classifier.
  Restrictor(std::span<const Extent> extents, const OpenClassifier& open)
      : extents_(extents), open_(&open) {}
  /// Goes on with other extents and another classifier, of another solid.
  void aim_at(std::span<const Extent> extents, const OpenClassifier& open) {
    extents_ = extents;
    open_ = &open;
  }

  /// Makes each of `below` and `above` the irreducible list that equals `list` within that half of
  /// a cell: it has no test that the half decides, none whose two targets agree, and none that
  /// evaluation cannot reach. `list` must not be constant, must be another object than the two, and
  /// must come from a restriction to the whole cell.
  void restrict(const CellList& list, const Halves& halves, CellList& below, CellList& above);
  /// Does the same for one cell and any list.
  void restrict(const CellList& list, const Box& cell, CellList& result);
  /// Returns whether that would leave the list as it is. `list` must be irreducible.
  bool decides_none(const CellList& list, const Box& cell) const;

  /// What the caller knows about a test's primitive.
  enum class Decision : uint8_t { kOpen, kOutside, kInside };
  /// Does the same by decisions that the caller has made: `decisions[i]` is about the test at index
  /// i.
  void restrict(const CellList& list, std::span<const Decision> decisions, CellList& result);

  /// Expands the groups whose indices in the list are marked: `result` has their members in their
  /// places, except for those that do not matter in the cell. `list` must come from a restriction
  /// to the cell, and be another object than `result`.
  void open(const CellList& list, const OperandGroups& groups, std::span<const uint8_t> marked,
            const Box& cell, CellList& result);

 private:
  ExtentAnswers answers_of_members(const OperandGroups::Members& members, uint32_t first,
                                   uint32_t count, const Box& cell) const;
  template <int kSides>
  ExtentAnswers answers_of(const uint32_t* primitives, uint32_t count, const Halves& halves) const;
  template <int kSides>
  void restrict_sides(const CellList& list, const Halves& halves, CellList* const* results);
  bool all_have_jumps(const CellList& list);
  void drop_unreached(CellList& list);

  std::span<const Extent> extents_;
  const OpenClassifier* open_;
  std::vector<uint32_t> maps_[2];  // by side and number in the old list: the number in the new list
  std::vector<uint32_t> reached_;  // for drop_unreached(): by number 0 or 1, then the new number
};

}  // namespace csgcore
