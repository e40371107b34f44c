#include "csgcore/solid.hpp"

#include <glm/common.hpp>
#include <utility>

#include "cell_list.hpp"

namespace csgcore {
namespace {

Box bounds_of(const CanonicalPrimitives& primitives, const CsgTree& tree) {
  std::vector<Box> stack;
  for (const CsgToken& token : tree.tokens()) {
    if (token.is_primitive) {
      stack.push_back(primitives[token.value].bounds);
      continue;
    }
    const size_t first = stack.size() - token.value;
    Box box = stack[first];
    for (size_t i = first + 1; i < stack.size() && token.op != Op::kDifference; ++i) {
      if (token.op == Op::kUnion) {
        if (!stack[i].empty()) box.merge(stack[i]);
      } else {
        box = {glm::max(box.min, stack[i].min), glm::min(box.max, stack[i].max)};
      }
    }
    if (box.empty()) box = Box{};
    stack.resize(first);
    stack.push_back(box);
  }
  return stack.empty() ? Box{} : stack.back();
}

}  // namespace

std::shared_ptr<const CanonicalPrimitives> canonical_primitives(const Scene& scene) {
  auto result = std::make_shared<CanonicalPrimitives>();
  result->reserve(scene.primitives.size());
  for (const Primitive& primitive : scene.primitives) result->push_back(canonicalize(primitive));
  return result;
}

Solid::Solid(std::shared_ptr<const CanonicalPrimitives> primitives, const CsgTree& tree)
    : primitives_(std::move(primitives)),
      list_(compile(tree)),
      bounds_(bounds_of(*primitives_, tree)) {
  if (tree.empty()) return;
  auto list = std::make_shared<CellList>();
  assign(*list, list_.literals);
  cell_list_ = std::move(list);
  extents_.reserve(primitives_->size());
  for (const CanonicalPrimitive& primitive : *primitives_) {
    extents_.push_back(extent_of(primitive));
  }
}

bool Solid::contains(const Vec3& point) const {
  if (list_.literals.empty()) return list_.constant;
  return evaluate(std::span<const Literal>(list_.literals), [&](uint32_t primitive) {
    return csgcore::contains((*primitives_)[primitive], point);
  });
}

}  // namespace csgcore
