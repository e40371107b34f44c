#include "solid/restriction.hpp"

#include <algorithm>
#include <bit>

namespace csgcore {

namespace {

/// So many tests of a list are classified at once.
constexpr uint32_t kBlock = 64;

/// One pass over a list, bottom up, for one side: a decided test is replaced by the target that it
/// leads to, and so is a test whose two targets have become the same. Every test is written and
/// only the kept ones advance the output: what happens to a test is close to random, and a
/// mispredicted branch costs more than all of this.
class Pass {
 public:
  /// `most` bounds the number of tests of the result.
  Pass(const CellList& list, uint32_t most, CellList& result, std::vector<uint32_t>& map) {
    result.reserve(most);
    if (map.size() <= list.root) map.resize(size_t{list.root} + 1);
    map[CellList::kFalse] = CellList::kFalse;
    map[CellList::kTrue] = CellList::kTrue;
    map_ = map.data();
    primitive_ = result.primitive.data();
    if_inside_ = result.if_inside.data();
    if_outside_ = result.if_outside.data();
  }

  /// The number in the result that stands for a number of the list.
  uint32_t& at(uint32_t number) { return map_[number]; }

  /// Passes the test `number` of the list.
  void step(uint32_t number, uint32_t primitive, uint32_t if_inside, uint32_t if_outside,
            bool outside, bool inside) {
    map_[number] = put(primitive, map_[if_inside], map_[if_outside], outside, inside);
  }

  /// Adds a test with the targets `inner` and `outer`, which are numbers of the result. Returns the
  /// number that stands for it there.
  uint32_t put(uint32_t primitive, uint32_t inner, uint32_t outer, bool outside, bool inside) {
    primitive_[kept_] = primitive;
    if_inside_[kept_] = inner;
    if_outside_[kept_] = outer;
    const bool kept = !(outside | inside) & (inner != outer);
    const uint32_t replacement = inside ? inner : outer;
    const uint32_t number = kept_ + CellList::kFirst;
    kept_ += kept;
    return kept ? number : replacement;
  }

