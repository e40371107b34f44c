#include "screen_bounds.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>
#include <thread>
#include <vector>

namespace csgcore {
namespace {

/// Primitives bounded by one task.
constexpr size_t kBoundedAtOnce = 4096;

/// Of what is smaller on the screen, its box tells enough.
constexpr double kShapelessHalf_px = 4;

void prefetch(const void* object, size_t bytes) {
  constexpr size_t kLine = 64;
  for (size_t i = 0; i < bytes; i += kLine) {
    __builtin_prefetch(static_cast<const char*>(object) + i);
  }
}

}  // namespace

ScreenBounds::ScreenBounds(std::span<const CanonicalPrimitive> primitives,
                           const OperandGroups& groups, const FrameRays& frame, bool centers_only)
    : primitives_(primitives),
      groups_(groups),
      frame_(frame),
      options_{centers_only},
      screen_(std::make_unique_for_overwrite<Extent[]>(groups.count())),
      shapes_(std::make_unique_for_overwrite<ScreenShape[]>(primitives.size())),
      states_(std::make_unique<std::atomic<uint8_t>[]>(groups.count() - groups.first_group())),
      rectangles_(std::make_unique_for_overwrite<float[]>(4 * rectangle_row())) {
  const std::span<const uint32_t> common = groups.common();
  if (common.size() <= kBoundedAtOnce) {
    bound(common);
    return;
  }
  const size_t blocks = (common.size() + kBoundedAtOnce - 1) / kBoundedAtOnce;
  tbb::parallel_for(size_t{0}, blocks, [&](size_t block) {
    const size_t first = block * kBoundedAtOnce;
    bound(common.subspan(first, std::min(kBoundedAtOnce, common.size() - first)));
  });
}

bool ScreenBounds::open(uint32_t group) {
  std::atomic<uint8_t>& state = states_[group - groups_.first_group()];
  uint8_t found = state.load(std::memory_order_acquire);
  if (found == kClosed &&
      state.compare_exchange_strong(found, kOpening, std::memory_order_acquire)) {
    bound(groups_.own(group));
    found = keep_rectangles(group) ? kSeen : kUnseen;
    state.store(found, std::memory_order_release);
  }
  // Another thread is about to have done it: some microseconds.
  while (found == kOpening) {
    std::this_thread::yield();
    found = state.load(std::memory_order_acquire);
  }
  return found == kSeen;
}

/// Returns whether any ray can meet any of them.
bool ScreenBounds::keep_rectangles(uint32_t group) {
  // Coordinates lie within far_off, 1e6, where float rounds by half of this at most.
  constexpr float kFloatSlack_px = 0.125f;
  constexpr float kNowhere = std::numeric_limits<float>::infinity();
  const OperandGroups::Members members = groups_.members(group);
  const size_t row = rectangle_row();
  float* to = rectangles_.get() + members.first;
  bool any = false;
  for (const uint32_t entry : members.primitive) {
    const Extent& extent = screen_[entry & kPrimitiveBits];
    const bool is_seen = fate_on_screen(extent) == ScreenFate::kVisible;
    for (const size_t axis : {0, 1}) {
      const float low = static_cast<float>(extent.center[axis] - extent.half[axis]);
      const float high = static_cast<float>(extent.center[axis] + extent.half[axis]);
      to[2 * axis * row] = is_seen ? low - kFloatSlack_px : kNowhere;
      to[(2 * axis + 1) * row] = is_seen ? high + kFloatSlack_px : -kNowhere;
    }
    any |= is_seen;
    ++to;
  }
  return any;
}

void ScreenBounds::bound_all() {
  std::vector<uint32_t> indices(primitives_.size());
  std::iota(indices.begin(), indices.end(), 0u);
  bound(indices);
}

OpenClassifier::Answers ScreenBounds::classify(const uint32_t* primitives, uint64_t open,
                                               const Box& cell) const {
  return {find_misses(shapes_.get(), screen_.get(), primitives, open, frame_, cell), 0};
}

std::optional<uint64_t> ScreenBounds::members_outside(const OperandGroups::Members& members,
                                                      uint32_t first, uint32_t count,
                                                      const Box& cell) const {
  const uint32_t* const primitives = members.primitive.data() + first;
  const size_t row = rectangle_row();
  const float* const from = rectangles_.get() + members.first + first;
  const RectangleRows rows{from, from + row, from + 2 * row, from + 3 * row};
  uint64_t outside = find_outside(rows, count, cell);
  uint64_t open = 0;
  for (uint64_t left = ~outside & ~uint64_t{0} >> (64 - count); left != 0; left &= left - 1) {
    const uint32_t primitive = primitives[std::countr_zero(left)] & kPrimitiveBits;
    if (screen_[primitive].inside2 < 0) open |= left & -left;
  }
  if (open != 0) outside |= classify(primitives, open, cell).outside;
  return outside;
}

void ScreenBounds::bound(std::span<const uint32_t> indices) {
  // They lie anywhere in memory: all of them are fetched at once.
  for (const uint32_t i : indices) {
    prefetch(&groups_.extents()[i], sizeof(Extent));
    prefetch(&screen_[i], sizeof(Extent));
  }
  find_screen_extents(groups_.extents().data(), indices, frame_, options_, screen_.get());
  const auto needs_shape = [&](uint32_t i) {
    const Extent& extent = screen_[i];
    return extent.inside2 < 0 && fate_on_screen(extent) == ScreenFate::kVisible &&
           std::max(extent.half[0], extent.half[1]) >= kShapelessHalf_px;
  };
  for (const uint32_t i : indices) {
    if (needs_shape(i)) {
      prefetch(&primitives_[i], sizeof(CanonicalPrimitive));
      prefetch(&shapes_[i], sizeof(ScreenShape));
    } else {
      screen_[i].inside2 = 0;
    }
  }
  for (const uint32_t i : indices) {
    if (screen_[i].inside2 >= 0) continue;
    shapes_[i] = screen_shape(primitives_[i], frame_);
    narrow_extent(primitives_[i], shapes_[i], frame_, options_, screen_[i]);
  }
}

}  // namespace csgcore
