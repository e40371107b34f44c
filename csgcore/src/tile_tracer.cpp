#include "tile_tracer.hpp"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <limits>

#include "packet_blocks.hpp"
#include "restriction.hpp"

namespace csgcore {
namespace {

/// A tile of kTileSide_px is traced if its list is this short; of one packet in any case.
constexpr uint32_t kTileList = 16;
/// So are larger ones whose list is this short: dividing it costs more than it saves.
constexpr uint32_t kShortList = 3;
constexpr uint32_t kShortListSide_px = 32;

/// Larger tiles are divided by two tasks.
constexpr uint32_t kTaskPixels = 64 * 64;

/// Lists longer than the first are simplified (TileSimplifier) at some sizes of tile, since it
/// takes several passes over the list; lists longer than the second at every size.
constexpr uint32_t kLongList = 24;
constexpr uint32_t kVeryLongList = 4096;
constexpr uint32_t kSimplifiedPixels[] = {128 * 128, 64 * 64, 16 * 32};

/// What is left of a list that was cut is mostly what is seen; longer ones are worth another look.
constexpr uint32_t kLongCutList = 256;

bool is_simplified(const Tile& tile, uint32_t literals, bool is_cut) {
  if (literals <= (is_cut ? kLongCutList : kLongList)) return false;
  const uint32_t pixels = tile.width * tile.height;
  // A division halves a tile, so that about one on the way down is of each size.
  const bool is_time =
      std::any_of(std::begin(kSimplifiedPixels), std::end(kSimplifiedPixels),
                  [&](uint32_t size) { return pixels <= size && 2 * pixels > size; });
  return is_time || literals > kVeryLongList;
}

/// Primitives bounded by one task.
constexpr size_t kBoundedAtOnce = 4096;

}  // namespace

void trace_block(const FrameRays& frame, const PacketBlock& block, TileRays& rays, HitSink& sink) {
  RayPacket packet;
  make_block_rays(frame, block, packet);
  PacketHits hits;
  const TraceList& list = rays.trace(packet, block, hits);
  sink.store(block, packet, list, hits);
}

void TileList::assign(std::span<const CanonicalPrimitive> primitives, const Extents& screen,
                      const Tile& tile, const CellList& list) {
  const uint32_t count = list.count();
  tile_ = tile;
  nearest_.resize(count);
  for (auto& is_missed : is_missed_) is_missed.resize(count);
  const double middle_x = tile.x + kPacketSide_px - 0.5;
  const double middle_y = tile.y + kPacketSide_px - 0.5;
  double earliest = std::numeric_limits<double>::infinity();
  for (uint32_t i = 0; i < count; ++i) {
    const Extent& extent = screen[list.primitive[i] & kPrimitiveBits];
    nearest_[i] = nearest_t(extent);
    earliest = std::min(earliest, nearest_[i]);
    const bool right_only = extent.center[0] - extent.half[0] > middle_x;
    const bool left_only = extent.center[0] + extent.half[0] < middle_x;
    const bool lower_only = extent.center[1] - extent.half[1] > middle_y;
    const bool upper_only = extent.center[1] + extent.half[1] < middle_y;
    is_missed_[0][i] = right_only | lower_only;
    is_missed_[1][i] = left_only | lower_only;
    is_missed_[2][i] = right_only | upper_only;
    is_missed_[3][i] = left_only | upper_only;
  }
  trace_ = {primitives.data(), &list, nearest_.data(), earliest, nullptr};
}

TraceList TileList::trace_list(const PacketBlock& block) const {
  TraceList trace = trace_;
  if (std::max(tile_.width, tile_.height) <= kTileSide_px) {
    trace.is_missed = is_missed_[(block.y > tile_.y ? 2 : 0) + (block.x > tile_.x ? 1 : 0)].data();
  }
  return trace;
}

/// In screen space.
class TileTracer::Classifier final : public OpenClassifier {
 public:
  Classifier(const Extents& screen, const std::unique_ptr<ScreenShape[]>& shapes,
             const FrameRays& frame)
      : screen_(screen), shapes_(shapes), frame_(frame) {}
  Answers classify(const uint32_t* primitives, uint64_t open, const Box& cell) const override {
    return {find_misses(shapes_.get(), screen_.data(), primitives, open, frame_, cell), 0};
  }

 private:
  const Extents& screen_;
  const std::unique_ptr<ScreenShape[]>& shapes_;
  const FrameRays& frame_;
};

/// The lists of one level of the recursion, reused by all tiles of that level.
struct TileTracer::Level {
  CellList halves[2];
  CellList simplified;
};

/// What one task works with.
struct TileTracer::Workspace {
  explicit Workspace(const TileTracer& owner)
      : restrictor(owner.screen_, *owner.classifier_, Restrictor::Space::kScreen),
        simplifier(owner.solid_.primitives(), owner.screen_, owner.frame_, owner.centers_only_,
                   owner.last_value_, owner.fates_) {}
  Level& level(size_t index) {
    while (levels.size() <= index) levels.push_back(std::make_unique<Level>());
    return *levels[index];
  }

