#include "drawings/dxf_chains.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>

namespace frontend {
namespace {

constexpr double kCellsPerUnit = 1024;

double cross(const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; }

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

uint32_t DxfChains::point_at(const Vec2& place) {
  const Cell cell(std::llround(place.x * kCellsPerUnit), std::llround(place.y * kCellsPerUnit));
  uint32_t found = static_cast<uint32_t>(points_.size());
  int64_t nearest = 3;
  for (int64_t dx = -1; dx <= 1; ++dx) {
    for (int64_t dy = -1; dy <= 1; ++dy) {
      const auto entry = cells_.find({cell.first + dx, cell.second + dy});
      if (entry == cells_.end() || dx * dx + dy * dy >= nearest) continue;
      nearest = dx * dx + dy * dy;
      found = entry->second;
    }
  }
  if (found < points_.size()) return found;
  cells_.emplace(cell, found);
  points_.push_back({Vec2(static_cast<double>(cell.first) / kCellsPerUnit,
                          static_cast<double>(cell.second) / kCellsPerUnit)});
  return found;
}

void DxfChains::add(const DxfStroke& stroke) {
  const uint32_t start = point_at(stroke.start);
  const uint32_t end = point_at(stroke.end);
  if (start == end) return;
  const auto index = static_cast<uint32_t>(links_.size());
  links_.push_back({{start, end}, kNoArc});
  if (stroke.arc) {
    links_.back().arc = static_cast<uint32_t>(arcs_.size());
    const PlaneMap map =
        map_of_points(stroke.start, stroke.end, points_[start].place, points_[end].place);
    arcs_.push_back(mapped(map, *stroke.arc));
  }
  for (const uint32_t point : {start, end}) {
    points_[point].links.push_back(index);
    ++points_[point].free;
  }
}

/// Notes which stroke becomes the only one at a point.
void DxfChains::use(uint32_t link) {
  links_[link].is_used = true;
  for (const uint32_t end : links_[link].ends) {
    if (--points_[end].free != 1) continue;
    maybe_open_.push_back(*next_link(end));
    std::push_heap(maybe_open_.begin(), maybe_open_.end(), std::greater<>());
  }
}

/// Returns the first stroke at the point that is not used.
std::optional<uint32_t> DxfChains::next_link(uint32_t point) {
  Point& at = points_[point];
  while (at.first_free < at.links.size() && links_[at.links[at.first_free]].is_used) {
    ++at.first_free;
  }
  if (at.first_free == at.links.size()) return std::nullopt;
  return at.links[at.first_free];
}

DxfChains::Chain DxfChains::walk(uint32_t link, uint32_t from) {
  Chain chain{{from, link}};
  for (std::optional<uint32_t> next = link; next; next = next_link(chain.back().point)) {
    const std::array<uint32_t, 2>& ends = links_[*next].ends;
    const uint32_t to = ends[0] == chain.back().point ? ends[1] : ends[0];
    use(*next);
    chain.push_back({to, *next});
  }
  return chain;
}

/// Returns the first stroke of the file at one of whose ends there is no other.
std::optional<uint32_t> DxfChains::open_link() {
  while (!maybe_open_.empty()) {
    const uint32_t link = maybe_open_.front();
    std::pop_heap(maybe_open_.begin(), maybe_open_.end(), std::greater<>());
    maybe_open_.pop_back();
    if (!links_[link].is_used) return link;
  }
  return std::nullopt;
}

/// Looks at the leftmost point, as if the chain ended where it begins.
bool DxfChains::turns_counterclockwise(const Chain& chain) const {
  const size_t last = chain.size() - 1;
  const auto place = [&](size_t i) { return points_[chain[i].point].place; };
  size_t leftmost = 0;
  for (size_t i = 1; i <= last; ++i) {
    if (place(i).x < place(leftmost).x) leftmost = i;
  }
  const Vec2 before = place(leftmost) - place(leftmost == 0 ? last - 1 : leftmost - 1);
  const Vec2 after = place(leftmost == last ? 1 : leftmost + 1) - place(leftmost);
  return cross(before, after) > 0 || before == Vec2(0.0);
}

void DxfChains::add_step(const Step& from, const Step& to, uint32_t link, CurvePath& path) const {
  const Vec2& end = points_[to.point].place;
  if (links_[link].arc == kNoArc) return path.line_to(end);
  const EllipseArc& arc = arcs_[links_[link].arc];
  const bool is_forward = links_[link].ends[0] == from.point;
  path.arc_to(is_forward ? arc : reversed(arc), 1, end);
}

CurvePath DxfChains::path_of(const Chain& chain) const {
  CurvePath path(points_[chain.front().point].place);
  for (size_t i = 1; i < chain.size(); ++i) add_step(chain[i - 1], chain[i], chain[i].link, path);
  return path;
}

std::vector<CurvePath> DxfChains::join() {
  std::vector<CurvePath> paths;
  for (uint32_t link = 0; link < links_.size(); ++link) {
    const auto& ends = links_[link].ends;
    if (points_[ends[0]].free == 1 || points_[ends[1]].free == 1) maybe_open_.push_back(link);
  }
  std::make_heap(maybe_open_.begin(), maybe_open_.end(), std::greater<>());
  while (const std::optional<uint32_t> link = open_link()) {
    const auto& ends = links_[*link].ends;
    paths.push_back(path_of(walk(*link, points_[ends[0]].free == 1 ? ends[0] : ends[1])));
  }
  for (uint32_t link = 0; link < links_.size(); ++link) {
    if (links_[link].is_used) continue;
    Chain chain = walk(link, links_[link].ends[0]);
    if (chain.front().point != chain.back().point) {
      if (turns_counterclockwise(chain)) {
        chain.pop_back();
      } else {
        chain.erase(chain.begin());
      }
    }
    if (chain.size() > 1) paths.push_back(path_of(chain));
  }
  return paths;
}

}  // namespace frontend
