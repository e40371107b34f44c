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

/// If a larger share of the primitives has changed, the solid is made anew.
constexpr double kMostChanged = 0.1;

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

bool have_common(std::span<const uint32_t> a, std::span<const uint32_t> b) {
  return std::ranges::any_of(a, [b](uint32_t i) { return std::ranges::binary_search(b, i); });
}

}  // namespace

std::shared_ptr<const CanonicalPrimitives> canonical_primitives(const Scene& scene) {
  auto result = std::make_shared<CanonicalPrimitives>(scene.primitives.size());
  for_each_part(scene.primitives.size(),
                [&](size_t i) { (*result)[i] = canonicalize(scene.primitives[i]); });
  return result;
}

std::shared_ptr<const CanonicalPrimitives> canonical_primitives(const Scene& scene,
                                                                const CanonicalPrimitives& earlier,
                                                                const SceneEdit& edit) {
  auto result = std::make_shared<CanonicalPrimitives>();
  if (edit.keeps_indices()) {
    *result = earlier;
  } else {
    const std::vector<uint32_t> later_indices = edit.later_indices();
    result->resize(scene.primitives.size());
    for (size_t i = 0; i < earlier.size(); ++i) {
      if (later_indices[i] != SceneEdit::kGone) (*result)[later_indices[i]] = earlier[i];
    }
  }
  for_each_part(edit.added.size(), [&](size_t i) {
    (*result)[edit.added[i]] = canonicalize(scene.primitives[edit.added[i]]);
  });
  for (const uint32_t i : edit.recolored) {
    (*result)[i].color = scene.primitives[i].color;
    (*result)[i].cut_faces = scene.primitives[i].cut_faces;
  }
  for (size_t i = 0; edit.has_other_ids && i < result->size(); ++i) {
    (*result)[i].id = scene.primitives[i].id;
  }
  return result;
}

Solid::Solid(std::shared_ptr<const CanonicalPrimitives> primitives, const CsgTree& tree)
    : primitives_(std::move(primitives)), bounds_(bounds_of(*primitives_, tree)) {
  if (tree.empty()) {
    groups_ = std::make_shared<const OperandGroups>();
    return;
  }
  Extents extents = extents_of(*primitives_);
  if (auto lean = leave_out_redundant(tree, *primitives_, extents, thickness_tolerance(bounds_))) {
    lean_ = std::make_shared<const LeanTree>(*std::move(lean));
  }
  list_ = compile(used_of(tree));
  auto list = std::make_shared<CellList>();
  assign(*list, list_.tests);
  cell_list_ = std::move(list);
  groups_ = std::make_shared<const OperandGroups>(used_of(tree), std::move(extents));
}

Solid::Solid(std::shared_ptr<const CanonicalPrimitives> primitives, const CsgTree& tree,
             const Solid& earlier, const SceneEdit& edit, TreeEdit tree_edit) {
  const bool has_same_list = tree_edit == TreeEdit::kSame && !tree.empty();
  const bool may_be_wrong = earlier.lean_ && have_common(edit.added, earlier.lean_->grounds);
  if (!has_same_list || may_be_wrong || edit.added.size() > kMostChanged * edit.primitives_after) {
    *this = Solid(std::move(primitives), tree);
    return;
  }
  primitives_ = std::move(primitives);
  lean_ = earlier.lean_;
  list_ = earlier.list_;
  cell_list_ = earlier.cell_list_;
  if (edit.added.empty()) {
    groups_ = earlier.groups_;
    bounds_ = earlier.bounds_;
    return;
  }
  bounds_ = bounds_of(*primitives_, tree);
  const std::span<const Extent> extents_before = earlier.extents();
  Extents extents(extents_before.begin(), extents_before.end());
  for (const uint32_t i : edit.added) extents[i] = extent_of((*primitives_)[i]);
  const CsgTree& used = used_of(tree);
  groups_ = OperandGroups::with_moved(earlier.groups_, used, extents, edit.added);
  if (!groups_) groups_ = std::make_shared<const OperandGroups>(used, std::move(extents));
}

const CsgTree& Solid::used_of(const CsgTree& tree) const { return lean_ ? lean_->tree : tree; }

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
