#include "primitives/profile_line.hpp"

namespace csgcore {

int winding_at(const Profile& profile, const ProfileLine& line, double at) {
  if (profile.nodes().empty()) return 0;
  const Vec2& e = line.direction;
  int winding = 0;
  std::vector<uint32_t> open{0};
  while (!open.empty()) {
    const Profile::Node& node = profile.nodes()[open.back()];
    open.pop_back();
    const Vec2 min{node.min[0], node.min[1]}, max{node.max[0], node.max[1]};
    const Vec2 center = 0.5 * (min + max), half = 0.5 * (max - min);
    if (std::abs(line.height(center)) > std::abs(e.x) * half.y + std::abs(e.y) * half.x) continue;
    if (line.along(center) - (std::abs(e.x) * half.x + std::abs(e.y) * half.y) >= at) continue;
    if (node.children != 0) {
      open.push_back(node.children);
      open.push_back(node.children + 1);
      continue;
    }
    for (uint32_t i = node.begin; i < node.end; ++i) {
      for_each_crossing(line, profile.pieces()[i],
                        [&](double along, int turn) { winding += along < at ? turn : 0; });
    }
  }
  return winding;
}

bool Profile::contains(const Vec2& point) const {
  // Only what lies further right counts, so that the y axis may bound the figure.
  return is_inside(winding_at(*this, {{-1, 0}, -point.y}, -point.x));
}

}  // namespace csgcore
