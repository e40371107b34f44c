#include "restriction.hpp"

namespace csgcore {

/// Forward: only what an evaluation within the cell can reach is classified, so that a whole operand
/// that a decided one makes irrelevant costs nothing.
void Restrictor::classify_reached(std::span<const Literal> list, const Box& cell) {
  states_.assign(list.size(), State::kUnreached);
  states_[0] = State::kReached;
  const auto reach = [&](uint32_t target) {
    if (target < kListFalse) states_[target] = State::kReached;
  };
  for (size_t i = 0; i < list.size(); ++i) {
    if (states_[i] == State::kUnreached) continue;
    const Literal& literal = list[i];
    switch (classify(primitives_[literal.primitive], cell)) {
      case Classification::kInside:
        states_[i] = State::kInside;
        reach(literal.if_inside);
        break;
      case Classification::kOutside:
        states_[i] = State::kOutside;
        reach(literal.if_outside);
        break;
      case Classification::kCrosses:
        states_[i] = State::kCrosses;
        reach(literal.if_inside);
        reach(literal.if_outside);
        break;
    }
  }
}

uint32_t Restrictor::restrict(std::span<const Literal> list, const Box& cell,
                              std::vector<Literal>& out) {
  const uint32_t count = static_cast<uint32_t>(list.size());
  classify_reached(list, cell);
  // Backward (bottom up): a decided literal is replaced by what follows it, and so is one whose two
  // continuations have become the same.
  if (map_.size() < count) {
    map_.resize(count);
    kept_index_.resize(count);
  }
  kept_.clear();
  for (uint32_t i = count; i-- > 0;) {
    if (states_[i] == State::kUnreached) continue;
    const uint32_t inside = resolve(list[i].if_inside);
    const uint32_t outside = resolve(list[i].if_outside);
    if (states_[i] == State::kInside) {
      map_[i] = inside;
    } else if (states_[i] == State::kOutside || inside == outside) {
      map_[i] = outside;
    } else {
      map_[i] = i;
      kept_index_[i] = static_cast<uint32_t>(kept_.size());
      Literal literal = list[i];
      literal.if_inside = inside;
      literal.if_outside = outside;
      kept_.push_back(literal);
    }
  }
  if (map_[0] >= kListFalse) return map_[0];
  const uint32_t kept = static_cast<uint32_t>(kept_.size());
  const auto renumber = [&](uint32_t target) {
    return target >= kListFalse ? target : kept - 1 - kept_index_[target];
  };
  for (uint32_t i = kept; i-- > 0;) {
    Literal literal = kept_[i];
    literal.if_inside = renumber(literal.if_inside);
    literal.if_outside = renumber(literal.if_outside);
    out.push_back(literal);
  }
  return kept;
}

}  // namespace csgcore
