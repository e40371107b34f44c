#include "frame/cell_tracer.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

#include "packets/packet.hpp"
#include "rays/packet_blocks.hpp"

namespace csgcore {
namespace {

/// The side of the squares of pixels that tasks trace.
constexpr uint32_t kTaskSide_px = 32;
static_assert(kTileSide_px == kPacketWidth_px);

/// Traces the wanted lanes of each block of a tile.
class LaneVisitor final : public TileVisitor {
 public:
  LaneVisitor(const FrameRays& frame, const Tile& whole, std::span<const LaneMask> lanes,
              HitSink& sink)
      : frame_(frame), whole_(whole), lanes_(lanes), sink_(sink) {}

  void visit_empty(const Tile& tile) override {
    for_each_wanted(tile, [&](const PacketBlock& block) {
      sink_.store(block, RayPacket{}, TraceList{}, PacketHits{});
    });
  }

  void visit(const Tile& tile, TileRays& rays) override {
    for_each_wanted(tile,
                    [&](const PacketBlock& block) { trace_block(frame_, block, rays, sink_); });
  }

 private:
  template <typename Visit>
  void for_each_wanted(const Tile& tile, Visit&& visit) {
    for_each_block(tile, [&](PacketBlock block) {
      block.lanes &= lanes_[(block.y - whole_.y) / kPacketHeight_px];
      if (block.lanes != 0) visit(block);
    });
  }

  const FrameRays& frame_;
  const Tile whole_;
  std::span<const LaneMask> lanes_;
  HitSink& sink_;
};

}  // namespace

/// The traversal of the tree by one packet.
class CellTracer::Traversal {
 public:
  Traversal(CellTracer& owner, const PacketBlock& block, HitSink& sink, Workspace& workspace)
      : owner_(owner),
        tree_(owner.subdivision_),
        block_(block),
        sink_(sink),
        workspace_(workspace) {
    workspace.packets_.segment_store.clear();
    make_block_rays(owner.frame_, block, rays_);
    invert_directions(rays_, inverses_);
  }

  /// Stores the pixels that cells can decide. Returns the other lanes.
  LaneMask trace() {
    // Lanes whose directions differ in sign along an axis meet the cells in different orders.
    for (LaneMask left = block_.lanes; left != 0;) {
      const uint32_t first = static_cast<uint32_t>(std::countr_zero(left));
      LaneMask group = 0;
      for_each_lane(left, [&](uint32_t lane) {
        if (octant(lane) == octant(first)) group |= LaneMask{1} << lane;
      });
      left &= ~group;
      trace_group(group, octant(first));
    }
    PacketBlock misses = block_;
    misses.lanes = block_.lanes & ~done_;
    if (misses.lanes != 0) sink_.store(misses, rays_, TraceList{}, PacketHits{});
    return undecided_;
  }

 private:
  uint32_t octant(uint32_t lane) const {
    uint32_t result = 0;
    for (uint32_t axis = 0; axis < 3; ++axis) {
      if (rays_.direction[axis][lane] < 0) result |= uint32_t{1} << axis;
    }
    return result;
  }

  /// Finds the range of each ray in the root cell. Returns the lanes that have one.
  LaneMask clip_to_root(LaneMask lanes, PacketRange& range) {
    const Box& box = tree_.root_box();
    LaneMask result = 0;
    for_each_lane(lanes, [&](uint32_t lane) {
      double enter = owner_.frame_.first_t;
      double leave = std::numeric_limits<double>::max();
      for (int axis = 0; axis < 3; ++axis) {
        const double origin = rays_.origin[axis][lane];
        const double direction = rays_.direction[axis][lane];
        const double low = box.min[axis] - owner_.frame_.pivot[axis] - origin;
        const double high = box.max[axis] - owner_.frame_.pivot[axis] - origin;
        if (direction == 0) {
          if (low > 0 || high < 0) leave = -std::numeric_limits<double>::infinity();
          continue;
        }
        const double inverse = inverses_.inverse[axis][lane];
        enter = std::max(enter, std::min(low * inverse, high * inverse));
        leave = std::min(leave, std::max(low * inverse, high * inverse));
      }
      range.enter[lane] = enter;
      range.leave[lane] = leave;
      const LaneMask bit = LaneMask{1} << lane;
      if (enter <= leave) result |= bit;
      // A ray that starts outside of the tree's cells starts outside of the solid.
      if (enter > owner_.frame_.first_t) known_ |= bit;
    });
    return result;
  }

  void trace_group(LaneMask group, uint32_t signs) {
    std::vector<Workspace::Visit>& stack = workspace_.stack_;
    stack.clear();
    if (tree_.nodes().empty()) return;
    stack.emplace_back();
    stack.back().node = 0;
    stack.back().range.margin = tree_.overlap();
    stack.back().lanes = clip_to_root(group, stack.back().range);
    workspace_.rays_ += static_cast<uint64_t>(std::popcount(stack.back().lanes));
    while (!stack.empty()) {
      Workspace::Visit visit = stack.back();
      stack.pop_back();
      visit.lanes &= ~done_;
      while (visit.lanes != 0 && tree_.nodes()[visit.node].axis != KdNode::kLeafAxis) {
        divide(visit, signs);
      }
      if (visit.lanes != 0) trace_leaf(tree_.leaves()[tree_.nodes()[visit.node].below], visit);
    }
  }

