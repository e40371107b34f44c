#include "tiles/tile_tracer.hpp"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <limits>
#include <utility>

#include "rays/packet_blocks.hpp"
#include "screen/screen_slab.hpp"
#include "solid/restriction.hpp"

namespace csgcore {
namespace {

/// Tiles of this side are never divided.
constexpr uint32_t kLeastSide_px = 2;

/// The halves of tiles with more pixels become two tasks.
constexpr uint32_t kTaskPixels = 64 * 64;

/// Longer lists are culled (TileCuller) at some sizes of tile, since it takes several passes over
/// the list.
constexpr uint32_t kLongList = 24;
constexpr uint32_t kSimplifiedPixels[] = {128 * 128, 64 * 64, 16 * 32};

/// A group is expanded if it is at least this share of the tile: smaller ones are mostly separated
/// from tiles as a whole. The share is larger if smaller tiles may find the group hidden.
constexpr double kOpenShare = 1.0;
constexpr double kOpenShareBehind = 4.0;

/// Tiles of at most this side with lists of at least so many tests are cut by faces.
constexpr uint32_t kFaceCutSide_px = 128;
constexpr uint32_t kLeastFaceCut = 4;

/// A list that was cut has mostly visible primitives left, and is culled again only if it is longer
/// than this.
constexpr uint32_t kLongCutList = 256;

/// Returns whether the list should be culled now. `is_new`: the list has groups, or some were just
/// expanded.
bool is_culled(const Tile& tile, const CellList& list, bool is_new, bool is_cut) {
  if (list.count() <= (is_cut ? kLongCutList : kLongList) && !is_new) return false;
  const uint32_t pixels = tile.width * tile.height;
  // A division halves a tile, so that each of the sizes matches one tile on the way down.
  const bool is_time =
      std::any_of(std::begin(kSimplifiedPixels), std::end(kSimplifiedPixels),
                  [&](uint32_t size) { return pixels <= size && 2 * pixels > size; });
  return is_time || is_new;
}

}  // namespace

void trace_block(const FrameRays& frame, const PacketBlock& block, const PacketLimits* limits,
                 TileRays& rays, HitSink& sink) {
  RayPacket packet;
  make_block_rays(frame, block, packet);
  PacketHits hits;
  const TraceList& list = rays.trace(packet, block, limits, hits);
  sink.store(block, packet, list, hits);
}

void TileList::assign(std::span<const CanonicalPrimitive> primitives, const ScreenBounds& bounds,
                      const Tile& tile, const CellList& list) {
  const std::span<const Extent> screen = bounds.extents();
  const uint32_t count = list.count();
  tile_ = tile;
  nearest_.resize(count);
  for (auto& reached : reached_) reached.resize(count);
  double earliest = std::numeric_limits<double>::infinity();
  for (uint32_t i = 0; i < count; ++i) {
    const Extent& extent = screen[list.primitive[i] & kPrimitiveBits];
    nearest_[i] = nearest_t(extent);
    earliest = std::min(earliest, nearest_[i]);
  }
  find_reached(screen.data(), bounds.slabs(), list.primitives(), tile.x, tile.y, reached_[0].data(),
               reached_[1].data());
  trace_ = {primitives.data(), &list, nearest_.data(), earliest, nullptr};
}

TraceList TileList::trace_list(const PacketBlock& block) const {
  TraceList trace = trace_;
  if (std::max(tile_.width, tile_.height) <= kTileSide_px) {
    trace.reached = reached_[block.y > tile_.y ? 1 : 0].data();
  }
  return trace;
}

/// The lists of one level of the recursion, reused by all tiles of that level.
struct TileTracer::Level {
  CellList halves[2];
  CellList in_front;
  CellList culled;
  CellList opened[2];
};

/// The working memory of a task.
struct TileTracer::Workspace {
  explicit Workspace(const TileTracer& owner)
      : restrictor(owner.bounds_.extents(), owner.bounds_), culler(owner.cull_parameters()) {}
  /// Goes on with the tiles of another tracer.
  void aim_at(const TileTracer& owner) {
    restrictor.aim_at(owner.bounds_.extents(), owner.bounds_);
    culler.aim_at(owner.cull_parameters());
  }
  Level& level(size_t index) {
    while (levels.size() <= index) levels.push_back(std::make_unique<Level>());
    return *levels[index];
  }

