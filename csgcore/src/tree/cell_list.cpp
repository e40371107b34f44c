#include "tree/cell_list.hpp"

#include <algorithm>

namespace csgcore {

static_assert(kPrimitiveBits == ~CellList::kComplementBit);

void CellList::reserve(uint32_t tests) {
  if (primitive.size() >= size_t{tests} + kVectorPadding) return;
  primitive.resize(size_t{tests} + kVectorPadding);
  if_inside.resize(tests);
  if_outside.resize(tests);
}

void CellList::finish(uint32_t last_root) {
  root = last_root;
  if (!is_constant()) std::fill_n(primitive.data() + count(), kVectorPadding, primitive[0]);
}

void assign(CellList& list, std::span<const BlistTest> tests) {
  const uint32_t count = static_cast<uint32_t>(tests.size());
  list.reserve(count);
  const auto number = [&](uint32_t target) {
    if (target == kListTrue) return CellList::kTrue;
    if (target == kListFalse) return CellList::kFalse;
    return CellList::kFirst + count - 1 - target;
  };
  for (uint32_t i = 0; i < count; ++i) {
    const BlistTest& test = tests[count - 1 - i];
    list.primitive[i] = test.primitive | (test.complement ? CellList::kComplementBit : 0);
    list.if_inside[i] = number(test.if_inside);
    list.if_outside[i] = number(test.if_outside);
  }
  list.finish(CellList::kFirst + count - 1);
}

void append(std::vector<BlistTest>& tests, const CellList& list) {
  const auto position = [&](uint32_t number) {
    if (number == CellList::kTrue) return kListTrue;
    if (number == CellList::kFalse) return kListFalse;
    return list.root - number;
  };
  for (uint32_t i = list.count(); i-- > 0;) {
    BlistTest test;
    test.primitive = list.primitive[i] & kPrimitiveBits;
    test.complement = (list.primitive[i] & CellList::kComplementBit) != 0;
    test.if_inside = position(list.if_inside[i]);
    test.if_outside = position(list.if_outside[i]);
    tests.push_back(test);
  }
}

bool is_union(const CellList& list) {
  // The test at index 0 is the last one, which may have any targets.
  for (uint32_t i = list.count(); i-- > 1;) {
    const bool complement = (list.primitive[i] & CellList::kComplementBit) != 0;
    if ((complement ? list.if_outside[i] : list.if_inside[i]) != CellList::kTrue) return false;
  }
  return true;
}

}  // namespace csgcore
