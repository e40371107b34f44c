// The terms of this search: an *operand* is a primitive or a group that may be left out, which
// stands in the tree once, in a group or as a complement. A *wall* is any other primitive of the
// whole list. The *reach* of an operand is the primitive, or the box of a group, with the margin
// around it. f is the solid's value at a point, as a function of which primitives hold the point.
//
// An operand is *cancelled* if it changes f nowhere in its reach, whatever the other operands do
// that reach in there. A cancelled operand may be left out, and so may all of them together: if an
// operand is cancelled because another one holds it, and that one is cancelled too, then that one
// changes nothing there either.
//
// An operand is *sealed* if the walls alone make f true in its reach, and only sealed operands
// reach in there. Around all sealed operands together runs a border that none of them gets to, nor
// does any other operand. So on the border f is as if no operand held, and the solid holds: a ray
// from outside has ended when it gets there. Without the sealed operands, f is true everywhere
// within the border, and unchanged elsewhere. (A subtracted operand that contains the whole reach
// of a sealed one counts there with the value it has. If it is sealed itself, f is true there
// without it, too.)
#include "solid/hidden_operands.hpp"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <memory>

#include "solid/operand_groups.hpp"
#include "solid/restriction.hpp"
#include "tree/subtree_boxes.hpp"

namespace csgcore {
namespace {

/// A smaller share of hidden operands among those in groups is not worth lists of their own.
constexpr double kLeastHidden = 0.25;

/// As many primitives as a word has bits.
constexpr size_t kAtOnce = 64;

/// The search for operands that reach into sealed ones is limited to so many steps for each
/// operand. If many are connected with the outside, it may take a thousand each.
constexpr size_t kMostSteps = 4;
constexpr size_t kStepsInAnyCase = size_t{1} << 14;

/// The operands of a longer list are not judged, since the whole list is tested for each of them.
constexpr uint32_t kLongestList = 1024;

/// Groups that are nested deeper are not judged.
constexpr size_t kDeepest = 32;

/// The role of a primitive or group in the search.
enum class Part : uint8_t {
  kOperand,        // stands in the tree once, in a group or as a complement
  kWall,           // stands in it once, in no group, and is no complement
  kRepeated,       // stands in it more than once
  kHoldsRepeated,  // a group that holds a repeated primitive or group
};

/// The search's verdict on an operand or a group.
enum class ProgramCounter : uint8_t {
  kSeen,       // not known to be hidden; the same holds for a group's members
  kSampled,    // a group whose first and last member are seen; the others were not judged
  kMixed,      // a group whose members have verdicts of their own
  kSealed,     // sealed, unless a seen operand reaches in
  kCancelled,  // the solid does not depend on it
};

bool is_hidden(ProgramCounter program_counter) {
  return program_counter == ProgramCounter::kSealed ||
         program_counter == ProgramCounter::kCancelled;
}

/// Returns the extent's box with the margin around it.
Box box_of(const Extent& extent, double margin) {
  const Box box = box_of(extent);
  return {box.min - margin, box.max + margin};
}

/// Judges operands by the primitives of the whole list. Belongs to one thread.
class Judge {
 public:
  Judge(const OperandGroups& groups, std::span<const CanonicalPrimitive> primitives, double margin,
        std::span<const Part> parts, std::span<ProgramCounter> program_counters)
      : groups_(groups),
        primitives_(primitives),
        margin_(margin),
        parts_(parts),
        program_counters_(program_counters),
        classifier_(primitives),
        restrictor_(groups.extents(), classifier_) {}
  Judge(const Judge&) = delete;
  Judge& operator=(const Judge&) = delete;

  /// Judges an operand that the whole list names, and what it holds. In a group of primitives, all
  /// members are judged only if the first or the last one is found to be hidden.
  void judge(uint32_t operand) {
    role_ = operand;
    judge(operand, groups_.list(), 0, Effort::kShapes);
  }

