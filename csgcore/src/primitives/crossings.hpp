// What packets of rays meet of a primitive: the crossings with its surface if it is not convex, and
// the segment within it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "rays/ray_packet.hpp"

namespace csgcore {

/// A place where a ray passes a face.
struct Crossing {
  double t = -std::numeric_limits<double>::infinity();
  uint32_t face = 0;
  int32_t turn = 0;  // by how much the winding number grows there

  friend bool operator<(const Crossing& a, const Crossing& b) {
    return a.t != b.t ? a.t < b.t : a.face < b.face;
  }
};

/// Puts crossings in order. Most rays have a few, which std::sort would take several times as long
/// for.
inline void sort(std::vector<Crossing>& crossings) {
  constexpr size_t kFew = 16;
  if (crossings.size() > kFew) return std::sort(crossings.begin(), crossings.end());
  for (size_t i = 1; i < crossings.size(); ++i) {
    const Crossing crossing = crossings[i];
    size_t at = i;
    for (; at > 0 && crossing < crossings[at - 1]; --at) crossings[at] = crossings[at - 1];
    crossings[at] = crossing;
  }
}

/// A search for the next crossings of a packet's rays.
struct CrossingSearch {
  struct Lane {
    Crossing after;               // only later crossings are wanted
    std::vector<Crossing> found;  // in the end they are in order
  };
  Lane lanes[kPacketRays];
  /// A part of a hierarchy of faces that lanes have yet to pass.
  struct Visit {
    uint32_t node;
    LaneMask lanes;
  };
  std::vector<Visit> stack;  // working memory
  /// So many crossings of each lane are wanted, and those with the same t as the last of them.
  size_t most = 0;
  static constexpr size_t kAll = std::numeric_limits<size_t>::max();

  /// Adds a crossing of the lane if it is wanted. Returns the t beyond which no more are. If all
  /// are wanted, they get their order at the end only.
  double add(uint32_t lane_index, const Crossing& crossing) {
    constexpr double kEndless = std::numeric_limits<double>::infinity();
    Lane& lane = lanes[lane_index];
    std::vector<Crossing>& found = lane.found;
    if (lane.after < crossing) {
      if (most == kAll) {
        found.push_back(crossing);
      } else if (found.size() < most || crossing.t <= found[most - 1].t) {
        found.insert(std::upper_bound(found.begin(), found.end(), crossing), crossing);
        while (found.size() > most && found.back().t > found[most - 1].t) found.pop_back();
      }
    }
    return found.size() < most ? kEndless : found[most - 1].t;
  }
};

/// The parameters t at which the rays enter and leave a primitive: start < end, or +∞ and −∞ for a
/// ray that misses it. The masks are needed to find the normals at the ends: for a frustum they say
/// whether the end lies on a cap, for a polyhedron whether the ray leaves there.
struct alignas(64) PacketSegments {
  double start[kPacketRays];
  double end[kPacketRays];
  LaneMask start_on_cap = 0;
  LaneMask end_on_cap = 0;
  /// The lanes that may meet the primitive again behind `end`. It has a meaning only if the
  /// primitive is not convex.
  LaneMask more = 0;
};

}  // namespace csgcore
