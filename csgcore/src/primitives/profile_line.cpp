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

Vec2 piece_normal(const Profile::Piece& piece, const Vec2& point) {
  const auto across = [](const Vec2& v) { return Vec2{v.y, -v.x}; };
  const Vec2 chord = across(piece.end - piece.start);
  if (piece.is_line()) return chord;
  // The areas a, b, c of the triangles that the point makes with two of the three points satisfy
  // b² = 4·weight²·a·c on the curve, whose gradient this is.
  const Vec2 from_start = across(piece.control - piece.start);
  const Vec2 to_end = across(piece.end - piece.control);
  const double a = glm::dot(to_end, point - piece.control);
  const double c = glm::dot(from_start, point - piece.start);
  const double b = glm::dot(chord, point - piece.start);
  const double factor = 2 * piece.weight * piece.weight;
  const Vec2 normal = b * chord - factor * (a * from_start + c * to_end);
  return normal == Vec2(0.0) ? chord : normal;
}

bool Profile::contains(const Vec2& point) const {
  // Only what lies further right counts, so that the y axis may bound the figure.
  return is_inside(winding_at(*this, {{-1, 0}, -point.y}, -point.x));
}

}  // namespace csgcore
