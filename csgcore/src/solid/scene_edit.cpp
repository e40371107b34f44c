#include "csgcore/scene_edit.hpp"

#include <algorithm>

#include "primitives/primitive_kind.hpp"
#include "solid/restriction.hpp"
#include "tree/cell_list.hpp"

namespace csgcore {
namespace {

bool same_tokens(const CsgTree& a, const CsgTree& b) {
  return std::equal(a.tokens().begin(), a.tokens().end(), b.tokens().begin(), b.tokens().end(),
                    [](const CsgToken& x, const CsgToken& y) {
                      return x.is_primitive == y.is_primitive && x.value == y.value &&
                             (x.is_primitive || x.op == y.op);
                    });
}

bool same_parts(const Layer& a, const Layer& b) {
  return std::equal(a.parts.begin(), a.parts.end(), b.parts.begin(), b.parts.end(),
                    [](const Layer::Part& x, const Layer::Part& y) {
                      return x.is_subtracted == y.is_subtracted && same_tokens(x.solid, y.solid);
                    });
}

bool same_layers(const Scene& a, const Scene& b) {
  return std::equal(a.layers.begin(), a.layers.end(), b.layers.begin(), b.layers.end(),
                    [](const Layer& x, const Layer& y) {
                      return x.kind == y.kind && x.shows_behind == y.shows_behind &&
                             same_tokens(x.solid, y.solid) && same_parts(x, y);
                    });
}

bool all_same_tokens(const Scene& a, const Scene& b) {
  return same_tokens(a.model, b.model) && same_layers(a, b);
}

/// Returns the list of a tree outside of all the primitives in `gone`.
CellList list_without(const CsgTree& tree, const std::vector<uint32_t>& gone, size_t primitives) {
  CellList result;
  if (tree.empty()) return result;
  CellList whole;
  assign(whole, compile(tree).tests);
  std::vector<uint8_t> is_gone(primitives);
  for (const uint32_t primitive : gone) is_gone[primitive] = 1;
  using Decision = Restrictor::Decision;
  std::vector<Decision> decisions;
  decisions.reserve(whole.count());
  for (const uint32_t entry : whole.primitives()) {
    decisions.push_back(is_gone[entry & kPrimitiveBits] ? Decision::kOutside : Decision::kOpen);
  }
  const WorldClassifier nobody_asks({});
  Restrictor({}, nobody_asks).restrict(whole, decisions, result);
  return result;
}

bool same_but_for_indices(const CellList& before, const CellList& after,
                          const std::vector<uint32_t>& later_indices) {
  if (before.root != after.root) return false;
  for (uint32_t i = 0; i < before.count(); ++i) {
    const uint32_t complement = before.primitive[i] & CellList::kComplementBit;
    const uint32_t later = later_indices[before.primitive[i] & kPrimitiveBits];
    if ((later | complement) != after.primitive[i] || before.if_inside[i] != after.if_inside[i] ||
        before.if_outside[i] != after.if_outside[i]) {
      return false;
    }
  }
  return true;
}

TreeEdit compare_trees(const CsgTree& before, const CsgTree& after, const SceneEdit& edit,
                       const std::vector<uint32_t>& later_indices) {
  const bool both_empty = before.empty() && after.empty();
  if (both_empty || (edit.keeps_indices() && same_tokens(before, after))) return TreeEdit::kSame;
  const CellList left = list_without(before, edit.removed, edit.primitives_before);
  const CellList now = list_without(after, edit.added, edit.primitives_after);
  return same_but_for_indices(left, now, later_indices) ? TreeEdit::kWithin : TreeEdit::kAnywhere;
}

void match_primitives(const Scene& before, const Scene& after, SceneEdit& edit) {
  const uint32_t count_before = edit.primitives_before;
  const uint32_t count_after = edit.primitives_after;
  const auto same = [&](uint32_t i, uint32_t j) {
    return same_shape(before.primitives[i], after.primitives[j]);
  };
  if (count_before == count_after && all_same_tokens(before, after)) {
    for (uint32_t i = 0; i < count_before; ++i) {
      if (!same(i, i)) edit.removed.push_back(i);
    }
    edit.added = edit.removed;
    return;
  }
  const uint32_t fewer = std::min(count_before, count_after);
  uint32_t first = 0, last = 0;
  while (first < fewer && same(first, first)) ++first;
  while (last < fewer - first && same(count_before - 1 - last, count_after - 1 - last)) ++last;
  for (uint32_t i = first; i < count_before - last; ++i) edit.removed.push_back(i);
  for (uint32_t i = first; i < count_after - last; ++i) edit.added.push_back(i);
}

}  // namespace

bool same_shape(const Primitive& a, const Primitive& b) {
  return a.local_to_world.linear == b.local_to_world.linear &&
         a.local_to_world.translation == b.local_to_world.translation && a.shape() == b.shape() &&
         kind_of(a.shape()).has_same_solid(a, b);
}

bool SceneEdit::surfaces_only() const {
  return removed.empty() && added.empty() && model == TreeEdit::kSame && !has_other_layers;
}

bool SceneEdit::nothing() const { return surfaces_only() && recolored.empty() && !has_other_ids; }

std::vector<uint32_t> SceneEdit::later_indices() const {
  std::vector<uint32_t> result(primitives_before);
  size_t gone = 0, new_ones = 0;
  uint32_t later = 0;
  for (uint32_t i = 0; i < primitives_before; ++i) {
    if (gone < removed.size() && removed[gone] == i) {
      ++gone;
      result[i] = kGone;
      continue;
    }
    for (; new_ones < added.size() && added[new_ones] == later; ++new_ones) ++later;
    result[i] = later++;
  }
  return result;
}

SceneEdit compare(const Scene& before, const Scene& after) {
  SceneEdit edit;
  edit.primitives_before = static_cast<uint32_t>(before.primitives.size());
  edit.primitives_after = static_cast<uint32_t>(after.primitives.size());
  match_primitives(before, after, edit);
  const std::vector<uint32_t> later_indices = edit.later_indices();
  for (uint32_t i = 0; i < edit.primitives_before; ++i) {
    if (later_indices[i] == SceneEdit::kGone) continue;
    const Primitive& was = before.primitives[i];
    const Primitive& is = after.primitives[later_indices[i]];
    if (was.color != is.color || was.cut_faces != is.cut_faces)
      edit.recolored.push_back(later_indices[i]);
    edit.has_other_ids |= was.id != is.id;
  }
  edit.model = compare_trees(before.model, after.model, edit, later_indices);
  const bool has_layers = !before.layers.empty() || !after.layers.empty();
  edit.has_other_layers = has_layers && !(edit.keeps_indices() && same_layers(before, after));
  return edit;
}

}  // namespace csgcore
