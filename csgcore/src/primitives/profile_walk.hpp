// The walk of a packet of rays through the BVH of a profile, which extrusions and revolutions
// share.
#pragma once

#include <vector>

#include "csgcore/profile.hpp"
#include "primitives/crossings.hpp"

namespace csgcore {

/// Calls cross(node, lanes) with each leaf and the lanes that may cross its pieces. pass(node,
/// lanes) returns those of the lanes for which pieces below the node count. `stack` is working
/// memory.
template <typename Pass, typename Cross>
void walk_profile(const Profile& profile, LaneMask lanes, std::vector<CrossingSearch::Visit>& stack,
                  const Pass& pass, const Cross& cross) {
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
    cross(node, through);
  }
}

}  // namespace csgcore
