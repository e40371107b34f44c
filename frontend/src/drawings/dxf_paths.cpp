#include "drawings/dxf_paths.hpp"

#include <glm/geometric.hpp>

namespace frontend {
namespace {

/// The similar map that takes two points to two others; the first two differ.
PlaneMap map_of_points(const Vec2& a, const Vec2& b, const Vec2& to_a, const Vec2& to_b) {
  const Vec2 from = b - a;
  const Vec2 to = to_b - to_a;
  const double size = glm::dot(from, from);
  const double c = glm::dot(from, to) / size;
  const double s = cross(from, to) / size;
  PlaneMap map;
  map.linear = glm::dmat2(c, s, -s, c);
  map.translation = to_a - map.linear * a;
  return map;
}

}  // namespace

void DxfPaths::add(const DxfStroke& stroke) {
  const uint32_t link = chains_.add(dxf_point(stroke.start), dxf_point(stroke.end));
  const auto& [start, end] = chains_.ends(link);
  arcs_.emplace_back();
  if (!stroke.arc || start == end) return;
  const PlaneMap map = map_of_points(stroke.start, stroke.end, place(start), place(end));
  arcs_.back() = mapped(map, *stroke.arc);
}

void DxfPaths::add_step(const Step& from, const Step& to, CurvePath& path) const {
  if (from.point == to.point) return;
  const Vec2 end = place(to.point);
  const std::optional<EllipseArc>& arc = arcs_[to.link];
  if (!arc) return path.line_to(end);
  const bool is_forward = chains_.ends(to.link)[0] == from.point;
  path.arc_to(is_forward ? *arc : reversed(*arc), 1, end);
}

std::vector<CurvePath> DxfPaths::join() {
  std::vector<CurvePath> paths;
  for (const language::DxfChains::Chain& chain : chains_.join()) {
    CurvePath& path = paths.emplace_back(place(chain.front().point));
    for (size_t i = 1; i < chain.size(); ++i) add_step(chain[i - 1], chain[i], path);
  }
  return paths;
}

}  // namespace frontend
