#include "tree/cell_list.hpp"

#include <algorithm>

namespace csgcore {

static_assert(kPrimitiveBits == ~CellList::kComplementBit);

void CellList::reserve(uint32_t literals) {
  if (primitive.size() >= size_t{literals} + kVectorPadding) return;
  primitive.resize(size_t{literals} + kVectorPadding);
  if_inside.resize(literals);
  if_outside.resize(literals);
}

void CellList::finish(uint32_t last_root) {
  root = last_root;
  if (!is_constant()) std::fill_n(primitive.data() + count(), kVectorPadding, primitive[0]);
}

void assign(CellList& list, std::span<const Literal> literals) {
  const uint32_t count = static_cast<uint32_t>(literals.size());
  list.reserve(count);
  const auto number = [&](uint32_t target) {
    if (target == kListTrue) return CellList::kTrue;
    if (target == kListFalse) return CellList::kFalse;
    return CellList::kFirst + count - 1 - target;
  };
  for (uint32_t i = 0; i < count; ++i) {
    const Literal& literal = literals[count - 1 - i];
    list.primitive[i] = literal.primitive | (literal.complement ? CellList::kComplementBit : 0);
    list.if_inside[i] = number(literal.if_inside);
    list.if_outside[i] = number(literal.if_outside);
  }
  list.finish(CellList::kFirst + count - 1);
}

void append(std::vector<Literal>& literals, const CellList& list) {
  const auto position = [&](uint32_t number) {
    if (number == CellList::kTrue) return kListTrue;
    if (number == CellList::kFalse) return kListFalse;
    return list.root - number;
  };
  for (uint32_t i = list.count(); i-- > 0;) {
    Literal literal;
    literal.primitive = list.primitive[i] & kPrimitiveBits;
    literal.complement = (list.primitive[i] & CellList::kComplementBit) != 0;
    literal.if_inside = position(list.if_inside[i]);
    literal.if_outside = position(list.if_outside[i]);
    literals.push_back(literal);
  }
}

bool is_union(const CellList& list) {
  // The literal at index 0 is the last one, which may end either way.
  for (uint32_t i = list.count(); i-- > 1;) {
    const bool complement = (list.primitive[i] & CellList::kComplementBit) != 0;
    if ((complement ? list.if_outside[i] : list.if_inside[i]) != CellList::kTrue) return false;
  }
  return true;
}

}  // namespace csgcore