  /// Judges the members that judge() left out, of groups of primitives.
  void judge_rest(uint32_t operand) {
    role_ = operand;
    judge_rest_of(operand);
  }

 private:
  using Decision = Restrictor::Decision;

  enum class Effort : uint8_t { kBoxes, kShapes };

  /// Judges an operand. `around` equals the whole list in a cell that contains the operand; in this
  /// list the operand is, or is part of, the entry role_.
  void judge(uint32_t operand, const CellList& around, size_t depth, Effort effort) {
    const CellList& list = restricted(around, operand, depth);
    ProgramCounter program_counter = standing_by(list);
    if (effort == Effort::kShapes && program_counter == ProgramCounter::kSeen &&
        has_primitives(list) && !groups_.is_group(operand)) {
      program_counter = standing_by(narrowed(list, operand));
    }
    const bool may_go =
        parts_[operand] == Part::kOperand ||
        (parts_[operand] == Part::kWall && program_counter == ProgramCounter::kCancelled);
    if (is_hidden(program_counter) && may_go) {
      program_counters_[operand] = program_counter;
    } else if (groups_.is_union(operand) && depth < kDeepest &&
               (is_hidden(program_counter) || has_primitives(list))) {
      judge_members(operand, list, depth + 1);
    }
  }

  /// Returns the verdict on an operand in whose reach `list` equals the whole list.
  ProgramCounter standing_by(const CellList& list) {
    return !depends_on_role(list) ? ProgramCounter::kCancelled
           : holds_by_walls(list) ? ProgramCounter::kSealed
                                  : ProgramCounter::kSeen;
  }

  /// Restricts the list further, from the operand's box to the operand, which is a primitive, and
  /// the margin around it.
  const CellList& narrowed(const CellList& list, uint32_t operand) {
    const CanonicalPrimitive& primitive = primitives_[operand];
    const double radius = reach(primitive) + margin_;
    decisions_.clear();
    for (const uint32_t entry : list.primitives()) {
      const uint32_t index = entry & kPrimitiveBits;
      const auto decision = [&](const CanonicalPrimitive& other) {
        return holds_ball(other, primitive.center, radius) ? Decision::kInside
               : are_apart(other, primitive, margin_)      ? Decision::kOutside
                                                           : Decision::kOpen;
      };
      const bool is_open = groups_.is_group(index) || index == role_;
      decisions_.push_back(is_open ? Decision::kOpen : decision(primitives_[index]));
    }
    restrictor_.restrict(list, decisions_, narrowed_);
    return narrowed_;
  }

  void judge_members(uint32_t group, const CellList& list, size_t depth) {
    const std::span<const uint32_t> members = groups_.members(group).primitive;
    const uint32_t sample[] = {members.front(), members.back()};
    if (!groups_.is_group(members.front() & kPrimitiveBits) &&
        !judge_all(sample, list, depth, Effort::kBoxes)) {
      program_counters_[group] = ProgramCounter::kSampled;
    } else if (judge_all(members, list, depth, Effort::kShapes)) {
      program_counters_[group] = ProgramCounter::kMixed;
    }
  }

  /// Returns whether any of the members is not just kSeen.
  bool judge_all(std::span<const uint32_t> members, const CellList& list, size_t depth,
                 Effort effort) {
    bool is_any_hidden = false;
    for (const uint32_t entry : members) {
      const uint32_t member = entry & kPrimitiveBits;
      if (parts_[member] != Part::kRepeated) judge(member, list, depth, effort);
      is_any_hidden |= program_counters_[member] != ProgramCounter::kSeen;
    }
    return is_any_hidden;
  }

  void judge_rest_of(uint32_t operand) {
    if (!groups_.is_union(operand)) return;
    const std::span<const uint32_t> members = groups_.members(operand).primitive;
    if (program_counters_[operand] == ProgramCounter::kSampled) {
      const CellList& list = restricted(groups_.list(), operand, 0);
      if (judge_all(members, list, 1, Effort::kShapes))
        program_counters_[operand] = ProgramCounter::kMixed;
    } else if (program_counters_[operand] == ProgramCounter::kMixed) {
      for (const uint32_t entry : members) judge_rest_of(entry & kPrimitiveBits);
    }
  }

