// Where a solid's primitives and groups lie on the screen, as far as anyone asks.
#pragma once

#include <atomic>
#include <memory>
#include <span>

#include "operand_groups.hpp"
#include "restriction.hpp"
#include "screen_outline.hpp"

namespace csgcore {

/// The extents that tiles are divided by, of one frame. What stands in no group is bounded with the
/// frame. What a group holds is told apart from tiles by rectangles, which are found when it is
/// opened; what meets a tile is bounded then.
class ScreenBounds final : public OpenClassifier {
 public:
  /// Keeps references to all of them.
  ScreenBounds(std::span<const CanonicalPrimitive> primitives, const OperandGroups& groups,
               const FrameRays& frame, bool centers_only);

  /// Indices as in OperandGroups; only those of what was bounded hold anything.
  std::span<const Extent> extents() const { return {screen_.get(), groups_.count()}; }

  /// Of those whose inside2 < 0.
  const ScreenOutline* outlines() const { return outlines_.get(); }

  /// Finds the rectangles of what the group holds; false if no ray can meet any of it. From any
  /// thread, again and again.
  bool open(uint32_t group);
  /// Bounds all that the group holds, too, unless no ray can meet any of it.
  bool open_wholly(uint32_t group);
  /// Bounds all primitives, used or not. Not while other threads trace.
  void bound_all();

  /// In screen space.
  Answers classify(const uint32_t* primitives, uint64_t open, const Box& cell) const override;
  /// Of an opened group; bounds those that are not outside.
  std::optional<uint64_t> members_outside(const OperandGroups::Members& members, uint32_t first,
                                          uint32_t count, const Box& cell) const override;

 private:
  bool find_rectangles_of(uint32_t group);
  void bound_members(const OperandGroups::Members& members, uint32_t first, uint64_t wanted) const;
  void bound(std::span<const uint32_t> indices) const;

  /// Of a group. kBusy: some thread writes what belongs to it.
  enum State : uint8_t { kClosed, kBusy, kSeen, kUnseen };
  std::span<const CanonicalPrimitive> primitives_;
  const OperandGroups& groups_;
  const FrameRays& frame_;
  const ScreenOptions options_;
  std::unique_ptr<Extent[]> screen_;
  std::unique_ptr<ScreenOutline[]> outlines_;  // of what fills its box badly and is on the screen
  std::unique_ptr<std::atomic<uint8_t>[]> states_;   // of the groups
  std::unique_ptr<std::atomic<uint8_t>[]> bounded_;  // of members: whether screen_ holds them
  /// Of opened groups' members, side by side: what tiles tell them apart by. Low x of all, then
  /// high x, low y, high y.
  std::unique_ptr<float[]> rectangles_;
};

}  // namespace csgcore
