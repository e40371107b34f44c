#include "render/scene_subdivision.hpp"

#include <algorithm>

#include "base/elapsed.hpp"

namespace frontend {
namespace {

using csgcore::LeafKind;
using csgcore::Subdivision;

/// Reports the share of the scene's volume that is subdivided.
class SubdivisionProgress {
 public:
  SubdivisionProgress(const csgcore::Solid& solid, const RenderSettings& settings)
      : settings_(settings), volume_(volume(solid.bounds())) {}

  csgcore::BatchSink sink() {
    if (!settings_.progress) return {};
    return [this](const csgcore::LeafBatch& batch) {
      for (const csgcore::Leaf& leaf : batch.leaves) {
        if (leaf.kind != LeafKind::kReplaced) done_ += volume(leaf.box);
      }
      settings_.progress("subdividing", std::min(done_ / volume_, 1.0));
    };
  }

 private:
  static double volume(const csgcore::Box& box) {
    const csgcore::Vec3 size = box.size();
    return size.x * size.y * size.z;
  }
  const RenderSettings& settings_;
  double volume_;
  double done_ = 0;
};

/// Whether the same leaves come of both, but for those that another view needs.
bool is_same_rule(const csgcore::SubdivisionOptions& a, const csgcore::SubdivisionOptions& b) {
  return a.leaf_primitives == b.leaf_primitives && a.threshold_px == b.threshold_px &&
         a.stop_at_unions == b.stop_at_unions && a.split == b.split;
}

}  // namespace

csgcore::SubdivisionOptions subdivision_options(const csgcore::View& view,
                                                const RenderSettings& settings) {
  csgcore::SubdivisionOptions options;
  if (settings.leaf_primitives == 2 && settings.threshold_px > 0) {
    // K = 2 with a threshold is the paper's rule (§2.1, §2.2).
    options = csgcore::SubdivisionOptions::paper(settings.threshold_px, view);
  } else {
    options.leaf_primitives = settings.leaf_primitives;
    options.threshold_px = settings.threshold_px;
    options.view = view;
  }
  options.threads = settings.threads;
  return options;
}

SceneSubdivisions::Found SceneSubdivisions::of(const csgcore::Solid& solid,
                                               const PictureRequest& request) {
  const Clock::time_point start = Clock::now();
  const csgcore::SubdivisionOptions options = subdivision_options(request.view, request.settings);
  const auto found = made_.find(&solid);
  if (found != made_.end() && is_same_rule(found->second.options(), options)) {
    Subdivision& made = found->second;
    const bool was_refined = made.refine(request.view);
    request.stats.subdivide_ms += ms_since(start);
    return {made, was_refined};
  }
  SubdivisionProgress progress(solid, request.settings);
  const auto [made, is_new] =
      made_.insert_or_assign(&solid, Subdivision(solid, options, progress.sink()));
  request.stats.subdivide_ms += ms_since(start);
  request.stats.edit.cells_made += made->second.leaves().size();
  if (request.settings.progress) request.settings.progress("drawing", 0.0);
  return {made->second, true};
}

void count_cells(const Subdivision& subdivision, RenderStats& stats) {
  const csgcore::LeafCensus leaves = csgcore::census(subdivision);
  const auto of = [&](LeafKind kind) { return leaves.by_kind[static_cast<size_t>(kind)]; };
  stats.cells = subdivision.nodes().size();
  stats.leaves = leaves.leaves();
  stats.leaves_empty = of(LeafKind::kEmpty);
  stats.leaves_union = of(LeafKind::kUnion);
  stats.leaves_pair = of(LeafKind::kPair);
  stats.leaves_general = of(LeafKind::kGeneral);
  stats.leaves_full = of(LeafKind::kFull);
  stats.leaves_dropped = of(LeafKind::kDropped);
  stats.leaves_given_up = of(LeafKind::kGivenUp);
  stats.leaf_primitives = leaves.tests;
  stats.bytes = subdivision.bytes();
}

}  // namespace frontend
