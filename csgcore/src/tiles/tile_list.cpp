#include "tiles/tile_list.hpp"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>

#include "primitives/intersect.hpp"
#include "screen/screen_extents.hpp"

namespace csgcore {
namespace {

/// Only the occluders with the longest stretches are tried: each costs a few passes over the list,
/// and the first one mostly settles it.
constexpr size_t kMostCovers = 3;

/// Lists without groups that are no longer than this are not searched for primitives that decide
/// nothing: few have any.
constexpr uint32_t kUndecisiveList = 64;

/// A stretch is shortened at each end by this share of its depths and of its own length, which is
/// far above the rounding of an intersection.
constexpr double kCoverSlack = 1e-9;

/// A stretch is divided into so many parts in the search for a free depth.
constexpr size_t kDepthParts = 64;

/// No more groups than this are expanded to find one.
constexpr int64_t kMostInTheWay = 16;

bool meets(const Extent& screen, double from_t, double to_t) {
  return nearest_t(screen) <= to_t && furthest_t(screen) >= from_t;
}

/// Returns whether the extent is larger than the tile on the screen.
bool covers_more_than(const Extent& screen, const Tile& tile) {
  return 2 * screen.half[0] > tile.width && 2 * screen.half[1] > tile.height;
}

bool lies_within(const Extent& screen, double from_t, double to_t) {
  return nearest_t(screen) > from_t && furthest_t(screen) < to_t;
}

}  // namespace

PacketLaterals laterals_of_corners(const FrameRays& frame, const Box& box) {
  PacketLaterals corners{};
  for (uint32_t lane = 0; lane < 4; ++lane) {
    corners.u[lane] = frame.u((lane & 1) ? box.max.x : box.min.x);
    corners.v[lane] = frame.v((lane & 2) ? box.max.y : box.min.y);
  }
  return corners;
}

TileCuller::Outcome TileCuller::cull(const Tile& tile, const CellList& list, Restrictor& restrictor,
                                     CellList& result) {
  if (!find_covers(tile, list)) return Outcome::kNothing;
  dropped_.assign(list.count(), Decision::kOpen);
  marked_.clear();
  bool cuts = false;
  for (const Cover& cover : covers_) {
    if (!parameters_.last_value) break;
    const std::optional<double> depth = free_depth(list, cover.from_t, cover.to_t);
    cuts = depth && all_end_before(list, restrictor, *depth) && drop_behind(list, *depth);
    if (!cuts) continue;
    cut_t_ = *depth;
    break;
  }
  if (!cuts && !marked_.empty()) return Outcome::kOpenGroups;
  if (!cuts && (has_groups_ || list.count() > kUndecisiveList)) {
    for (const Cover& cover : covers_) drop_undecisive(list, restrictor, cover);
  }
  if (std::find(dropped_.begin(), dropped_.end(), Decision::kOutside) == dropped_.end()) {
    return Outcome::kNothing;
  }
  restrictor.restrict(list, dropped_, result);
  return cuts ? Outcome::kCut : Outcome::kSimplified;
}

double TileCuller::slack_of(const Cover& cover) {
  return kCoverSlack *
         (std::abs(cover.from_t) + std::abs(cover.to_t) + (cover.to_t - cover.from_t));
}

/// Finds the occluders, the longest ones first. Returns whether there are any.
bool TileCuller::find_covers(const Tile& tile, const CellList& list) {
  const Box box = box_of(tile, parameters_.centers_only);
  covers_.clear();
  has_groups_ = is_partly_covered_ = false;
  for (const uint32_t entry : list.primitives()) {
    const uint32_t primitive = entry & kPrimitiveBits;
    if (parameters_.groups->is_group(primitive)) {
      has_groups_ = true;
      continue;
    }
    const Extent& e = parameters_.screen[primitive];
    if (!covers(e, box)) {
      is_partly_covered_ |= covers_more_than(e, tile);
      continue;
    }
    if (!parameters_.primitives[primitive].is_convex) continue;
    covers_.push_back({primitive, nearest_t(e), furthest_t(e)});
  }
  if (covers_.empty()) return false;
  const size_t candidates = covers_.size();
  const auto longer = [](const Cover& a, const Cover& b) {
    const double lengths[] = {a.to_t - a.from_t, b.to_t - b.from_t};
    return lengths[0] != lengths[1] ? lengths[0] > lengths[1] : a.primitive < b.primitive;
  };
  const size_t kept = std::min(covers_.size(), kMostCovers);
  std::partial_sort(covers_.begin(), covers_.begin() + static_cast<long>(kept), covers_.end(),
                    longer);
  covers_.resize(kept);
  RayPacket rays;
  make_four_rays(*parameters_.frame, laterals_of_corners(*parameters_.frame, box), rays);
  for (Cover& cover : covers_) {
    PacketSegments segments;
    intersect_four(*parameters_.frame, rays, parameters_.primitives[cover.primitive], segments);
    const double from = *std::max_element(segments.start, segments.start + 4);
    const double to = *std::min_element(segments.end, segments.end + 4);
    const double slack = slack_of({cover.primitive, from, to});
    const double least = parameters_.cover_share * (cover.to_t - cover.from_t);
    cover.from_t = std::max(from, parameters_.frame->first_t) + slack;
    cover.to_t = to - slack;
    if (!(cover.to_t - cover.from_t > least)) cover.to_t = cover.from_t;
  }
  std::erase_if(covers_, [](const Cover& c) { return !(c.from_t < c.to_t); });
  is_partly_covered_ = covers_.empty() && (is_partly_covered_ || candidates > 0);
  return !covers_.empty();
}

/// Sets decisions_ to what is certain about each primitive between two depths.
void TileCuller::decide_within(const CellList& list, double from_t, double to_t) {
  decisions_.resize(list.count());
  for (uint32_t i = 0; i < list.count(); ++i) {
    const uint32_t primitive = list.primitive[i] & kPrimitiveBits;
    const bool is_apart =
        dropped_[i] == Decision::kOutside || !meets(parameters_.screen[primitive], from_t, to_t);
    decisions_[i] = is_apart ? Decision::kOutside : Decision::kOpen;
    for (const Cover& cover : covers_) {
      if (cover.primitive == primitive && cover.from_t <= from_t && to_t <= cover.to_t) {
        decisions_[i] = Decision::kInside;
      }
    }
  }
}

void TileCuller::drop_undecisive(const CellList& list, Restrictor& restrictor, const Cover& cover) {
  decide_within(list, cover.from_t, cover.to_t);
  const auto count = static_cast<long>(list.count());
  indices_.primitive.resize(list.count());
  std::iota(indices_.primitive.begin(), indices_.primitive.end(), 0u);
  indices_.if_inside.assign(list.if_inside.begin(), list.if_inside.begin() + count);
  indices_.if_outside.assign(list.if_outside.begin(), list.if_outside.begin() + count);
  indices_.root = list.root;
  restrictor.restrict(indices_, decisions_, probe_);
  decides_.assign(list.count(), 0);
  for (const uint32_t index : probe_.primitives()) decides_[index] = 1;
  for (uint32_t i = 0; i < list.count(); ++i) {
    const uint32_t primitive = list.primitive[i] & kPrimitiveBits;
    if (dropped_[i] == Decision::kOutside || decides_[i] ||
        !lies_within(parameters_.screen[primitive], cover.from_t, cover.to_t)) {
      continue;
    }
    dropped_[i] = Decision::kOutside;
  }
}

bool TileCuller::covers_at(uint32_t primitive, double from_t, double to_t) const {
  return std::any_of(covers_.begin(), covers_.end(), [&](const Cover& c) {
    return c.primitive == primitive && c.from_t <= from_t && to_t <= c.to_t;
  });
}

/// Returns a free depth within the stretch: one that no primitive of the list, except occluders,
/// reaches. It is in the first of kDepthParts parts of equal length that has one. If groups alone
/// stand in the way, marks those in the part with the fewest to be expanded, unless some are marked
/// already.
std::optional<double> TileCuller::free_depth(const CellList& list, double from_t, double to_t) {
  const double scale = kDepthParts / (to_t - from_t);
  struct Parts {
    size_t first, last;
  };
  const auto parts_of = [&](const Extent& e) {
    return Parts{
        static_cast<size_t>(std::max((nearest_t(e) - from_t) * scale, 0.0)),
        static_cast<size_t>(std::min((furthest_t(e) - from_t) * scale, kDepthParts - 1.0))};
  };
  // The number of primitives and groups that reach into a part changes by these; a primitive counts
  // more than all groups.
  constexpr int64_t kPrimitive = int64_t{1} << 32;
  std::array<int64_t, kDepthParts + 1> changes{};
  for (uint32_t i = 0; i < list.count(); ++i) {
    const uint32_t index = list.primitive[i] & kPrimitiveBits;
    const Extent& e = parameters_.screen[index];
    if (!meets(e, from_t, to_t) || covers_at(index, from_t, to_t)) continue;
    const auto [first, last] = parts_of(e);
    const int64_t weight = parameters_.groups->is_group(index) ? 1 : kPrimitive;
    changes[first] += weight;
    changes[last + 1] -= weight;
  }
  int64_t reaching = 0;
  int64_t fewest = kMostInTheWay + 1;
  size_t best = 0;
  for (size_t part = 0; part < kDepthParts; ++part) {
    reaching += changes[part];
    if (reaching == 0) return from_t + (part + 0.5) / scale;
    if (reaching < fewest) fewest = reaching, best = part;
  }
  if (fewest > kMostInTheWay || !marked_.empty()) return std::nullopt;
  marked_.assign(list.count(), 0);
  for (uint32_t i = 0; i < list.count(); ++i) {
    const uint32_t index = list.primitive[i] & kPrimitiveBits;
    if (!parameters_.groups->is_group(index) || !meets(parameters_.screen[index], from_t, to_t))
      continue;
    const auto [first, last] = parts_of(parameters_.screen[index]);
    marked_[i] = first <= best && best <= last;
  }
  return std::nullopt;
}

/// Returns whether all rays end before the depth, by the occluders that contain the tile there.
bool TileCuller::all_end_before(const CellList& list, Restrictor& restrictor, double depth) {
  decide_within(list, depth, depth);
  restrictor.restrict(list, decisions_, probe_);
  return probe_.root == (*parameters_.last_value ? CellList::kTrue : CellList::kFalse);
}

/// Drops primitives behind the depth. Returns whether there are any.
bool TileCuller::drop_behind(const CellList& list, double depth) {
  bool drops = false;
  for (uint32_t i = 0; i < list.count(); ++i) {
    const Extent& extent = parameters_.screen[list.primitive[i] & kPrimitiveBits];
    if (dropped_[i] == Decision::kOutside || nearest_t(extent) <= depth) continue;
    dropped_[i] = Decision::kOutside;
    drops = true;
  }
  return drops;
}

}  // namespace csgcore
