// Operands are what may be left out: what stands in groups, or takes away, once. Walls are the
// other primitives of the whole list. By f the solid's value is meant, as a function of who holds a
// point.
//
// Cancelled is who changes f nowhere in its reach, whatever the operands do that reach in there. It
// may go, and so may all of them: if one is cancelled because another holds it, that other, should
// it be cancelled too, changes nothing there either.
//
// Sealed is who stands where f is true if no operand holds, and into whom no operand reaches that
// is not sealed itself. About all the sealed together runs a border that none of them gets to. No
// other operand does: there f is as if none held, and so the solid holds. A ray from outside has
// ended when it gets there. Without the sealed, f is true throughout within, and as before
// elsewhere. (Who takes away and holds all of a sealed one's place counts with what it is there. If
// it is sealed itself, then f is true there without it, too.)
//
// Reach means the primitive, or the box of a group, and the margin about it.
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

/// Fewer of the operands in groups than this share are not worth lists of their own.
constexpr double kLeastHidden = 0.25;

/// As many as have bits in a word.
constexpr size_t kAtOnce = 64;

/// To find who reaches into what is sealed takes so many steps at most for each operand: where much
/// is connected with the outside, it may take a thousand.
constexpr size_t kMostSteps = 4;
constexpr size_t kStepsInAnyCase = size_t{1} << 14;

/// In a longer list nobody is judged: for each group and operand of the list, all of it is asked.
constexpr uint32_t kLongestList = 1024;

/// Groups nested deeper are not judged.
constexpr size_t kDeepest = 32;

/// What a primitive or group is to the search.
enum class Part : uint8_t {
  kOperand,        // stands in the tree once, in a group or as a complement
  kWall,           // stands in it once, by itself, and is no complement
  kRepeated,       // stands in it more than once
  kHoldsRepeated,  // of a group: holds what is
};

/// Of an operand, or of a group.
enum class ProgramCounter : uint8_t {
  kSeen,       // of all that is known; of a group, so are its members
  kSampled,    // of a group: so are its first and its last member, the others were not asked
  kMixed,      // of a group: its members have their own
  kSealed,     // would be surrounded by the solid if nothing seen reached in
  kCancelled,  // the solid does not depend on it
};

bool is_hidden(ProgramCounter program_counter) {
  return program_counter == ProgramCounter::kSealed ||
         program_counter == ProgramCounter::kCancelled;
}

/// And the margin about it.
Box box_of(const Extent& extent, double margin) {
  const Box box = box_of(extent);
  return {box.min - margin, box.max + margin};
}

/// Judges operands by the primitives of the whole list.
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

  /// What stands in the whole list. Of a group of primitives all are asked if its first or its last
  /// member is found to be hidden.
  void judge(uint32_t operand) {
    role_ = operand;
    judge(operand, groups_.list(), 0, Effort::kShapes);
  }

  /// Asks the members that were not asked, of groups of primitives.
  void judge_rest(uint32_t operand) {
    role_ = operand;
    judge_rest_of(operand);
  }

 private:
  using Decision = Restrictor::Decision;

  enum class Effort : uint8_t { kBoxes, kShapes };

  /// `around` equals the whole list in a cell that holds the operand, in which role_ stands for it.
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

  /// Of who is where the list equals the whole.
  ProgramCounter standing_by(const CellList& list) {
    return !depends_on_role(list) ? ProgramCounter::kCancelled
           : holds_by_walls(list) ? ProgramCounter::kSealed
                                  : ProgramCounter::kSeen;
  }

  /// From the operand's box to the operand, a primitive, and the margin around it.
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

  /// Whether any is hidden.
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

  /// To the operand's box, and the margin around it.
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

  /// Others than the role.
  bool has_primitives(const CellList& list) const {
    return std::ranges::any_of(list.primitives(), [this](uint32_t entry) {
      const uint32_t index = entry & kPrimitiveBits;
      return !groups_.is_group(index) && index != role_;
    });
  }

  /// Whether the list is true wherever no operand holds.
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

/// What was judged, and what becomes of it where operands that are seen reach in.
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
    // Groups come after what they hold.
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

  /// Hands the program_counters of hidden groups on to what they hold; of unions only, or of all.
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

  /// Until nothing that is seen reaches into what is sealed. From here on a group that is no union
  /// is one operand, and of the others only their members count.
  void unseal() {
    program_counters_ = spread(false);
    for (uint32_t index = 0; index < groups_.count(); ++index) {
      if (!groups_.is_union(index)) {
        holds_sealed_[index] = program_counters_[index] == ProgramCounter::kSealed;
        continue;
      }
      program_counters_[index] = ProgramCounter::kMixed;  // its own was handed on
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

  /// Operands that are seen and may reach into what is sealed.
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

  /// The sealed operands within the margin of this one's reach, as far as there are steps left.
  /// Valid until the next call.
  std::span<const uint32_t> sealed_near(uint32_t operand) {
    near_.clear();
    const Extent* const extents = groups_.extents().data();
    const Box box = box_of(extents[operand], margin_);
    pending_.assign(1, outermost());
    while (!pending_.empty() && steps_left_ > 0) {
      // Behind all of these vectors may read.
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

  /// Of groups that only their boxes are, if at all.
  bool are_apart(uint32_t a, uint32_t b) const {
    if (groups_.is_group(a)) return false;
    if (groups_.is_group(b)) return is_beside(a, b);
    // Of what is long and thin, boxes tell more.
    return csgcore::are_apart(primitives_[a], primitives_[b], margin_) || is_beside(a, b) ||
           is_beside(b, a);
  }

  /// Whether the primitive is apart from the other's box.
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
  std::vector<uint8_t> holds_sealed_;  // is sealed, or is a union of which some member does
  std::vector<uint32_t> outermost_;    // of the whole list; and the vectors' padding
  size_t outermost_count_ = 0;
  size_t steps_left_ = 0;       // of unseal
  std::vector<uint32_t> near_;  // sealed_near
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
