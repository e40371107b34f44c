#include "csgcore/solid.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "csgcore/geometry.hpp"
#include "csgcore/stop_scope.hpp"
#include "solid/operand_groups.hpp"
#include "solid/redundant_operands.hpp"
#include "tree/cell_list.hpp"
#include "tree/subtree_boxes.hpp"

namespace csgcore {
namespace {

Box bounds_of(const CanonicalPrimitives& primitives, const CsgTree& tree) {
  if (tree.empty()) return {};
  return subtree_boxes(tree.tokens(), [&](uint32_t i) { return primitives[i].bounds; }).back();
}

/// Calls work(i) for each i < count, in parallel if there are many.
template <typename Work>
void for_each_part(size_t count, Work&& work) {
  constexpr size_t kAtOnce = 1024;
  if (count <= kAtOnce) {
    for (size_t i = 0; i < count; ++i) work(i);
    return;
  }
  tbb::parallel_for(tbb::blocked_range<size_t>(0, count, kAtOnce),
                    [&, stop = stop_of_work](const auto& range) {
                      const StopScope scope(stop);
                      for (size_t i = range.begin(); i < range.end(); ++i) {
                        stop_point();
                        work(i);
                      }
                    });
}

Extents extents_of(const CanonicalPrimitives& primitives) {
  Extents extents(primitives.size());
  for_each_part(extents.size(), [&](size_t i) { extents[i] = extent_of(primitives[i]); });
  return extents;
}

}  // namespace

std::shared_ptr<const CanonicalPrimitives> canonical_primitives(const Scene& scene) {
  auto result = std::make_shared<CanonicalPrimitives>(scene.primitives.size());
  for_each_part(scene.primitives.size(),
                [&](size_t i) { (*result)[i] = canonicalize(scene.primitives[i]); });
  return result;
}

Solid::Solid(std::shared_ptr<const CanonicalPrimitives> primitives, const CsgTree& tree)
    : primitives_(std::move(primitives)), bounds_(bounds_of(*primitives_, tree)) {
  if (tree.empty()) {
    groups_ = std::make_shared<const OperandGroups>();
    return;
  }
  Extents extents = extents_of(*primitives_);
  const std::optional<CsgTree> lean =
      leave_out_redundant(tree, *primitives_, extents, thickness_tolerance(bounds_));
  const CsgTree& used = lean ? *lean : tree;
  list_ = compile(used);
  auto list = std::make_shared<CellList>();
  assign(*list, list_.tests);
  cell_list_ = std::move(list);
  groups_ = std::make_shared<const OperandGroups>(used, std::move(extents));
}

CsgTree without_redundant_operands(const CanonicalPrimitives& primitives, const CsgTree& tree) {
  if (tree.empty()) return {};
  const double tolerance = thickness_tolerance(bounds_of(primitives, tree));
  return leave_out_redundant(tree, primitives, extents_of(primitives), tolerance).value_or(tree);
}

std::span<const Extent> Solid::extents() const {
  return std::span(groups_->extents()).first(groups_->first_group());
}

bool Solid::contains(const Vec3& point) const {
  if (list_.tests.empty()) return list_.constant;
  return evaluate(std::span<const BlistTest>(list_.tests), [&](uint32_t primitive) {
    return csgcore::contains((*primitives_)[primitive], point);
  });
}

}  // namespace csgcore
