#include "csgcore/solid.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <utility>

#include "cell_list.hpp"
#include "operand_groups.hpp"
#include "subtree_boxes.hpp"

namespace csgcore {
namespace {

Box bounds_of(const CanonicalPrimitives& primitives, const CsgTree& tree) {
  if (tree.empty()) return {};
  return subtree_boxes(tree.tokens(), [&](uint32_t i) { return primitives[i].bounds; }).back();
}

/// In parallel where there are many.
template <typename Work>
void for_each_part(size_t count, Work&& work) {
  constexpr size_t kAtOnce = 1024;
  if (count <= kAtOnce) {
    for (size_t i = 0; i < count; ++i) work(i);
    return;
  }
  tbb::parallel_for(tbb::blocked_range<size_t>(0, count, kAtOnce), [&](const auto& range) {
    for (size_t i = range.begin(); i < range.end(); ++i) work(i);
  });
}

}  // namespace

std::shared_ptr<const CanonicalPrimitives> canonical_primitives(const Scene& scene) {
  auto result = std::make_shared<CanonicalPrimitives>(scene.primitives.size());
  for_each_part(scene.primitives.size(),
                [&](size_t i) { (*result)[i] = canonicalize(scene.primitives[i]); });
  return result;
}

Solid::Solid(std::shared_ptr<const CanonicalPrimitives> primitives, const CsgTree& tree)
    : primitives_(std::move(primitives)),
      list_(compile(tree)),
      bounds_(bounds_of(*primitives_, tree)) {
  if (tree.empty()) {
    groups_ = std::make_shared<const OperandGroups>();
    return;
  }
  auto list = std::make_shared<CellList>();
  assign(*list, list_.literals);
  cell_list_ = std::move(list);
  Extents extents(primitives_->size());
  for_each_part(extents.size(), [&](size_t i) { extents[i] = extent_of((*primitives_)[i]); });
  groups_ = std::make_shared<const OperandGroups>(tree, std::move(extents));
}

std::span<const Extent> Solid::extents() const {
  return std::span(groups_->extents()).first(groups_->first_group());
}

bool Solid::contains(const Vec3& point) const {
  if (list_.literals.empty()) return list_.constant;
  return evaluate(std::span<const Literal>(list_.literals), [&](uint32_t primitive) {
    return csgcore::contains((*primitives_)[primitive], point);
  });
}

}  // namespace csgcore
