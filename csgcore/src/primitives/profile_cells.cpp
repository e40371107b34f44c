#include "primitives/profile_cells.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <vector>

namespace csgcore {
namespace {

bool meets(const Profile::Node& node, const Rectangle& rectangle) {
  return node.min[0] <= rectangle.max.x && node.max[0] >= rectangle.min.x &&
         node.min[1] <= rectangle.max.y && node.max[1] >= rectangle.min.y;
}

/// Returns false only if the piece certainly misses the rectangle. Rounding may be of any sign: the
/// rectangle is larger than its cell by far more.
bool may_meet(const Profile::Piece& piece, const Rectangle& rectangle) {
  const Vec2 low = glm::min(piece.start, piece.end), high = glm::max(piece.start, piece.end);
  if (low.x > rectangle.max.x || high.x < rectangle.min.x || low.y > rectangle.max.y ||
      high.y < rectangle.min.y) {
    return false;
  }
  // The piece lies between its chord and the parallel through its control point.
  const Vec2 chord = piece.end - piece.start;
  const Vec2 across{chord.y, -chord.x};
  const double bulge = piece.is_line() ? 0 : glm::dot(across, piece.control - piece.start);
  // One side of the rectangle may be far larger than the other, and than its middle can tell.
  const Vec2 a = across * (rectangle.min - piece.start), b = across * (rectangle.max - piece.start);
  const Vec2 lowest = glm::min(a, b), highest = glm::max(a, b);
  return highest.x + highest.y >= std::min(0.0, bulge) &&
         lowest.x + lowest.y <= std::max(0.0, bulge);
}

}  // namespace

Classification classify(const Profile& profile, const Rectangle& rectangle, const Vec2& point,
                        double leftmost) {
  std::vector<uint32_t> open{0};
  while (!open.empty()) {
    const Profile::Node& node = profile.nodes()[open.back()];
    open.pop_back();
    if (!meets(node, rectangle)) continue;
    if (node.children != 0) {
      open.push_back(node.children);
      open.push_back(node.children + 1);
      continue;
    }
    for (uint32_t i = node.begin; i < node.end; ++i) {
      const Profile::Piece& piece = profile.pieces()[i];
      if (piece.start.x <= leftmost && piece.end.x <= leftmost) continue;
      if (may_meet(piece, rectangle)) return Classification::kCrosses;
    }
  }
  return profile.contains(point) ? Classification::kInside : Classification::kOutside;
}

}  // namespace csgcore