  Restrictor restrictor;
  TileCuller culler;
  PacketWorkspace packets;
  std::vector<std::unique_ptr<Level>> levels;
  TileList list, fallback_list;
  CellList fallback, fallback_expanded[2];
  std::vector<uint8_t> marked;  // the groups to be expanded, by index in a list
  uint64_t tiles = 0;
};

TileTracer::Workspaces::Workspaces() = default;
TileTracer::Workspaces::~Workspaces() = default;

/// Holds a workspace for as long as it lives.
class TileTracer::Lease {
 public:
  explicit Lease(TileTracer& owner) : pool_(owner.workspaces_->pool_), workspace_(pool_.take()) {
    if (workspace_) {
      workspace_->aim_at(owner);
    } else {
      workspace_ = std::make_unique<Workspace>(owner);
    }
  }
  ~Lease() { pool_.give_back(std::move(workspace_)); }
  Lease(const Lease&) = delete;
  Lease& operator=(const Lease&) = delete;
  Workspace& operator*() const { return *workspace_; }

 private:
  Pool<Workspace>& pool_;
  std::unique_ptr<Workspace> workspace_;
};

namespace {

/// Returns whether the list names any group.
bool has_groups(const OperandGroups& groups, const CellList& list) {
  return std::ranges::any_of(list.primitives(), [&groups](uint32_t entry) {
    return groups.is_group(entry & kPrimitiveBits);
  });
}

/// A ray ends where the value is no longer that at the eye, if that is the same for all rays.
std::optional<bool> find_last_value(const Solid& solid, const FrameRays& frame,
                                    const TraceParameters& parameters) {
  if (parameters.boundary == Boundary::kBehind) return std::nullopt;
  const OperandGroups& groups = solid.groups();
  if (groups.list().is_constant()) return std::nullopt;
  if (frame.view.projection == Projection::kOrthographic) return true;
  // Rays start within a few tolerances of the eye; the distance is largest in the picture's
  // corners.
  constexpr double kEyeTolerances = 64;
  const Vec3 reach{kEyeTolerances * parameters.thickness_tolerance};
  const Box& bounds = solid.bounds();
  for (int axis = 0; axis < 3; ++axis) {
    const double eye = frame.view.eye[axis];
    if (eye + reach[axis] < bounds.min[axis] || eye - reach[axis] > bounds.max[axis]) return true;
  }
  const WorldClassifier classifier(solid.primitives());
  Restrictor restrictor(groups.extents(), classifier);
  const Box cell{frame.view.eye - reach, frame.view.eye + reach};
  CellList at_eye, closed;
  std::vector<uint8_t> marked;
  restrictor.restrict(groups.list(), cell, at_eye);
  while (has_groups(groups, at_eye)) {
    marked.clear();
    for (const uint32_t entry : at_eye.primitives()) {
      marked.push_back(groups.is_group(entry & kPrimitiveBits));
    }
    std::swap(at_eye, closed);
    restrictor.open(closed, groups, marked, cell, at_eye);
  }
  if (!at_eye.is_constant()) return std::nullopt;
  return at_eye.root == CellList::kFalse;
}

}  // namespace

TileTracer::TileTracer(const Solid& solid, const FrameRays& frame,
                       const TraceParameters& parameters, const TileRules& rules,
                       std::shared_ptr<Workspaces> workspaces)
    : solid_(solid),
      groups_(solid.groups()),
      frame_(frame),
      parameters_(parameters),
      rules_(rules),
      last_value_(find_last_value(solid, frame, parameters)),
      bounds_(solid.primitives(), groups_, frame, rules.centers_only),
      workspaces_(workspaces ? std::move(workspaces) : std::make_shared<Workspaces>()) {}

TileTracer::~TileTracer() = default;

TileCuller::Parameters TileTracer::cull_parameters() const {
  return {solid_.primitives(), &groups_,    bounds_.extents(),  &frame_,
          rules_.centers_only, last_value_, rules_.cover_share, parameters_.thickness_tolerance};
}

Box TileTracer::box_of(const Tile& tile) const {
  return csgcore::box_of(tile, rules_.centers_only);
}

void TileTracer::visit(const Tile& area, TileVisitor& visitor) {
  if (groups_.list().is_constant()) {
    visitor.visit_empty(area);
    return;
  }
  const Lease workspace(*this);
  CellList& list = (*workspace).level(0).halves[0];
  (*workspace).restrictor.restrict(groups_.list(), box_of(area), list);
  divide(area, list, {}, 1, *workspace, visitor);
}

/// Divides the tile recursively; each step halves it.
void TileTracer::divide(const Tile& tile, const CellList& given, Cut cut, size_t level,
                        Workspace& workspace, TileVisitor& visitor) {
  if (parameters_.stop.stop_requested() || !visitor.wants(tile)) return;
  const CellList* list = &given;
  Level& own = workspace.level(level);
  const uint32_t side = std::max(tile.width, tile.height);
  const bool is_packet = tile.width <= kPacketWidth_px && tile.height <= kPacketHeight_px;
  const auto is_short = [&] {
    return side <= kLeastSide_px || (is_packet && list->count() <= rules_.packet_list) ||
           (side <= kTileSide_px && list->count() <= rules_.tile_list);
  };
  const auto cull_list = [&](bool is_new) {
    bool cuts = false;
    list = cull(tile, list, is_new, cut.fallback != nullptr, own, workspace, cuts);
    if (!cuts) return;
    if (!cut.fallback) cut.fallback = &given;
    cut.t = std::min(cut.t, workspace.culler.cut_t());
  };
  if (rules_.cuts_by_faces && side <= kFaceCutSide_px && list->count() >= kLeastFaceCut &&
      workspace.culler.cut_by_face(tile, *list, workspace.restrictor, own.in_front)) {
    if (!cut.fallback) cut.fallback = &given;
    cut.t = std::min(cut.t, workspace.culler.cut_t());
    list = &own.in_front;
  }
  // Groups that are left in a list that was cut are mostly visible.
  cull_list(!cut.fallback && has_groups(groups_, *list));
  const CellList* const closed = list;
  const bool is_behind = !cut.fallback && workspace.culler.is_partly_covered();
  const double share = is_short() ? 0.0 : is_behind ? kOpenShareBehind : kOpenShare;
  list = open_large_groups(tile, list, share, own.opened, workspace);
  if (list != closed) cull_list(!cut.fallback);
  if (list->is_constant() && !cut.fallback) {
    visitor.visit_empty(tile);
    return;
  }
  if (is_short()) list = open_large_groups(tile, list, 0.0, own.opened, workspace);
  if (is_short()) {
    visit_leaf(tile, *list, cut, workspace, visitor);
    return;
  }
  Tile below = tile, above = tile;
  const bool across = tile.width > std::max(tile.height, is_packet ? 0 : kPacketWidth_px);
  const uint32_t unit = side > kTileSide_px ? kTileSide_px
                        : is_packet         ? kLeastSide_px
                                            : kPacketHeight_px;
  const auto half = [unit](uint32_t size) { return (size / 2 + unit - 1) / unit * unit; };
  if (across) {
    below.width = half(tile.width);
    above.x += below.width;
    above.width -= below.width;
  } else {
    below.height = half(tile.height);
    above.y += below.height;
    above.height -= below.height;
  }
  const Halves halves{box_of(below), box_of(above), across ? 0u : 1u};
  if (list->is_constant()) {
    own.halves[0].finish(list->root);
    own.halves[1].finish(list->root);
  } else {
    workspace.restrictor.restrict(*list, halves, own.halves[0], own.halves[1]);
  }
  if (tile.width * tile.height > kTaskPixels) {
    const auto task = [&](const Tile& part, const CellList& part_list) {
      const Lease lease(*this);
      divide(part, part_list, cut, 0, *lease, visitor);
    };
    tbb::parallel_invoke([&] { task(below, own.halves[0]); }, [&] { task(above, own.halves[1]); });
    return;
  }
  divide(below, own.halves[0], cut, level + 1, workspace, visitor);
  divide(above, own.halves[1], cut, level + 1, workspace, visitor);
}

/// Returns the list without primitives that decide nothing in the tile, if is_culled() says that it
/// is time to look for them. Sets `cuts` if hidden primitives were dropped.
const CellList* TileTracer::cull(const Tile& tile, const CellList* list, bool is_new, bool is_cut,
                                 Level& level, Workspace& workspace, bool& cuts) {
  while (is_culled(tile, *list, is_new, is_cut)) {
    switch (workspace.culler.cull(tile, *list, workspace.restrictor, level.culled)) {
      case TileCuller::Outcome::kNothing:
        return list;
      case TileCuller::Outcome::kCut:
        cuts = true;
        return &level.culled;
      case TileCuller::Outcome::kSimplified:
        return &level.culled;
      case TileCuller::Outcome::kOpenGroups:
        list = &open_groups(tile, *list, workspace.culler.marked(), level.opened, workspace);
    }
  }
  return list;
}

/// Returns the list with the marked groups expanded.
const CellList& TileTracer::open_groups(const Tile& tile, const CellList& list,
                                        std::span<const uint8_t> marked, CellList (&buffers)[2],
                                        Workspace& workspace) {
  CellList& result = buffers[&list == &buffers[0] ? 1 : 0];
  workspace.restrictor.open(list, groups_, marked, box_of(tile), result);
  return result;
}

/// Returns the list with all groups expanded that are as wide or as high as `share` of the tile,
/// without members that miss the tile. The result is in one of the buffers, or the list itself if
/// there are no such groups.
const CellList* TileTracer::open_large_groups(const Tile& tile, const CellList* list, double share,
                                              CellList (&buffers)[2], Workspace& workspace) {
  const double least[] = {0.5 * share * tile.width, 0.5 * share * tile.height};
  const std::span<const Extent> screen = bounds_.extents();
  std::vector<uint8_t>& marked = workspace.marked;
  const auto is_opened = [&](uint32_t entry) {
    const uint32_t index = entry & kPrimitiveBits;
    const Extent& e = screen[index];
    return groups_.is_group(index) && (e.half[0] >= least[0] || e.half[1] >= least[1]);
  };
  for (;;) {
    const std::span<const uint32_t> entries = list->primitives();
    const auto first = std::find_if(entries.begin(), entries.end(), is_opened);
    if (first == entries.end()) return list;
    marked.assign(entries.size(), 0);
    std::transform(first, entries.end(), marked.begin() + (first - entries.begin()), is_opened);
    list = &open_groups(tile, *list, marked, buffers, workspace);
  }
}

class TileTracer::LeafRays final : public TileRays {
 public:
  LeafRays(TileTracer& owner, const Tile& tile, const CellList& list, const Cut& cut,
           Workspace& workspace)
      : owner_(owner), tile_(tile), cut_(cut), workspace_(workspace) {
    workspace.list.assign(owner.solid_.primitives(), owner.bounds_, tile, list);
  }

