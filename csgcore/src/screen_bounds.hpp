// Where a solid's primitives and groups lie on the screen, as far as anyone asks.
#pragma once

#include <atomic>
#include <memory>
#include <span>

#include "operand_groups.hpp"
#include "restriction.hpp"
#include "screen_shape.hpp"

namespace csgcore {

/// The extents that tiles are divided by, of one frame. What stands in no group is bounded with the
/// frame; what a group holds, when that is opened.
class ScreenBounds final : public OpenClassifier {
 public:
  /// Keeps references to all of them.
  ScreenBounds(std::span<const CanonicalPrimitive> primitives, const OperandGroups& groups,
               const FrameRays& frame, bool centers_only);

  /// Indices as in OperandGroups; only those of what was bounded hold anything.
  std::span<const Extent> extents() const { return {screen_.get(), groups_.count()}; }

  /// Bounds what the group holds; false if no ray can meet any of it. From any thread, again and
  /// again.
  bool open(uint32_t group);
  /// Bounds all primitives, used or not. Not while other threads trace.
  void bound_all();

  /// In screen space.
  Answers classify(const uint32_t* primitives, uint64_t open, const Box& cell) const override;
  /// Of an opened group.
  std::optional<uint64_t> members_outside(const OperandGroups::Members& members, uint32_t first,
                                          uint32_t count, const Box& cell) const override;

 private:
  bool keep_rectangles(uint32_t group);
  /// How far the rows of rectangles_ lie apart.
  size_t rectangle_row() const { return groups_.member_count() + size_t{kRectanglePadding}; }
  void bound(std::span<const uint32_t> indices);

  enum State : uint8_t { kClosed, kOpening, kSeen, kUnseen };
  std::span<const CanonicalPrimitive> primitives_;
  const OperandGroups& groups_;
  const FrameRays& frame_;
  const ScreenOptions options_;
  std::unique_ptr<Extent[]> screen_;
  std::unique_ptr<ScreenShape[]> shapes_;  // of what fills its box badly and is on the screen
  std::unique_ptr<std::atomic<uint8_t>[]> states_;  // of the groups
  /// Of opened groups' members, side by side: what tiles tell them apart by. Low x of all, then
  /// high x, low y, high y.
  std::unique_ptr<float[]> rectangles_;
};

}  // namespace csgcore