  Restrictor restrictor;
  TileSimplifier simplifier;
  PacketWorkspace packets;
  std::vector<std::unique_ptr<Level>> levels;
  TileList list, uncut_list;
  uint64_t tiles = 0;
};

/// A workspace, taken for as long as this lives.
class TileTracer::Lease {
 public:
  explicit Lease(TileTracer& owner) : owner_(owner) {
    const std::lock_guard lock(owner.mutex_);
    if (owner.free_workspaces_.empty()) {
      owner.workspaces_.push_back(std::make_unique<Workspace>(owner));
      owner.free_workspaces_.push_back(owner.workspaces_.back().get());
    }
    workspace_ = owner.free_workspaces_.back();
    owner.free_workspaces_.pop_back();
  }
  ~Lease() {
    const std::lock_guard lock(owner_.mutex_);
    owner_.free_workspaces_.push_back(workspace_);
  }
  Lease(const Lease&) = delete;
  Lease& operator=(const Lease&) = delete;
  Workspace& operator*() const { return *workspace_; }

 private:
  TileTracer& owner_;
  Workspace* workspace_;
};

TileTracer::TileTracer(const Solid& solid, const FrameRays& frame, const TraceSubject& subject,
                       bool centers_only, Fates& fates)
    : solid_(solid),
      frame_(frame),
      subject_(subject),
      centers_only_(centers_only),
      fates_(fates),
      screen_(solid.extents().size()),
      classifier_(std::make_unique<Classifier>(screen_, shapes_, frame)) {
  last_value_ = find_last_value();
  const Extents& world = solid.extents();
  const ScreenOptions options{centers_only};
  const bool has_shapes = std::any_of(world.begin(), world.end(),
                                      [](const Extent& extent) { return extent.inside2 < 0; });
  // Only those of what is on the screen are written, and asked for.
  if (has_shapes) shapes_ = std::make_unique_for_overwrite<ScreenShape[]>(world.size());
  const auto bound = [&](size_t begin, size_t end) {
    find_screen_extents(world.data(), begin, end, frame, options, screen_.data());
    for (size_t i = begin; has_shapes && i < end; ++i) {
      if (screen_[i].inside2 < 0 && fate_on_screen(screen_[i]) == ScreenFate::kVisible) {
        shapes_[i] = screen_shape(solid.primitives()[i], frame);
        narrow_extent(shapes_[i], frame, options, screen_[i]);
      }
    }
  };
  if (world.size() <= kBoundedAtOnce) {
    bound(0, world.size());
    return;
  }
  // Blocks of a fixed size: a vector never spans two of them.
  const size_t blocks = (world.size() + kBoundedAtOnce - 1) / kBoundedAtOnce;
  tbb::parallel_for(size_t{0}, blocks, [&](size_t block) {
    bound(block * kBoundedAtOnce, std::min(world.size(), (block + 1) * kBoundedAtOnce));
  });
}

TileTracer::~TileTracer() = default;

/// A ray ends where the value is no longer that at the eye, if that is the same for all rays.
std::optional<bool> TileTracer::find_last_value() const {
  if (subject_.boundary == Boundary::kBehind || !solid_.cell_list()) return std::nullopt;
  if (frame_.view.projection == Projection::kOrthographic) return true;
  // Rays start up to a few tolerances from the eye: further in the picture's corners.
  constexpr double kEyeTolerances = 64;
  const Vec3 reach{kEyeTolerances * subject_.thinnest_piece};
  const Box& bounds = solid_.bounds();
  for (int axis = 0; axis < 3; ++axis) {
    const double eye = frame_.view.eye[axis];
    if (eye + reach[axis] < bounds.min[axis] || eye - reach[axis] > bounds.max[axis]) return true;
  }
  const WorldClassifier classifier(solid_.primitives());
  Restrictor restrictor(solid_.extents(), classifier);
  CellList at_eye;
  restrictor.restrict(*solid_.cell_list(), {frame_.view.eye - reach, frame_.view.eye + reach},
                      at_eye);
  if (!at_eye.is_constant()) return std::nullopt;
  return at_eye.root == CellList::kFalse;
}

Tile TileTracer::whole_picture() const {
  return {0, 0, frame_.view.width_px, frame_.view.height_px};
}

Box TileTracer::box_of(const Tile& tile) const {
  constexpr double kAnyDepth = std::numeric_limits<double>::infinity();
  const double border = centers_only_ ? 0.0 : 0.5;
  const double x = tile.x;
  const double y = tile.y;
  return {{x - border, y - border, -kAnyDepth},
          {x + tile.width - 1 + border, y + tile.height - 1 + border, kAnyDepth}};
}

void TileTracer::visit(const Tile& area, TileVisitor& visitor) {
  if (!solid_.cell_list()) {
    visitor.visit_empty(area);
    return;
  }
  const Lease workspace(*this);
  CellList& list = (*workspace).level(0).halves[0];
  (*workspace).restrictor.restrict(*solid_.cell_list(), box_of(area), list);
  divide(area, list, nullptr, 1, *workspace, visitor);
}

/// Recursion halves the tile each time.
void TileTracer::divide(const Tile& tile, const CellList& given, const CellList* uncut,
                        size_t level, Workspace& workspace, TileVisitor& visitor) {
  if (!visitor.wants(tile)) return;
  const CellList* list = &given;
  Level& own = workspace.level(level);
  if (is_simplified(tile, list->count(), uncut != nullptr)) {
    bool cuts = false;
    if (workspace.simplifier.simplify(tile, *list, workspace.restrictor, own.simplified, cuts)) {
      list = &own.simplified;
      if (cuts && !uncut) uncut = &given;
    }
  }
  if (list->is_constant() && !uncut) {
    visitor.visit_empty(tile);
    return;
  }
  const uint32_t side = std::max(tile.width, tile.height);
  if (side <= kPacketSide_px || (side <= kTileSide_px && list->count() <= kTileList) ||
      (side <= kShortListSide_px && list->count() <= kShortList)) {
    visit_leaf(tile, *list, uncut, workspace, visitor);
    return;
  }
  Tile below = tile, above = tile;
  const bool across = tile.width >= tile.height;
  const uint32_t unit = side > kTileSide_px ? kTileSide_px : kPacketSide_px;
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
      divide(part, part_list, uncut, 0, *lease, visitor);
    };
    tbb::parallel_invoke([&] { task(below, own.halves[0]); }, [&] { task(above, own.halves[1]); });
    return;
  }
  divide(below, own.halves[0], uncut, level + 1, workspace, visitor);
  divide(above, own.halves[1], uncut, level + 1, workspace, visitor);
}

