// The segments of a packet's rays within a primitive that is not convex, as far as they are known.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "primitives/crossings.hpp"

namespace csgcore {

/// A part of a ray within a primitive, and the faces at its ends: start < end.
struct RaySegment {
  double start, end;
  uint32_t start_face, end_face;
};

/// The segments of one ray, in order along its whole line. They are found from the front, a few at
/// a time.
class SegmentList {
 public:
  std::span<const RaySegment> segments() const { return segments_; }
  /// Returns whether there are no more segments.
  bool is_complete() const { return is_complete_; }
  /// The crossings behind this one are not known yet.
  const Crossing& last() const { return last_; }
  /// Returns the number of segments that have ended at t. `from`: so many are known to have.
  size_t ended_at(double t, size_t from = 0) const {
    while (from < segments_.size() && segments_[from].end <= t) ++from;
    return from;
  }

  void clear();
  /// Takes the next crossings, in order. `are_last`: there are no more.
  void take(std::span<const Crossing> crossings, bool are_last);
  /// Makes a segment of each crossing instead. `length_of(crossing)` returns its length in t.
  template <typename LengthOf>
  void take_sheets(std::span<const Crossing> crossings, const LengthOf& length_of) {
    for (const Crossing& crossing : crossings) {
      add(crossing.t, crossing.t + length_of(crossing), crossing.face, crossing.face);
    }
    is_complete_ = true;
  }

 private:
  /// Takes numbers, since a segment that was just written, number by number, is slow to copy.
  void add(double start, double end, uint32_t start_face, uint32_t end_face);

  std::vector<RaySegment> segments_;
  // The start of the segment that the last crossing lies in has these, if the winding is not 0.
  double start_ = 0;
  uint32_t start_face_ = 0;
  Crossing last_;
  int winding_ = 0;
  bool is_complete_ = false;
};

/// The lists of a packet's rays.
struct PacketSegmentLists {
  SegmentList lanes[kPacketRays];
  LaneMask begun = 0;  // lanes whose lists have been asked for
  size_t most = 0;     // crossings of a lane that the last search looked for

  void clear();
};

/// The lists of all primitives that a packet has met.
class SegmentStore {
 public:
  /// Must be called before other rays are traced.
  void clear() {
    if (used_ > 0) clear_used();
  }
  PacketSegmentLists& lists_of(uint32_t primitive);

  CrossingSearch search;  // working memory

 private:
  static constexpr uint32_t kNone = 0xFFFFFFFFu;
  void clear_used();

  std::vector<std::unique_ptr<PacketSegmentLists>> lists_;
  std::vector<uint32_t> primitives_;  // by list: the primitive that it belongs to
  std::vector<uint32_t> place_;       // by primitive: the list's index, or kNone
  size_t used_ = 0;
};

}  // namespace csgcore