  /// Restricts the list to the operand's box and the margin around it.
  const CellList& restricted(const CellList& around, uint32_t operand, size_t depth) {
    while (lists_.size() <= depth) lists_.push_back(std::make_unique<CellList>());
    restrictor_.restrict(around, box_of(groups_.extents()[operand], margin_), *lists_[depth]);
    return *lists_[depth];
  }

  bool depends_on_role(const CellList& list) const {
    return std::ranges::any_of(
        list.primitives(), [this](uint32_t entry) { return (entry & kPrimitiveBits) == role_; });
  }

  bool is_wall(uint32_t entry) const {
    const uint32_t index = entry & kPrimitiveBits;
    return !groups_.is_group(index) && parts_[index] != Part::kOperand;
  }

  /// Returns whether the list names primitives other than role_.
  bool has_primitives(const CellList& list) const {
    return std::ranges::any_of(list.primitives(), [this](uint32_t entry) {
      const uint32_t index = entry & kPrimitiveBits;
      return !groups_.is_group(index) && index != role_;
    });
  }

  /// Returns whether the list is true wherever no operand holds.
  bool holds_by_walls(const CellList& list) {
    if (list.is_constant()) return list.root == CellList::kTrue;
    decisions_.clear();
    for (const uint32_t entry : list.primitives()) {
      decisions_.push_back(is_wall(entry) ? Decision::kOpen : Decision::kOutside);
    }
    restrictor_.restrict(list, decisions_, walls_);
    return walls_.root == CellList::kTrue;
  }

  const OperandGroups& groups_;
  const std::span<const CanonicalPrimitive> primitives_;
  const double margin_;
  const std::span<const Part> parts_;
  const std::span<ProgramCounter> program_counters_;
  WorldClassifier classifier_;
  Restrictor restrictor_;
  uint32_t role_ = 0;
  std::vector<std::unique_ptr<CellList>> lists_;  // by depth
  std::vector<Restrictor::Decision> decisions_;
  CellList narrowed_, walls_;
};

/// The whole search: judges all operands, then withdraws the verdict kSealed from those that seen
/// operands reach into.
class HiddenSearch {
 public:
  HiddenSearch(const OperandGroups& groups, std::span<const CanonicalPrimitive> primitives,
               double margin)
      : groups_(groups),
        primitives_(primitives),
        margin_(margin),
        program_counters_(groups.count()),
        parts_(groups.count(), Part::kRepeated),
        holds_sealed_(groups.count()) {
    find_parts();
    outermost_count_ = outermost_.size();
    outermost_.resize(outermost_.size() + kVectorPadding);
  }

  HiddenOperands find() {
    tbb::enumerable_thread_specific<Judge> judges(
        [this] { return Judge(groups_, primitives_, margin_, parts_, program_counters_); });
    const auto for_all = [&](auto&& act) {
      tbb::parallel_for(size_t{0}, outermost_count_,
                        [&](size_t i) { act(judges.local(), outermost_[i]); });
    };
    for_all([](Judge& judge, uint32_t operand) { judge.judge(operand); });
    const size_t least = static_cast<size_t>(kLeastHidden * groups_.member_count());
    if (gather().count() <= least) return {};
    for_all([](Judge& judge, uint32_t operand) { judge.judge_rest(operand); });
    unseal();
    HiddenOperands hidden = gather();
    return hidden.count() > least ? std::move(hidden) : HiddenOperands{};
  }

