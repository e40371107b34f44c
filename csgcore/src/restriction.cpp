#include "restriction.hpp"

#include <algorithm>
#include <bit>

namespace csgcore {

namespace {

/// One side's pass over the list, bottom up: a decided literal is replaced by what follows it, and
/// so is one whose two continuations have become the same. Every literal is written and only the
/// kept ones advance the output: what happens to a literal is close to random, and a mispredicted
/// branch costs more than all of this.
class Pass {
 public:
  Pass(const CellList& list, CellList& result, std::vector<uint32_t>& map) {
    result.reserve(list.count());
    if (map.size() <= list.root) map.resize(size_t{list.root} + 1);
    map[CellList::kFalse] = CellList::kFalse;
    map[CellList::kTrue] = CellList::kTrue;
    map_ = map.data();
    primitive_ = result.primitive.data();
    if_inside_ = result.if_inside.data();
    if_outside_ = result.if_outside.data();
  }

  /// Literal `number` of the list.
  void step(uint32_t number, uint32_t primitive, uint32_t if_inside, uint32_t if_outside,
            bool outside, bool inside) {
    const uint32_t inner = map_[if_inside];
    const uint32_t outer = map_[if_outside];
    primitive_[kept_] = primitive;
    if_inside_[kept_] = inner;
    if_outside_[kept_] = outer;
    const bool kept = !(outside | inside) & (inner != outer);
    const uint32_t replacement = inside ? inner : outer;
    map_[number] = kept ? kept_ + CellList::kFirst : replacement;
    kept_ += kept;
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

void Restrictor::restrict(const CellList& list, std::span<const Decision> decisions,
                          CellList& result) {
  Pass pass(list, result, maps_[0]);
  for (uint32_t i = 0; i < list.count(); ++i) {
    pass.step(i + CellList::kFirst, list.primitive[i], list.if_inside[i], list.if_outside[i],
              decisions[i] == Decision::kOutside, decisions[i] == Decision::kInside);
  }
  result.finish(maps_[0][list.root]);
  drop_unreached(result);
}

template <int kSides>
void Restrictor::restrict_sides(const CellList& list, const Halves& halves,
                                CellList* const* results) {
  constexpr uint32_t kBlock = 64;
  constexpr int kLast = kSides - 1;
  const uint32_t count = list.count();
  const uint32_t* const primitive = list.primitive.data();
  const uint32_t* const if_inside = list.if_inside.data();
  const uint32_t* const if_outside = list.if_outside.data();
  Pass below(list, *results[0], maps_[0]);
  Pass above(list, *results[kLast], maps_[kLast]);
  for (uint32_t first = 0; first < count; first += kBlock) {
    const uint32_t size = std::min(count - first, kBlock);
    const auto test = kSides == 2 && space_ == Space::kScreen ? test_boxes : test_extents;
    ExtentAnswers answers = test(extents_.data(), primitive + first, size, halves);
    // Balls are decided by their extents alone. Of the others, only those that reach both halves
    // need to be asked about: what reaches one half only was found to cross the whole cell, and so
    // crosses that half.
    const uint64_t open = answers.open & ~answers.outside[0] & ~answers.outside[kLast];
    for (int side = 0; open != 0 && side < kSides; ++side) {
      const auto more =
          open_.classify(primitive + first, open, side == 0 ? halves.below : halves.above);
      answers.outside[side] |= more.outside;
      answers.inside[side] |= more.inside;
    }
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

/// Whether some jump leads to each literal but the root.
bool Restrictor::all_have_jumps(const CellList& list) {
  constexpr uint32_t kWordBits = 64;
  if (list.root < kWordBits) {
    uint64_t targets = 0;
    for (uint32_t i = 0; i < list.count(); ++i) {
      targets |= uint64_t{1} << list.if_inside[i] | uint64_t{1} << list.if_outside[i];
    }
    const uint64_t below_root = (uint64_t{1} << list.root) - 1;
    return (targets >> CellList::kFirst) == (below_root >> CellList::kFirst);
  }
  reached_.assign(list.root + 1, 0);
  for (uint32_t i = 0; i < list.count(); ++i) {
    reached_[list.if_inside[i]] = 1;
    reached_[list.if_outside[i]] = 1;
  }
  return std::find(reached_.begin() + CellList::kFirst, reached_.end() - 1, 0u) ==
         reached_.end() - 1;
}

/// Where an operand has been decided, its later literals may have lost every jump to them. If each
/// literal but the root has one, then all are reached, since the way back along such jumps ends at
/// the root only.
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
