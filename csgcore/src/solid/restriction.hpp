// Restricting a cell's function to the cell's two halves (paper §2.2.1).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "csgcore/canonical_primitive.hpp"
#include "csgcore/extent.hpp"
#include "solid/extent_tests.hpp"
#include "solid/operand_groups.hpp"
#include "tree/cell_list.hpp"

namespace csgcore {

/// Decides what extents leave open. A cell of the kd-tree is a box in the world, a tile of a
/// picture a box on the screen: the extents and this are all that differs.
class OpenClassifier {
 public:
  virtual ~OpenClassifier() = default;
  struct Answers {
    uint64_t outside = 0;
    uint64_t inside = 0;
  };
  /// About those of up to 64 primitives (indices, the top bit ignored) whose bit is set in `open`:
  /// the bits of those that are certainly outside the cell, or hold all of it. Their extents meet
  /// the cell.
  virtual Answers classify(const uint32_t* primitives, uint64_t open, const Box& cell) const = 0;
  /// Of up to 64 members of a group, from `first` on, the bits of those that are certainly outside
  /// the cell, by what is kept for members of groups. None: nothing is.
  virtual std::optional<uint64_t> members_outside(const OperandGroups::Members&, uint32_t /*first*/,
                                                  uint32_t /*count*/, const Box& /*cell*/) const {
    return std::nullopt;
  }
};

/// In world space.
class WorldClassifier final : public OpenClassifier {
 public:
  explicit WorldClassifier(std::span<const CanonicalPrimitive> primitives)
      : primitives_(primitives) {}
  Answers classify(const uint32_t* primitives, uint64_t open, const Box& cell) const override;

 private:
  std::span<const CanonicalPrimitive> primitives_;
};

/// Not to be shared between threads: it keeps its working memory.
class Restrictor {
 public:
  /// Keeps references to extents and classifier.
  Restrictor(std::span<const Extent> extents, const OpenClassifier& open)
      : extents_(extents), open_(open) {}

  /// Makes each of `below` and `above` the irreducible list that equals `list` within that half: no
  /// test that the half decides, none whose two continuations agree, none that evaluation cannot
  /// reach. `list` is not constant, is neither of the two, and comes from a restriction to the
  /// whole cell.
  void restrict(const CellList& list, const Halves& halves, CellList& below, CellList& above);
  /// The same for one cell and any list.
  void restrict(const CellList& list, const Box& cell, CellList& result);
  /// Whether that would leave the list as it is. `list` is irreducible.
  bool decides_none(const CellList& list, const Box& cell) const;

  /// What a caller knows of a test.
  enum class Decision : uint8_t { kOpen, kOutside, kInside };
  /// The same for decisions that the caller has made: `decisions[i]` is that of the list's index i.
  void restrict(const CellList& list, std::span<const Decision> decisions, CellList& result);

  /// Groups whose index in the list is marked are opened: their members stand in their places, as
  /// far as they matter in the cell. `list` comes from a restriction to the cell, and is not
  /// `result`.
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
  const OpenClassifier& open_;
  std::vector<uint32_t> maps_[2];  // per side and number of the old list: what stands for it
  std::vector<uint32_t> reached_;  // drop_unreached: per number 0 or 1, then the new number
};

}  // namespace csgcore