  Met met() override {
    const CellList& list = *workspace_.list.trace_list().list;
    if (!cut_.fallback || !list.is_constant()) return {list, cut_.t};
    assign_fallback();
    return {*workspace_.fallback_list.trace_list().list, Cut{}.t};
  }

  const TraceList& trace(const RayPacket& rays, LaneMask lanes, const PacketLimits* limits,
                         PacketHits& hits) override {
    return trace(rays, lanes, workspace_.list.trace_list(), limits, hits);
  }

  const TraceList& trace(const RayPacket& rays, const PacketBlock& block,
                         const PacketLimits* limits, PacketHits& hits) override {
    return trace(rays, block.lanes, workspace_.list.trace_list(block), limits, hits);
  }

  double nearest_t() const override { return workspace_.list.trace_list().earliest_t; }

  const TraceList& trace_sides(const RayPacket& rays, const PacketBlock& block,
                               const PacketLimits* limits, const GoesOn& goes_on, PacketHits& front,
                               PacketHits& behind) override {
    assert(!cut_.fallback);
    trace_packet_sides(owner_.frame_, rays, block.lanes, workspace_.list.trace_list(block),
                       owner_.parameters_, limits, goes_on, workspace_.packets, front, behind);
    return workspace_.list.trace_list();
  }

