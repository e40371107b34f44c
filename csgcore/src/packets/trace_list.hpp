// The input of tracing a packet, its working memory, and its result.
#pragma once

#include <cstdint>
#include <stop_token>
#include <vector>

#include "csgcore/canonical_primitive.hpp"
#include "csgcore/image.hpp"
#include "packets/segment_lists.hpp"
#include "primitives/crossings.hpp"
#include "rays/ray_packet.hpp"
#include "tree/cell_list.hpp"
#include "tree/list_expression.hpp"

namespace csgcore {

/// The list to be traced, with facts about its tests that save work.
struct TraceList {
  const CanonicalPrimitive* primitives = nullptr;
  const CellList* list = nullptr;
  /// By index in the list: a lower bound of t at the primitive's crossings.
  const double* nearest_t = nullptr;
  double earliest_t = 0;  // the least of them
  /// By index in the list: the lanes that may meet the primitive. Null: all may.
  const LaneMask* reached = nullptr;
};

/// The parameters of the definition of a picture (NUMERICS.md), for all lists of a frame.
struct TraceParameters {
  double thickness_tolerance = 0;
  Boundary boundary = Boundary::kFirst;
  std::stop_token stop{};
};

/// By lane, the state of an operand at a coincidence (`turning` in list_expression.hpp).
struct alignas(64) PacketStates {
  int32_t lane[kPacketRays];
};

/// The working memory of one thread, for all packets that it traces.
struct PacketWorkspace {
  // By index in the list:
  std::vector<PacketSegments> segments;
  std::vector<LaneMask> computed;         // lanes whose segments are known
  std::vector<LaneMask> reached;          // TraceList::reached
  std::vector<LaneMask> apart;            // lanes known to be separated from the primitive
  std::vector<LaneMask> program_counter;  // by a test's number: the lanes whose program counter it
                                          // is (ListSegments::program_counter)
  SegmentStore segment_store;  // of primitives that are not convex; must be cleared before
                               // other rays are traced
  uint64_t rays = 0;           // those traced along their whole length
  uint64_t intersections = 0;  // of rays with primitives
  uint64_t resolved_rays = 0;

  // For coincidences:
  ListExpression expression;
  std::vector<PacketStates> states;  // a stack
  // For RayResolver:
  struct Event {
    double t;
    uint32_t index;  // in the list
    bool at_end;
    bool on_cap;  // see PacketSegments
  };
  std::vector<Event> events, changed;
  std::vector<uint8_t> inside;  // by index in the list
  std::vector<uint32_t> repeats, order;
  std::vector<uint8_t> is_first;
  std::vector<uint8_t> has_changed;  // by index in the list
  std::vector<int32_t> operands;     // a stack
};

/// The hits of a packet. Only the entries of lanes in `hits` have a meaning.
struct alignas(64) PacketHits {
  LaneMask hits = 0;
  /// Lanes whose hit the range alone cannot decide; none unless trace_packet_in_range() traced
  /// them.
  LaneMask undecided = 0;
  LaneMask on_cap = 0;      // the `on_cap` with which the hit's normal is found (primitive-inl.hpp)
  LaneMask eye_inside = 0;  // of all traced lanes, those whose eye lies in the solid
  alignas(64) double t[kPacketRays];
  double normal[3][kPacketRays];  // unit, outward of the solid
  uint32_t index[kPacketRays];    // of the test in the list
};

inline bool is_complement(const TraceList& list, uint32_t index) {
  return (list.list->primitive[index] & CellList::kComplementBit) != 0;
}

}  // namespace csgcore
