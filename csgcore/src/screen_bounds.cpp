#include "screen_bounds.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
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
      states_(std::make_unique<std::atomic<uint8_t>[]>(groups.count() - groups.first_group())) {
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
    found = is_any_seen(group) ? kSeen : kUnseen;
    state.store(found, std::memory_order_release);
  }
  // Another thread is about to have done it: some microseconds.
  while (found == kOpening) {
    std::this_thread::yield();
    found = state.load(std::memory_order_acquire);
  }
  return found == kSeen;
}

bool ScreenBounds::is_any_seen(uint32_t group) const {
  const std::span<const uint32_t> members = groups_.members(group).primitive;
  return std::any_of(members.begin(), members.end(), [&](uint32_t entry) {
    return fate_on_screen(screen_[entry & kPrimitiveBits]) == ScreenFate::kVisible;
  });
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