 private:
  /// Returns the lanes that are limited to before the cut.
  LaneMask lanes_that_end(const PacketLimits& limits) const {
    LaneMask result = 0;
    for (uint32_t lane = 0; lane < kPacketRays; ++lane) {
      result |= LaneMask{limits.last_t[lane] < cut_.t} << lane;
    }
    return result;
  }
  /// Returns the rays that have not ended before cut_.t, though they should have.
  LaneMask lanes_that_go_on(const PacketHits& hits) const {
    LaneMask lost = ~hits.hits;
    for (LaneMask left = hits.hits; left != 0; left &= left - 1) {
      if (hits.t[std::countr_zero(left)] > cut_.t) lost |= left & -left;
    }
    return lost;
  }

  const TraceList& trace(const RayPacket& rays, LaneMask lanes, const TraceList& list,
                         const PacketLimits* limits, PacketHits& hits) {
    const uint64_t resolved = workspace_.packets.resolved_rays;
    trace_packet(owner_.frame_, rays, lanes, list, owner_.parameters_, limits, workspace_.packets,
                 hits);
    if (!cut_.fallback) return workspace_.list.trace_list();
    // Culling found that rays end before the cut. But a ray may have gone on beyond a piece that is
    // too thin to exist, and what lies behind counts then.
    // Only coincidence resolution passes such pieces: other rays show where the solid's value
    // changes first.
    LaneMask doubtful = lanes;
    if (workspace_.packets.resolved_rays == resolved) {
      doubtful &= ~hits.hits;
      if (limits) doubtful &= ~lanes_that_end(*limits);
    }
    if (doubtful == 0 || (lanes & lanes_that_go_on(hits)) == 0) {
      return workspace_.list.trace_list();
    }
    if (!has_fallback_) assign_fallback();
    const TraceList& fallback = workspace_.fallback_list.trace_list();
    if (fallback.list->is_constant()) return workspace_.list.trace_list();
    trace_packet(owner_.frame_, rays, lanes, fallback, owner_.parameters_, limits,
                 workspace_.packets, hits);
    return fallback;
  }