 private:
  void find_parts() {
    std::vector<uint8_t> uses(groups_.count());
    const auto count = [&uses](std::span<const uint32_t> entries) {
      for (const uint32_t entry : entries) {
        uint8_t& number = uses[entry & kPrimitiveBits];
        number = static_cast<uint8_t>(std::min(number + 1, 2));
      }
    };
    const std::span<const uint32_t> in_list = groups_.list().primitives();
    count(in_list);
    for (uint32_t group = groups_.first_group(); group < groups_.count(); ++group) {
      count(groups_.members(group).primitive);
    }
    for (uint32_t index = 0; index < groups_.count(); ++index) {
      if (uses[index] == 1) parts_[index] = Part::kOperand;
    }
    for (const uint32_t entry : in_list) {
      const uint32_t index = entry & kPrimitiveBits;
      if (uses[index] != 1) continue;
      const bool is_complement = (entry & CellList::kComplementBit) != 0;
      if (!groups_.is_group(index) && !is_complement) parts_[index] = Part::kWall;
      outermost_.push_back(index);
    }
    // A group has a larger index than its members.
    for (uint32_t group = groups_.first_group(); group < groups_.count(); ++group) {
      const bool has_repeated =
          std::ranges::any_of(groups_.members(group).primitive, [this](uint32_t entry) {
            const Part part = parts_[entry & kPrimitiveBits];
            return part == Part::kRepeated || part == Part::kHoldsRepeated;
          });
      if (has_repeated) parts_[group] = Part::kHoldsRepeated;
    }
  }

  std::span<const uint32_t> outermost() const {
    return std::span(outermost_).first(outermost_count_);
  }

  /// Returns the verdicts, with those of hidden groups handed on to their members: of groups that
  /// are unions, or of all groups.
  std::vector<ProgramCounter> spread(bool of_all) const {
    std::vector<ProgramCounter> program_counters = program_counters_;
    for (uint32_t group = groups_.count(); group-- > groups_.first_group();) {
      if (!is_hidden(program_counters[group]) || !(of_all || groups_.is_union(group))) continue;
      for (const uint32_t entry : groups_.members(group).primitive) {
        program_counters[entry & kPrimitiveBits] = program_counters[group];
      }
    }
    return program_counters;
  }

  HiddenOperands gather() const {
    const std::vector<ProgramCounter> program_counters = spread(true);
    HiddenOperands hidden;
    for (uint32_t primitive = 0; primitive < groups_.first_group(); ++primitive) {
      if (program_counters[primitive] == ProgramCounter::kSealed)
        hidden.inside.push_back(primitive);
      if (program_counters[primitive] == ProgramCounter::kCancelled)
        hidden.cancelled.push_back(primitive);
    }
    return hidden;
  }

  /// Withdraws kSealed until no seen operand reaches into a sealed one. From here on a group that
  /// is no union counts as one operand, and of a union only the members count.
  void unseal() {
    program_counters_ = spread(false);
    for (uint32_t index = 0; index < groups_.count(); ++index) {
      if (!groups_.is_union(index)) {
        holds_sealed_[index] = program_counters_[index] == ProgramCounter::kSealed;
        continue;
      }
      program_counters_[index] = ProgramCounter::kMixed;  // its own verdict was handed on
      holds_sealed_[index] = std::ranges::any_of(
          groups_.members(index).primitive,
          [this](uint32_t entry) { return holds_sealed_[entry & kPrimitiveBits] != 0; });
    }
    steps_left_ = kMostSteps * groups_.member_count() + kStepsInAnyCase;
    std::vector<uint32_t> seen = seen_near_sealed();
    while (!seen.empty() && steps_left_ > 0) {
      const uint32_t operand = seen.back();
      seen.pop_back();
      for (const uint32_t other : sealed_near(operand)) {
        program_counters_[other] = ProgramCounter::kSeen;
        holds_sealed_[other] = 0;
        seen.push_back(other);
      }
    }
    if (steps_left_ == 0)
      std::ranges::replace(program_counters_, ProgramCounter::kSealed, ProgramCounter::kSeen);
  }

