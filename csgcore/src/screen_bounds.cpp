#include "screen_bounds.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <numeric>
#include <thread>
#include <vector>

namespace csgcore {
namespace {

/// Primitives bounded by one task.
constexpr size_t kBoundedAtOnce = 4096;

/// Of what is smaller on the screen, its box tells enough.
constexpr double kOutlinelessHalf_px = 4;

/// As many as have bits in a word.
constexpr uint32_t kMembersAtOnce = 64;

/// If this part of a group's members meets a tile, others will: all are bounded at once.
constexpr uint32_t kManyMembers = 4;

bool meets(const Extent& screen, const Box& cell) {
  return fate_on_screen(screen) == ScreenFate::kVisible && overlaps(screen, cell);
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
      outlines_(std::make_unique_for_overwrite<ScreenOutline[]>(primitives.size())),
      states_(std::make_unique<std::atomic<uint8_t>[]>(groups.count() - groups.first_group())),
      bounded_(std::make_unique<std::atomic<uint8_t>[]>(groups.member_count())),
      rectangles_(std::make_unique_for_overwrite<float[]>(4 * groups.member_row())) {
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
  if (found == kClosed && state.compare_exchange_strong(found, kBusy, std::memory_order_acquire)) {
    found = find_rectangles_of(group) ? kSeen : kUnseen;
    state.store(found, std::memory_order_release);
  }
  // Another thread is about to have done it: some microseconds.
  while (found == kBusy) {
    std::this_thread::yield();
    found = state.load(std::memory_order_acquire);
  }
  return found == kSeen;
}

bool ScreenBounds::open_wholly(uint32_t group) {
  if (!open(group)) return false;
  const OperandGroups::Members members = groups_.members(group);
  const auto count = static_cast<uint32_t>(members.primitive.size());
  for (uint32_t first = 0; first < count; first += kMembersAtOnce) {
    bound_members(members, first, first_bits(std::min(count - first, kMembersAtOnce)));
  }
  return true;
}

/// Returns whether any ray can meet any of them.
bool ScreenBounds::find_rectangles_of(uint32_t group) {
  const OperandGroups::Members members = groups_.members(group);
  const auto count = static_cast<uint32_t>(members.primitive.size());
  // What stands elsewhere, too, was bounded with the frame.
  const std::span<const uint32_t> own = groups_.own(group);
  if (own.size() < count) {
    bound(own);
    for (uint32_t i = 0; i < count; ++i) {
      bounded_[members.first + i].store(1, std::memory_order_relaxed);
    }
  }
  const double* const center = groups_.extents()[group].center;
  const size_t row = groups_.member_row();
  float* const from = rectangles_.get() + members.first;
  return find_rectangles(groups_.balls(group), count, {center[0], center[1], center[2]}, frame_,
                         options_, {from, from + row, from + 2 * row, from + 3 * row});
}

/// Of an opened group's members from `first` on, those whose bit is set in `wanted`.
void ScreenBounds::bound_members(const OperandGroups::Members& members, uint32_t first,
                                 uint64_t wanted) const {
  std::atomic<uint8_t>* const bounded = bounded_.get() + members.first + first;
  const auto find_missing = [&](uint32_t(&missing)[kMembersAtOnce]) {
    uint32_t count = 0;
    for (uint64_t left = wanted; left != 0; left &= left - 1) {
      const int i = std::countr_zero(left);
      missing[count] = static_cast<uint32_t>(i);
      count += bounded[i].load(std::memory_order_acquire) == 0;
    }
    return count;
  };
  uint32_t missing[kMembersAtOnce];
  if (find_missing(missing) == 0) return;
  std::atomic<uint8_t>& state = states_[members.group - groups_.first_group()];
  uint8_t expected = kSeen;
  while (!state.compare_exchange_weak(expected, kBusy, std::memory_order_acquire)) {
    std::this_thread::yield();
    expected = kSeen;
  }
  const uint32_t count = find_missing(missing);
  uint32_t indices[kMembersAtOnce];
  for (uint32_t i = 0; i < count; ++i) {
    indices[i] = members.primitive[first + missing[i]] & kPrimitiveBits;
  }
  bound({indices, count});
  for (uint32_t i = 0; i < count; ++i) bounded[missing[i]].store(1, std::memory_order_release);
  state.store(kSeen, std::memory_order_release);
}

void ScreenBounds::bound_all() {
  std::vector<uint32_t> indices(primitives_.size());
  std::iota(indices.begin(), indices.end(), 0u);
  bound(indices);
}

OpenClassifier::Answers ScreenBounds::classify(const uint32_t* primitives, uint64_t open,
                                               const Box& cell) const {
  uint64_t outside = 0;
  for (uint64_t left = open; left != 0; left &= left - 1) {
    const uint32_t primitive = primitives[std::countr_zero(left)] & kPrimitiveBits;
    if (misses(outlines_[primitive], cell)) outside |= left & -left;
  }
  return {outside, 0};
}

std::optional<uint64_t> ScreenBounds::members_outside(const OperandGroups::Members& members,
                                                      uint32_t first, uint32_t count,
                                                      const Box& cell) const {
  const uint32_t* const primitives = members.primitive.data() + first;
  const size_t row = groups_.member_row();
  const float* const from = rectangles_.get() + members.first + first;
  const RectangleRows rows{from, from + row, from + 2 * row, from + 3 * row};
  uint64_t outside = find_outside(rows, count, cell);
  const uint64_t near = ~outside & first_bits(count);
  if (near == 0) return outside;
  const bool are_many = kManyMembers * static_cast<uint32_t>(std::popcount(near)) >= count;
  bound_members(members, first, are_many ? first_bits(count) : near);
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
  // They lie anywhere in memory: all of them are fetched at once.
  for (const uint32_t i : indices) {
    prefetch(&groups_.extents()[i], sizeof(Extent));
    prefetch(&screen_[i], sizeof(Extent));
  }
  find_screen_extents(groups_.extents().data(), indices, frame_, options_, screen_.get());
  const auto needs_outline = [&](uint32_t i) {
    const Extent& extent = screen_[i];
    return extent.inside2 < 0 && fate_on_screen(extent) == ScreenFate::kVisible &&
           std::max(extent.half[0], extent.half[1]) >= kOutlinelessHalf_px;
  };
  uint32_t outlined[kMembersAtOnce];
  uint32_t count = 0;
  for (const uint32_t i : indices) {
    if (!needs_outline(i)) {
      screen_[i].inside2 = 0;
      continue;
    }
    prefetch(&primitives_[i], sizeof(CanonicalPrimitive));
    prefetch(&outlines_[i], sizeof(ScreenOutline));
    outlined[count++] = i;
    if (count < kMembersAtOnce) continue;
    find_outlines(primitives_.data(), outlined, frame_, options_, screen_.get(), outlines_.get());
    count = 0;
  }
  find_outlines(primitives_.data(), {outlined, count}, frame_, options_, screen_.get(),
                outlines_.get());
}

}  // namespace csgcore
