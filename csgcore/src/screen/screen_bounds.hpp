// Where a solid's primitives and groups lie on the screen, as far as anyone asks.
#pragma once

#include <atomic>
#include <memory>
#include <span>

#include "screen/screen_slab.hpp"
#include "solid/operand_groups.hpp"
#include "solid/restriction.hpp"

namespace csgcore {

/// The extents that tiles are divided by, of one frame. What stands in no group is bounded with the
/// frame. What a group holds is told apart from tiles by rectangles, which are found with the
/// group's own; what meets a tile by these is bounded.
class ScreenBounds final : public OpenClassifier {
 public:
  /// Keeps references to all of them.
  ScreenBounds(std::span<const CanonicalPrimitive> primitives, const OperandGroups& groups,
               const FrameRays& frame, bool centers_only);

  /// Indices as in OperandGroups; only those of what was bounded hold anything.
  std::span<const Extent> extents() const { return {screen_.get(), groups_.count()}; }

  /// Of those whose inside2 < 0.
  const ScreenSlab* slabs() const { return slabs_.get(); }

  /// Bounds all that the group holds. From any thread, again and again.
  void open_wholly(uint32_t group);
  /// Bounds all primitives, used or not. Not while other threads trace.
  void bound_all();

  /// In screen space.
  Answers classify(const uint32_t* primitives, uint64_t open, const Box& cell) const override;
  /// Of a group that is bounded; bounds those that are not outside.
  std::optional<uint64_t> members_outside(const OperandGroups::Members& members, uint32_t first,
                                          uint32_t count, const Box& cell) const override;

 private:
  void narrow_to_members(uint32_t group) const;
  void bound_members(const OperandGroups::Members& members, uint32_t first, uint64_t wanted) const;
  void bound(std::span<const uint32_t> indices) const;

  /// Of a group. kBusy: some thread writes what belongs to it.
  enum State : uint8_t { kFree, kBusy };
  std::span<const CanonicalPrimitive> primitives_;
  const OperandGroups& groups_;
  const FrameRays& frame_;
  const ScreenOptions options_;
  std::unique_ptr<Extent[]> screen_;
  std::unique_ptr<ScreenSlab[]> slabs_;              // of whose inside2 < 0
  std::unique_ptr<ScreenKDop[]> corners_;            // of those that are large
  std::unique_ptr<std::atomic<uint8_t>[]> states_;   // of the groups
  std::unique_ptr<std::atomic<uint8_t>[]> bounded_;  // by index: whether screen_ holds it
  /// Of the members of groups that are seen: what tiles tell them apart by. Of one group low x of
  /// all, then high x, low y, high y; then the next group's.
  std::unique_ptr<float[]> rectangles_;
};

}  // namespace csgcore
