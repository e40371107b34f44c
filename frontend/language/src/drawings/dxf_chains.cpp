#include "language/dxf_chains.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace language {
namespace {

constexpr double kCellsPerUnit = 1024;

double cross(DxfPoint a, DxfPoint b) { return a.x * b.y - a.y * b.x; }

// What does not fit becomes the least integer, as x86 has it.
int64_t cell_of(double coordinate) {
  constexpr double kEnd = 0x1p63;
  const double cells = std::round(coordinate * kCellsPerUnit);
  return cells >= -kEnd && cells < kEnd ? static_cast<int64_t>(cells) : INT64_MIN;
}

// Wraps around at the ends.
int64_t neighbour(int64_t cell, int64_t step) {
  return static_cast<int64_t>(static_cast<uint64_t>(cell) + static_cast<uint64_t>(step));
}

}  // namespace

uint32_t DxfChains::point_at(DxfPoint place) {
  const Cell cell(cell_of(place.x), cell_of(place.y));
  uint32_t found = static_cast<uint32_t>(points_.size());
  int64_t nearest = 3;
  for (int64_t dx = -1; dx <= 1; ++dx) {
    for (int64_t dy = -1; dy <= 1; ++dy) {
      const auto entry = cells_.find({neighbour(cell.first, dx), neighbour(cell.second, dy)});
      if (entry == cells_.end() || dx * dx + dy * dy >= nearest) continue;
      nearest = dx * dx + dy * dy;
      found = entry->second;
    }
  }
  if (found < points_.size()) return found;
  cells_.emplace(cell, found);
  points_.push_back({{static_cast<double>(cell.first) / kCellsPerUnit,
                      static_cast<double>(cell.second) / kCellsPerUnit}});
  return found;
}

uint32_t DxfChains::add(DxfPoint from, DxfPoint to) {
  const uint32_t start = point_at(from);
  const uint32_t end = point_at(to);
  const auto index = static_cast<uint32_t>(links_.size());
  links_.push_back({{start, end}});
  add_at(start, index);
  if (end != start) add_at(end, index);
  return index;
}

void DxfChains::add_at(uint32_t point, uint32_t link) {
  points_[point].links.push_back(link);
  ++points_[point].free;
}

void DxfChains::add_chords(const DxfStroke& stroke) {
  DxfPoint from = stroke.start;
  for (int i = 1; i < stroke.chords; ++i) {
    const DxfPoint to = stroke.arc.point(stroke.arc.start + stroke.arc.sweep * i / stroke.chords);
    add(from, to);
    from = to;
  }
  add(from, stroke.end);
}

/// Notes which link becomes the only one at a point.
void DxfChains::use(uint32_t link) {
  links_[link].is_used = true;
  const auto [start, end] = links_[link].ends;
  leave(start);
  if (end != start) leave(end);
}

void DxfChains::leave(uint32_t point) {
  if (--points_[point].free != 1) return;
  maybe_open_.push_back(*next_link(point));
  std::push_heap(maybe_open_.begin(), maybe_open_.end(), std::greater<>());
}

/// Returns the first link at the point that is not used.
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

/// Returns the first link of the file at one of whose ends there is no other.
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
  const auto at = [&](size_t i) { return place(chain[i].point); };
  size_t leftmost = 0;
  for (size_t i = 1; i <= last; ++i) {
    if (at(i).x < at(leftmost).x) leftmost = i;
  }
  const DxfPoint middle = at(leftmost);
  const DxfPoint from = at(leftmost == 0 ? last - 1 : leftmost - 1);
  const DxfPoint to = at(leftmost == last ? 1 : leftmost + 1);
  const DxfPoint before = {middle.x - from.x, middle.y - from.y};
  return cross(before, {to.x - middle.x, to.y - middle.y}) > 0 || (before.x == 0 && before.y == 0);
}

std::vector<DxfChains::Chain> DxfChains::join() {
  std::vector<Chain> chains;
  for (uint32_t link = 0; link < links_.size(); ++link) {
    const auto& ends = links_[link].ends;
    if (points_[ends[0]].free == 1 || points_[ends[1]].free == 1) maybe_open_.push_back(link);
  }
  std::make_heap(maybe_open_.begin(), maybe_open_.end(), std::greater<>());
  while (const std::optional<uint32_t> link = open_link()) {
    const auto& ends = links_[*link].ends;
    chains.push_back(walk(*link, points_[ends[0]].free == 1 ? ends[0] : ends[1]));
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
    if (chain.size() > 1) chains.push_back(std::move(chain));
  }
  return chains;
}

}  // namespace language