class TileTracer::LeafRays final : public TileRays {
 public:
  /// `uncut`: the list before what is hidden was dropped from it, or null.
  LeafRays(const TileTracer& owner, const Tile& tile, const CellList& list, const CellList* uncut,
           Workspace& workspace)
      : owner_(owner), tile_(tile), uncut_(uncut), workspace_(workspace) {
    workspace.list.assign(owner.solid_.primitives(), owner.screen_, tile, list);
  }

  const TraceList& trace(const RayPacket& rays, LaneMask lanes, PacketHits& hits) override {
    return trace(rays, lanes, workspace_.list.trace_list(), hits);
  }

  const TraceList& trace(const RayPacket& rays, const PacketBlock& block,
                         PacketHits& hits) override {
    return trace(rays, block.lanes, workspace_.list.trace_list(block), hits);
  }

 private:
  const TraceList& trace(const RayPacket& rays, LaneMask lanes, const TraceList& list,
                         PacketHits& hits) {
    trace_packet(owner_.frame_, rays, lanes, list, owner_.subject_, workspace_.packets, hits);
    // The solid was found to hold where the list was cut. Should a ray have missed it all the same,
    // by a piece too thin to exist, what lies behind counts.
    if (!uncut_ || (hits.hits & lanes) == lanes) return workspace_.list.trace_list();
    workspace_.packets.was_computed.clear();
    workspace_.uncut_list.assign(owner_.solid_.primitives(), owner_.screen_, tile_, *uncut_);
    const TraceList& uncut = workspace_.uncut_list.trace_list();
    trace_packet(owner_.frame_, rays, lanes, uncut, owner_.subject_, workspace_.packets, hits);
    return uncut;
  }

  const TileTracer& owner_;
  const Tile& tile_;
  const CellList* uncut_;
  Workspace& workspace_;
};

void TileTracer::visit_leaf(const Tile& tile, const CellList& list, const CellList* uncut,
                            Workspace& workspace, TileVisitor& visitor) {
  ++workspace.tiles;
  workspace.packets.was_computed.assign(fates_.wanted() ? list.count() : 0, 0);
  LeafRays rays(*this, tile, list, uncut, workspace);
  visitor.visit(tile, rays);
  if (!fates_.wanted()) return;
  const std::vector<uint8_t>& was_computed = workspace.packets.was_computed;
  for (uint32_t i = 0; i < list.count(); ++i) {
    const bool intersected = was_computed.empty() || was_computed[i];
    fates_.note(list.primitive[i] & kPrimitiveBits,
                intersected ? Fate::kIntersected : Fate::kHidden);
  }
}

TileTracer::Counts TileTracer::counts() const {
  Counts sum;
  for (const auto& workspace : workspaces_) {
    sum.tiles += workspace->tiles;
    sum.rays += workspace->packets.rays;
    sum.intersections += workspace->packets.intersections;
    sum.resolved_rays += workspace->packets.resolved_rays;
  }
  return sum;
}

void TileTracer::note_screen_fates() {
  for (size_t i = 0; i < screen_.size(); ++i) {
    const ScreenFate fate = fate_on_screen(screen_[i]);
    const uint32_t primitive = static_cast<uint32_t>(i);
    if (fate == ScreenFate::kOffScreen) fates_.note(primitive, Fate::kOffScreen);
    if (fate == ScreenFate::kSubPixel) fates_.note(primitive, Fate::kSubPixel);
  }
}

}  // namespace csgcore