  void assign_fallback() {
    has_fallback_ = true;
    CellList& restricted = workspace_.fallback;
    workspace_.restrictor.restrict(*cut_.fallback, owner_.box_of(tile_), restricted);
    const CellList* list =
        owner_.open_large_groups(tile_, &restricted, 0.0, workspace_.fallback_expanded, workspace_);
    workspace_.fallback_list.assign(owner_.solid_.primitives(), owner_.bounds_, tile_, *list);
  }

  TileTracer& owner_;
  const Tile& tile_;
  const Cut cut_;
  bool has_fallback_ = false;
  Workspace& workspace_;
};

void TileTracer::visit_leaf(const Tile& tile, const CellList& list, const Cut& cut,
                            Workspace& workspace, TileVisitor& visitor) {
  ++workspace.tiles;
  LeafRays rays(*this, tile, list, cut, workspace);
  visitor.visit(tile, rays);
}

TileTracer::Counts& TileTracer::Counts::operator+=(const Counts& other) {
  tiles += other.tiles;
  rays += other.rays;
  intersections += other.intersections;
  resolved_rays += other.resolved_rays;
  return *this;
}

TileTracer::Counts TileTracer::Workspaces::counts() const {
  Counts sum;
  for (const auto& workspace : pool_.all()) {
    const PacketWorkspace& packets = workspace->packets;
    sum += {workspace->tiles, packets.rays, packets.intersections, packets.resolved_rays};
  }
  return sum;
}

}  // namespace csgcore
