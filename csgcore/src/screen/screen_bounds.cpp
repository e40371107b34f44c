#include "screen/screen_bounds.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <thread>
#include <vector>

namespace csgcore {
namespace {

/// The number of primitives that one task bounds.
constexpr size_t kBoundedAtOnce = 4096;

/// A primitive whose larger half extent on the screen is below this needs no slab: its box is good
/// enough.
constexpr double kSlablessHalf_px = 4;

/// As many members as a word has bits.
constexpr uint32_t kMembersAtOnce = 64;

bool meets(const Extent& screen, const Box& cell) {
  return is_visible(screen) && overlaps(screen, cell);
}

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
      slabs_(std::make_unique_for_overwrite<ScreenSlab[]>(primitives.size())),
      corners_(std::make_unique_for_overwrite<ScreenKDop[]>(primitives.size())),
      states_(std::make_unique<std::atomic<uint8_t>[]>(groups.count() - groups.first_group())),
      bounded_(std::make_unique<std::atomic<uint8_t>[]>(groups.count())),
      rectangles_(std::make_unique_for_overwrite<float[]>(groups.row_size())) {
  const std::span<const uint32_t> common = groups.common();
  for (const uint32_t i : common) bounded_[i].store(1, std::memory_order_relaxed);
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

/// Narrows a group's extent to the rectangles of its members, which its box in the world exceeds.
void ScreenBounds::narrow_to_members(uint32_t group) const {
  const OperandGroups::Members members = groups_.members(group);
  const double* const center = groups_.extents()[group].center;
  const auto [low_x, high_x, low_y, high_y] = members.rows(rectangles_.get());
  const ScreenRectangle all = find_rectangles(
      groups_.balls(group), static_cast<uint32_t>(members.primitive.size()),
      {center[0], center[1], center[2]}, frame_, options_, {low_x, high_x, low_y, high_y});
  narrow(all, frame_.view, screen_[group]);
}

/// Bounds those of a group's members from `first` on whose bits are set in `wanted`. Members that
/// other tests name, too, were bounded in the constructor, so that this group's lock is enough for
/// the others.
void ScreenBounds::bound_members(const OperandGroups::Members& members, uint32_t first,
                                 uint64_t wanted) const {
  uint32_t missing[kMembersAtOnce];
  const auto find_missing = [&] {
    uint32_t count = 0;
    for (uint64_t left = wanted; left != 0; left &= left - 1) {
      const auto i = static_cast<uint32_t>(std::countr_zero(left));
      missing[count] = members.primitive[first + i] & kPrimitiveBits;
      count += bounded_[missing[count]].load(std::memory_order_acquire) == 0;
    }
    return count;
  };
  if (find_missing() == 0) return;
  std::atomic<uint8_t>& state = states_[members.group - groups_.first_group()];
  // Another thread is bounding members, which takes microseconds.
  while (state.exchange(kBusy, std::memory_order_acquire) == kBusy) std::this_thread::yield();
  const std::span<const uint32_t> indices(missing, find_missing());
  bound(indices);
  for (const uint32_t i : indices) bounded_[i].store(1, std::memory_order_release);
  state.store(kFree, std::memory_order_release);
}

OpenClassifier::Answers ScreenBounds::classify(const uint32_t* primitives, uint64_t open,
                                               const Box& cell) const {
  uint64_t outside = 0;
  for (uint64_t left = open; left != 0; left &= left - 1) {
    const uint32_t primitive = primitives[std::countr_zero(left)] & kPrimitiveBits;
    const bool is_cornered = screen_[primitive].inside2 == kCornered;
    if (misses(slabs_[primitive], cell) || (is_cornered && misses(corners_[primitive], cell))) {
      outside |= left & -left;
    }
  }
  return {outside, 0};
}

std::optional<uint64_t> ScreenBounds::members_outside(const OperandGroups::Members& members,
                                                      uint32_t first, uint32_t count,
                                                      const Box& cell) const {
  const uint32_t* const primitives = members.primitive.data() + first;
  const auto [low_x, high_x, low_y, high_y] = members.rows(rectangles_.get());
  uint64_t outside =
      find_outside({low_x + first, high_x + first, low_y + first, high_y + first}, count, cell);
  const uint64_t near = ~outside & first_bits(count);
  if (near == 0) return outside;
  bound_members(members, first, near);
  uint64_t open = 0;
  for (uint64_t left = near; left != 0; left &= left - 1) {
    const Extent& extent = screen_[primitives[std::countr_zero(left)] & kPrimitiveBits];
    if (!meets(extent, cell)) {
      outside |= left & -left;
    } else if (extent.inside2 < 0) {
      open |= left & -left;
    }
  }
  if (open != 0) outside |= classify(primitives, open, cell).outside;
  return outside;
}

void ScreenBounds::bound(std::span<const uint32_t> indices) const {
  // They are scattered in memory, and are all prefetched at once.
  for (const uint32_t i : indices) {
    prefetch(&groups_.extents()[i], sizeof(Extent));
    prefetch(&screen_[i], sizeof(Extent));
  }
  find_screen_extents(groups_.extents().data(), indices, frame_, options_, screen_.get());
  for (const uint32_t i : indices) {
    if (!groups_.is_group(i)) continue;
    if (is_visible(screen_[i])) narrow_to_members(i);
  }
  const auto needs_slab = [&](uint32_t i) {
    const Extent& extent = screen_[i];
    if (groups_.is_group(i) || !is_visible(extent)) return false;
    const auto [least, most] = std::minmax(extent.half[0], extent.half[1]);
    return extent.inside2 < 0 ? most >= kSlablessHalf_px : least >= kCorneredHalf_px;
  };
  uint32_t with_slabs[kMembersAtOnce];
  uint32_t count = 0;
  const auto flush = [&] {
    find_slabs(primitives_.data(), {with_slabs, count}, frame_, options_, screen_.get(),
               slabs_.get(), corners_.get());
    count = 0;
  };
  for (const uint32_t i : indices) {
    if (!needs_slab(i)) {
      screen_[i].inside2 = 0;
      continue;
    }
    prefetch(&primitives_[i], sizeof(CanonicalPrimitive));
    prefetch(&slabs_[i], sizeof(ScreenSlab));
    with_slabs[count++] = i;
    if (count == kMembersAtOnce) flush();
  }
  flush();
}

}  // namespace csgcore
