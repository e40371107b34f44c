// What a packet is traced through, and what is found on the way.
#pragma once

#include <cstdint>
#include <stop_token>
#include <vector>

#include "csgcore/canonical_primitive.hpp"
#include "csgcore/hits.hpp"
#include "primitives/packet_segments.hpp"
#include "rays/ray_packet.hpp"
#include "tree/cell_list.hpp"
#include "tree/list_expression.hpp"

namespace csgcore {

/// What is to be traced: a list, and what is known about its tests.
struct TraceList {
  const CanonicalPrimitive* primitives = nullptr;
  const CellList* list = nullptr;
  /// By index in the list: no crossing of the primitive lies at a smaller τ.
  const double* nearest_t = nullptr;
  double earliest_t = 0;  // the least of them
  /// By index in the list: the lanes that may meet the primitive. None: nobody knows.
  const LaneMask* reached = nullptr;
};

/// What the solid is, beyond its list.
struct TraceParameters {
  double thickness_tolerance = 0;
  Boundary boundary = Boundary::kFirst;
  std::stop_token stop{};
};

/// By lane, what becomes of an operand at crossings that coincide: see list_expression.hpp.
struct alignas(64) PacketStates {
  int32_t lane[kPacketRays];
};

/// Working memory of one thread, for packets of one list after the other.
struct PacketWorkspace {
  // By index in the list:
  std::vector<PacketSegments> segments;
  std::vector<LaneMask> computed;         // lanes whose segments are known
  std::vector<LaneMask> reached;          // TraceList::reached
  std::vector<LaneMask> apart;            // lanes that stand away from it
  std::vector<LaneMask> program_counter;  // of an evaluation, by a test's number
  std::vector<uint8_t> was_computed;      // for any packet of the list; empty: nobody wants to know
  uint64_t rays = 0;                      // traced along their whole length
  uint64_t intersections = 0;             // of rays with primitives
  uint64_t resolved_rays = 0;

  // What coincident crossings are told with:
  ListExpression expression;
  std::vector<PacketStates> states;  // a stack
  // The resolver's.
  struct Event {
    double t;
    uint32_t index;  // in the list
    bool at_end;
  };
  std::vector<Event> events, changed;
  std::vector<uint8_t> inside;  // by index in the list
  std::vector<uint32_t> repeats, order;
  std::vector<uint8_t> is_first;
  std::vector<uint8_t> has_changed;  // by index in the list
  std::vector<int32_t> operands;     // a stack
};

/// Per lane. Only lanes of `hits` hold anything.
struct alignas(64) PacketHits {
  LaneMask hits = 0;
  /// Lanes whose hit the range alone cannot decide; only from trace_packet_in_range.
  LaneMask undecided = 0;
  LaneMask on_cap = 0;      // the hit is on a flat face
  LaneMask eye_inside = 0;  // of all lanes that were traced: the solid holds at the eye
  alignas(64) double t[kPacketRays];
  double normal[3][kPacketRays];  // unit, outward of the solid
  uint32_t index[kPacketRays];    // of the test in the list
};

inline bool is_complement(const TraceList& list, uint32_t index) {
  return (list.list->primitive[index] & CellList::kComplementBit) != 0;
}

}  // namespace csgcore