 private:
  uint32_t* map_;
  uint32_t* primitive_;
  uint32_t* if_inside_;
  uint32_t* if_outside_;
  uint32_t kept_ = 0;
};

}  // namespace

OpenClassifier::Answers WorldClassifier::classify(const uint32_t* primitives, uint64_t open,
                                                  const Box& cell) const {
  Answers answers;
  for (; open != 0; open &= open - 1) {
    const uint32_t primitive = primitives[std::countr_zero(open)] & kPrimitiveBits;
    const uint64_t bit = open & -open;
    const Classification answer = classify_within_bounds(primitives_[primitive], cell);
    if (answer == Classification::kOutside) answers.outside |= bit;
    if (answer == Classification::kInside) answers.inside |= bit;
  }
  return answers;
}

void Restrictor::restrict(const CellList& list, const Halves& halves, CellList& below,
                          CellList& above) {
  CellList* const results[] = {&below, &above};
  restrict_sides<2>(list, halves, results);
}

void Restrictor::restrict(const CellList& list, const Box& cell, CellList& result) {
  CellList* const results[] = {&result};
  restrict_sides<1>(list, {cell, cell, 0}, results);
}

bool Restrictor::decides_none(const CellList& list, const Box& cell) const {
  const uint32_t count = list.count();
  for (uint32_t first = 0; first < count; first += kBlock) {
    const uint32_t size = std::min(count - first, kBlock);
    const ExtentAnswers answers =
        answers_of<1>(list.primitive.data() + first, size, {cell, cell, 0});
    if (((answers.outside[0] | answers.inside[0]) & first_bits(size)) != 0) return false;
  }
  return true;
}

void Restrictor::restrict(const CellList& list, std::span<const Decision> decisions,
                          CellList& result) {
  Pass pass(list, list.count(), result, maps_[0]);
  for (uint32_t i = 0; i < list.count(); ++i) {
    pass.step(i + CellList::kFirst, list.primitive[i], list.if_inside[i], list.if_outside[i],
              decisions[i] == Decision::kOutside, decisions[i] == Decision::kInside);
  }
  result.finish(maps_[0][list.root]);
  drop_unreached(result);
}

void Restrictor::open(const CellList& list, const OperandGroups& groups,
                      std::span<const uint8_t> marked, const Box& cell, CellList& result) {
  uint32_t most = list.count();
  for (uint32_t i = 0; i < list.count(); ++i) {
    if (!marked[i]) continue;
    most += groups.members(list.primitive[i] & kPrimitiveBits).primitive.size();
  }
  Pass pass(list, most, result, maps_[0]);
  std::vector<uint32_t>& map = maps_[1];  // by numbers of a group's own list
  for (uint32_t i = 0; i < list.count(); ++i) {
    const uint32_t number = i + CellList::kFirst;
    const uint32_t entry = list.primitive[i];
    if (!marked[i]) {
      pass.step(number, entry, list.if_inside[i], list.if_outside[i], false, false);
      continue;
    }
    const OperandGroups::Members members = groups.members(entry & kPrimitiveBits);
    const uint32_t count = static_cast<uint32_t>(members.primitive.size());
    const uint32_t complement = entry & CellList::kComplementBit;
    if (members.is_union) {
      const uint32_t inner = pass.at(list.if_inside[i]);
      uint32_t outer = pass.at(list.if_outside[i]);
      for (uint32_t first = 0; first < count; first += kBlock) {
        const uint32_t size = std::min(count - first, kBlock);
        const ExtentAnswers answers = answers_of_members(members, first, size, cell);
        uint64_t left = ~answers.outside[0] & first_bits(size);
        for (; left != 0; left &= left - 1) {
          const int bit = std::countr_zero(left);
          outer = pass.put(members.primitive[first + static_cast<uint32_t>(bit)] ^ complement,
                           inner, outer, false, (answers.inside[0] >> bit) & 1);
        }
      }
      pass.at(number) = outer;
      continue;
    }
    if (map.size() < count + CellList::kFirst) map.resize(count + CellList::kFirst);
    map[CellList::kFalse] = pass.at(list.if_outside[i]);
    map[CellList::kTrue] = pass.at(list.if_inside[i]);
    for (uint32_t first = 0; first < count; first += kBlock) {
      const uint32_t size = std::min(count - first, kBlock);
      const ExtentAnswers answers = answers_of_members(members, first, size, cell);
      for (uint32_t bit = 0, k = first; bit < size; ++bit, ++k) {
        map[k + CellList::kFirst] =
            pass.put(members.primitive[k] ^ complement, map[members.if_inside[k]],
                     map[members.if_outside[k]], (answers.outside[0] >> bit) & 1,
                     (answers.inside[0] >> bit) & 1);
      }
    }
    pass.at(number) = map[count - 1 + CellList::kFirst];
  }
  result.finish(maps_[0][list.root]);
  drop_unreached(result);
}

ExtentAnswers Restrictor::answers_of_members(const OperandGroups::Members& members, uint32_t first,
                                             uint32_t count, const Box& cell) const {
  if (const auto outside = open_->members_outside(members, first, count, cell)) {
    return {{*outside, *outside}, {0, 0}, 0};
  }
  return answers_of<1>(members.primitive.data() + first, count, {cell, cell, 0});
}

template <int kSides>
ExtentAnswers Restrictor::answers_of(const uint32_t* primitives, uint32_t count,
                                     const Halves& halves) const {
  constexpr int kLast = kSides - 1;
  ExtentAnswers answers = test_extents(extents_.data(), primitives, count, halves);
  // Balls are decided by their extents alone. Other primitives are classified only if they reach
  // both halves: one that reaches a single half was found to cross the whole cell, and so crosses
  // that half.
  const uint64_t open = answers.open & ~answers.outside[0] & ~answers.outside[kLast];
  for (int side = 0; open != 0 && side < kSides; ++side) {
    const auto more = open_->classify(primitives, open, side == 0 ? halves.below : halves.above);
    answers.outside[side] |= more.outside;
    answers.inside[side] |= more.inside;
  }
  return answers;
}

template <int kSides>
void Restrictor::restrict_sides(const CellList& list, const Halves& halves,
                                CellList* const* results) {
  constexpr int kLast = kSides - 1;
  const uint32_t count = list.count();
  const uint32_t* const primitive = list.primitive.data();
  const uint32_t* const if_inside = list.if_inside.data();
  const uint32_t* const if_outside = list.if_outside.data();
  Pass below(list, count, *results[0], maps_[0]);
  Pass above(list, count, *results[kLast], maps_[kLast]);
  for (uint32_t first = 0; first < count; first += kBlock) {
    const uint32_t size = std::min(count - first, kBlock);
    const ExtentAnswers answers = answers_of<kSides>(primitive + first, size, halves);
    for (uint32_t bit = 0, i = first; bit < size; ++bit, ++i) {
      const auto step = [&](Pass& pass, int side) {
        pass.step(i + CellList::kFirst, primitive[i], if_inside[i], if_outside[i],
                  (answers.outside[side] >> bit) & 1, (answers.inside[side] >> bit) & 1);
      };
      step(below, 0);
      if (kSides == 2) step(above, 1);
    }
  }
  for (int side = 0; side < kSides; ++side) {
    results[side]->finish(maps_[side][list.root]);
    drop_unreached(*results[side]);
  }
}

/// Returns whether some jump leads to each test but the root.
bool Restrictor::all_have_jumps(const CellList& list) {
  reached_.assign(list.root + 1, 0);
  for (uint32_t i = 0; i < list.count(); ++i) {
    reached_[list.if_inside[i]] = 1;
    reached_[list.if_outside[i]] = 1;
  }
  return std::find(reached_.begin() + CellList::kFirst, reached_.end() - 1, 0u) ==
         reached_.end() - 1;
}

/// Drops tests that evaluation cannot reach: if an operand has been decided, its later tests may
/// have lost every jump to them. If some jump leads to each test but the root, then all tests are
/// reached, since the way back along such jumps can only end at the root.
void Restrictor::drop_unreached(CellList& list) {
  if (list.is_constant() || all_have_jumps(list)) return;
  reached_.assign(list.root + 1, 0);
  reached_[list.root] = 1;
  for (uint32_t i = list.count(); i-- > 0;) {
    const uint32_t is_reached = reached_[i + CellList::kFirst];
    reached_[list.if_inside[i]] |= is_reached;
    reached_[list.if_outside[i]] |= is_reached;
  }
  reached_[CellList::kFalse] = CellList::kFalse;
  reached_[CellList::kTrue] = CellList::kTrue;
  uint32_t next = CellList::kFirst;
  for (uint32_t i = 0; i < list.count(); ++i) {
    uint32_t& entry = reached_[i + CellList::kFirst];
    if (entry == 0) continue;
    const uint32_t index = next - CellList::kFirst;
    list.primitive[index] = list.primitive[i];
    list.if_inside[index] = reached_[list.if_inside[i]];
    list.if_outside[index] = reached_[list.if_outside[i]];
    entry = next++;
  }
  list.finish(next - 1);
}

}  // namespace csgcore
