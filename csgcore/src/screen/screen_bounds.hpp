// The bounds of a solid's primitives and groups on the screen, which are computed when needed.
#pragma once

#include <atomic>
#include <memory>
#include <span>

#include "screen/screen_slab.hpp"
#include "solid/operand_groups.hpp"
#include "solid/restriction.hpp"

namespace csgcore {

/// The extents by which tiles are divided, for one frame. Primitives and groups that are in no
/// group are bounded in the constructor. Members of a group are first tested against tiles by
/// rectangles, which are found when the group is bounded; a member that meets a tile by its
/// rectangle is then bounded itself.
class ScreenBounds final : public OpenClassifier {
 public:
  /// Keeps references to all arguments but `centers_only`.
  ScreenBounds(std::span<const CanonicalPrimitive> primitives, const OperandGroups& groups,
               const FrameRays& frame, bool centers_only);

  /// The extents by index, as in OperandGroups. An entry has a meaning only once it has been
  /// bounded.
  std::span<const Extent> extents() const { return {screen_.get(), groups_.count()}; }

  /// The slabs by index, for extents with inside2 < 0.
  const ScreenSlab* slabs() const { return slabs_.get(); }

  /// Classifies by slabs and k-DOPs in screen space.
  Answers classify(const uint32_t* primitives, uint64_t open, const Box& cell) const override;
  /// Tests members of a group that is bounded. Bounds those that are not outside.
  std::optional<uint64_t> members_outside(const OperandGroups::Members& members, uint32_t first,
                                          uint32_t count, const Box& cell) const override;

 private:
  void narrow_to_members(uint32_t group) const;
  void bound_members(const OperandGroups::Members& members, uint32_t first, uint64_t wanted) const;
  void bound(std::span<const uint32_t> indices) const;

  /// The state of a group. kBusy: some thread is writing the bounds of its members.
  enum State : uint8_t { kFree, kBusy };
  std::span<const CanonicalPrimitive> primitives_;
  const OperandGroups& groups_;
  const FrameRays& frame_;
  const ScreenOptions options_;
  std::unique_ptr<Extent[]> screen_;
  std::unique_ptr<ScreenSlab[]> slabs_;              // by index, for inside2 < 0
  std::unique_ptr<ScreenKDop[]> corners_;            // by index, for large primitives
  std::unique_ptr<std::atomic<uint8_t>[]> states_;   // by group
  std::unique_ptr<std::atomic<uint8_t>[]> bounded_;  // by index: whether screen_ has it
  /// The rectangles of the members of visible groups (SoA bounds): by group, low x of all members,
  /// then high x, low y and high y.
  std::unique_ptr<float[]> rectangles_;
};

}  // namespace csgcore