  /// Returns the seen operands that may reach into sealed ones.
  std::vector<uint32_t> seen_near_sealed() {
    std::vector<uint32_t> seen;
    std::vector<uint32_t> pending(outermost().begin(), outermost().end());
    while (!pending.empty()) {
      const uint32_t operand = pending.back();
      pending.pop_back();
      if (!groups_.is_union(operand)) {
        const bool is_seen = program_counters_[operand] == ProgramCounter::kSeen;
        if (is_seen && parts_[operand] != Part::kWall) seen.push_back(operand);
      } else if (holds_sealed_[operand] || !sealed_near(operand).empty()) {
        for (const uint32_t entry : groups_.members(operand).primitive) {
          pending.push_back(entry & kPrimitiveBits);
        }
      }
    }
    return seen;
  }

  /// Returns the sealed operands in this operand's reach, as far as there are steps left. The span
  /// is valid until the next call.
  std::span<const uint32_t> sealed_near(uint32_t operand) {
    near_.clear();
    const Extent* const extents = groups_.extents().data();
    const Box box = box_of(extents[operand], margin_);
    pending_.assign(1, outermost());
    while (!pending_.empty() && steps_left_ > 0) {
      // All of these spans are followed by the padding that vectors read.
      const std::span<const uint32_t> operands = pending_.back();
      pending_.pop_back();
      for (size_t first = 0; first < operands.size(); first += kAtOnce) {
        const uint32_t* const part = operands.data() + first;
        const auto count = static_cast<uint32_t>(std::min(operands.size() - first, kAtOnce));
        take_step();
        uint64_t near = ~test_extents(extents, part, count, {box, box, 0}).outside[0];
        for (near &= first_bits(count); near != 0; near &= near - 1) {
          const uint32_t other = part[std::countr_zero(near)] & kPrimitiveBits;
          if (!holds_sealed_[other]) continue;
          take_step();
          if (are_apart(operand, other)) continue;
          if (groups_.is_union(other)) {
            pending_.push_back(groups_.members(other).primitive);
          } else {
            near_.push_back(other);
          }
        }
      }
    }
    return near_;
  }

  void take_step() { steps_left_ -= steps_left_ > 0; }

  /// Returns whether two operands are certainly separated by the margin. For a group, only its box
  /// is tested.
  bool are_apart(uint32_t a, uint32_t b) const {
    if (groups_.is_group(a)) return false;
    if (groups_.is_group(b)) return is_beside(a, b);
    // For long and thin primitives, the boxes find more separations.
    return csgcore::are_apart(primitives_[a], primitives_[b], margin_) || is_beside(a, b) ||
           is_beside(b, a);
  }

  /// Returns whether the primitive is disjoint from the other's box and the margin around it.
  bool is_beside(uint32_t primitive, uint32_t other) const {
    const Box box = box_of(groups_.extents()[other], margin_);
    return classify(primitives_[primitive], box) == Classification::kOutside;
  }

  const OperandGroups& groups_;
  const std::span<const CanonicalPrimitive> primitives_;
  const double margin_;
  // By index, of primitives and groups:
  std::vector<ProgramCounter> program_counters_;
  std::vector<Part> parts_;
  std::vector<uint8_t> holds_sealed_;  // sealed, or a union of which a member holds one
  std::vector<uint32_t> outermost_;    // named by the whole list; then the vectors' padding
  size_t outermost_count_ = 0;
  size_t steps_left_ = 0;       // for unseal()
  std::vector<uint32_t> near_;  // the result of sealed_near()
  std::vector<std::span<const uint32_t>> pending_;
};

}  // namespace

HiddenOperands find_hidden_operands(const OperandGroups& groups,
                                    std::span<const CanonicalPrimitive> primitives, double margin) {
  const bool has_groups = groups.count() > groups.first_group();
  if (!has_groups || groups.list().count() > kLongestList) return {};
  return HiddenSearch(groups, primitives, margin).find();
}

}  // namespace csgcore
