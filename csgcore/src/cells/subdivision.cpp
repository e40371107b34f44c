#include "csgcore/subdivision.hpp"

#include <algorithm>
#include <utility>

#include "cells/builder.hpp"
#include "cells/chunk.hpp"

namespace csgcore {
Subdivision::Subdivision(const Solid& solid, SubdivisionOptions options, const BatchSink& sink)
    : solid_(&solid), options_(std::move(options)) {
  const Box& bounds = solid.bounds();
  if (bounds.empty() || solid.list().tests.empty()) return;
  overlap_ = cell_overlap(bounds);
  root_box_ = {bounds.min - overlap_, bounds.max + overlap_};
  Chunk all = Builder(solid, options_, overlap_, sink).build(root_box_);
  nodes_ = std::move(all.nodes);
  leaves_ = std::move(all.leaves);
  tests_ = std::move(all.tests);
}

size_t Subdivision::bytes() const {
  return nodes_.size() * sizeof(KdNode) + leaves_.size() * sizeof(Leaf) +
         tests_.size() * sizeof(BlistTest);
}

bool Subdivision::refine(const View& view) {
  if (options_.threshold_px <= 0 || nodes_.empty()) return false;
  options_.view = view;
  const BatchSink no_sink;
  Builder builder(*solid_, options_, overlap_, no_sink);
  Chunk starts;
  std::vector<uint32_t> slots;
  struct Visit {
    uint32_t node, depth;
  };
  std::vector<Visit> stack{{0, 0}};
  while (!stack.empty()) {
    const Visit visit = stack.back();
    stack.pop_back();
    const KdNode& node = nodes_[visit.node];
    if (node.axis != KdNode::kLeafAxis) {
      stack.push_back({node.above, visit.depth + 1});
      stack.push_back({node.below, visit.depth + 1});
      continue;
    }
    Leaf& leaf = leaves_[node.below];
    if (leaf.kind != LeafKind::kDropped || projects_below(view, leaf.box, options_.threshold_px)) {
      continue;
    }
    leaf.kind = LeafKind::kReplaced;
    builder.start(leaf, visit.depth, tests_of(leaf), starts);
    slots.push_back(visit.node);
  }
  if (slots.empty()) return false;
  if (!builder.can_divide(starts, bytes())) {
    for (const uint32_t slot : slots) leaves_[nodes_[slot].below].kind = LeafKind::kGivenUp;
    return true;
  }
  builder.finish(starts, bytes());
  Chunk all;
  all.nodes = std::move(nodes_);
  all.leaves = std::move(leaves_);
  all.tests = std::move(tests_);
  place(std::move(starts), slots, all);
  nodes_ = std::move(all.nodes);
  leaves_ = std::move(all.leaves);
  tests_ = std::move(all.tests);
  return true;
}

const Leaf* Subdivision::find(const Vec3& point) const {
  if (nodes_.empty()) return nullptr;
  for (int axis = 0; axis < 3; ++axis) {
    if (!(point[axis] >= root_box_.min[axis] && point[axis] <= root_box_.max[axis])) return nullptr;
  }
  uint32_t i = 0;
  while (nodes_[i].axis != KdNode::kLeafAxis) {
    i = point[static_cast<int>(nodes_[i].axis)] < nodes_[i].split ? nodes_[i].below
                                                                  : nodes_[i].above;
  }
  return &leaves_[nodes_[i].below];
}

uint64_t LeafCensus::leaves() const {
  uint64_t sum = 0;
  for (size_t kind = 0; kind < kLeafKinds; ++kind) {
    if (kind != static_cast<size_t>(LeafKind::kReplaced)) sum += by_kind[kind];
  }
  return sum;
}

LeafCensus census(const Subdivision& subdivision) {
  LeafCensus result;
  for (const Leaf& leaf : subdivision.leaves()) {
    ++result.by_kind[static_cast<size_t>(leaf.kind)];
    if (leaf.kind != LeafKind::kReplaced && leaf.kind != LeafKind::kEmpty) {
      result.tests += leaf.test_count;
    }
  }
  return result;
}

}  // namespace csgcore