  /// Goes on to the half that the lanes reach first, and pushes the other one onto the stack.
  void divide(Workspace::Visit& visit, uint32_t signs) {
    const KdNode& node = tree_.nodes()[visit.node];
    const int axis = static_cast<int>(node.axis);
    const bool downwards = (signs >> node.axis & 1) != 0;
    const uint32_t first = downwards ? node.above : node.below;
    const uint32_t second = downwards ? node.below : node.above;
    std::vector<Workspace::Visit>& stack = workspace_.stack_;
    stack.emplace_back();
    Workspace::Visit& far = stack.back();
    const RangeSplit split = split_range(
        rays_, inverses_, axis, node.split - owner_.frame_.pivot[axis], visit.range, far.range);
    far.lanes = visit.lanes & split.beyond;
    far.node = second;
    visit.lanes &= split.before;
    visit.node = first;
    if (visit.lanes == 0) visit = far;
    if (far.lanes == 0 || visit.node == second) stack.pop_back();
  }

  void trace_leaf(const Leaf& leaf, const Workspace::Visit& visit) {
    if (leaf.test_count == 0 || leaf.kind == LeafKind::kDropped) {
      if (leaf.solid) eye_inside_ |= visit.lanes & ~known_;
      known_ |= visit.lanes;
      return;
    }
    assign(workspace_.list_, tree_.tests_of(leaf));
    // A leaf has few primitives, all of which are intersected.
    workspace_.nearest_.assign(leaf.test_count, -std::numeric_limits<double>::max());
    const TraceList list{tree_.solid().primitives().data(), &workspace_.list_,
                         workspace_.nearest_.data(), -std::numeric_limits<double>::max()};
    PacketHits hits;
    trace_packet_in_range(owner_.frame_, rays_, visit.lanes, visit.range, list, owner_.parameters_,
                          known_, eye_inside_, workspace_.packets_, hits);
    eye_inside_ |= hits.eye_inside & visit.lanes & ~known_;
    known_ |= visit.lanes;
    done_ |= hits.hits;
    undecided_ |= hits.undecided;
    PacketBlock decided = block_;
    decided.lanes = hits.hits & ~hits.undecided;
    hits.hits = decided.lanes;
    if (decided.lanes != 0) sink_.store(decided, rays_, list, hits);
  }

  CellTracer& owner_;
  const Subdivision& tree_;
  const PacketBlock block_;
  HitSink& sink_;
  Workspace& workspace_;
  RayPacket rays_;
  PacketInverses inverses_;
  LaneMask done_ = 0;
  LaneMask undecided_ = 0;
  LaneMask known_ = 0;  // lanes whose value at the eye is known and in eye_inside_
  LaneMask eye_inside_ = 0;
};

CellTracer::CellTracer(const Subdivision& subdivision, const FrameRays& frame,
                       const TraceParameters& parameters,
                       std::shared_ptr<TileTracer::Workspaces> workspaces)
    : subdivision_(subdivision),
      frame_(frame),
      parameters_(parameters),
      workspaces_(std::move(workspaces)) {}

CellTracer::~CellTracer() = default;

void CellTracer::trace(const PixelArea& area, HitSink& sink) {
  const uint32_t columns = (area.width + kTaskSide_px - 1) / kTaskSide_px;
  const uint32_t rows = (area.height + kTaskSide_px - 1) / kTaskSide_px;
  tbb::parallel_for(uint32_t{0}, columns * rows, [&](uint32_t task) {
    const uint32_t left = area.x + task % columns * kTaskSide_px;
    const uint32_t top = area.y + task / columns * kTaskSide_px;
    const uint32_t right = std::min(area.x + area.width, left + kTaskSide_px);
    const uint32_t bottom = std::min(area.y + area.height, top + kTaskSide_px);
    constexpr LaneMask kAll[] = {kAllLanes, kAllLanes};
    Workspace workspace;
    for (uint32_t y = top; y < bottom; y += kTileSide_px) {
      for (uint32_t x = left; x < right; x += kTileSide_px) {
        trace_tile({x, y, std::min(kTileSide_px, right - x), std::min(kTileSide_px, bottom - y)},
                   kAll, sink, workspace);
      }
    }
    const std::lock_guard lock(mutex_);
    counts_ += workspace.counts();
  });
}

void CellTracer::trace_tile(const Tile& tile, std::span<const LaneMask, kTileBlocks> lanes,
                            HitSink& sink, Workspace& workspace) {
  if (parameters_.stop.stop_requested()) return;
  LaneMask undecided[kTileBlocks] = {};
  for_each_block(tile, [&](PacketBlock block) {
    const uint32_t index = (block.y - tile.y) / kPacketHeight_px;
    block.lanes &= lanes[index];
    if (block.lanes != 0) undecided[index] = Traversal(*this, block, sink, workspace).trace();
  });
  const bool all_decided =
      std::all_of(std::begin(undecided), std::end(undecided), [](LaneMask m) { return m == 0; });
  if (!all_decided) trace_by_tile(tile, undecided, sink);
}

/// Coincidence resolution needs the whole ray, and so the list of the rays' tile.
void CellTracer::trace_by_tile(const Tile& tile, std::span<const LaneMask> undecided,
                               HitSink& sink) {
  LaneVisitor visitor(frame_, tile, undecided, sink);
  tile_tracer().visit(tile, visitor);
}

TileTracer& CellTracer::tile_tracer() {
  std::call_once(tile_tracer_made_, [&] {
    tile_tracer_ = std::make_unique<TileTracer>(subdivision_.solid(), frame_, parameters_,
                                                TileRules{}, workspaces_);
  });
  return *tile_tracer_;
}

TileTracer::Counts CellTracer::Workspace::counts() const {
  return {0, rays_, packets_.intersections, packets_.resolved_rays};
}

TileTracer::Counts CellTracer::counts() const {
  TileTracer::Counts sum = counts_;
  if (tile_tracer_) sum += tile_tracer_->counts();
  return sum;
}

}  // namespace csgcore
