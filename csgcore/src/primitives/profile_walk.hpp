// The walk of a packet of rays through the BVH of a profile, which extrusions and revolutions
// share.
#pragma once

#include <vector>

#include "csgcore/profile.hpp"
#include "primitives/crossings.hpp"

namespace csgcore {

/// Calls cross(lane, piece, i) with each lane and the i-th piece of the profile that may cross.
/// pass(node, lanes) returns those of the lanes for which pieces below the node count, and
/// across(piece, lanes) those that may cross the piece. `stack` is working memory.
template <typename Pass, typename Across, typename Cross>
void walk_profile(const Profile& profile, LaneMask lanes, std::vector<CrossingSearch::Visit>& stack,
                  const Pass& pass, const Across& across, const Cross& cross) {
  stack.assign(1, {0, lanes});
  while (!stack.empty()) {
    const CrossingSearch::Visit visit = stack.back();
    stack.pop_back();
    const Profile::Node& node = profile.nodes()[visit.node];
    const LaneMask through = pass(node, visit.lanes);
    if (through == 0) continue;
    if (node.children != 0) {
      stack.push_back({node.children + 1, through});
      stack.push_back({node.children, through});
      continue;
    }
    for (uint32_t i = node.begin; i < node.end; ++i) {
      const Profile::Piece& piece = profile.pieces()[i];
      for_each_lane(across(piece, through), [&](uint32_t lane) { cross(lane, piece, i); });
    }
  }
}

}  // namespace csgcore
