// TileCuller::cut_by_face: a plane face by which all rays of a tile enter the solid hides what lies
// behind its plane. Depths cannot separate parts that share planes, or plates one behind the other
// that are thinner than the range of a tile's depths; the face's plane can.
#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "base/constants.hpp"
#include "primitives/intersect.hpp"
#include "screen/screen_extents.hpp"
#include "tiles/tile_list.hpp"

namespace csgcore {
namespace {

/// So many primitives that cover the tile are tried for each of its pixels, and kSomeCandidates in
/// any case. One half of them are those whose bounds begin nearest.
constexpr double kMostForAPixel = 0.25;
constexpr size_t kSomeCandidates = 32;

/// In thickness tolerances along the face's normal: the least thickness of the primitive behind its
/// face, so that no crossing beyond it can coincide with one at the face; and the least distance of
/// dropped primitives from the face, for the same reason.
constexpr double kLeastThickness = 16;
constexpr double kLeastDistance = 4;

/// Faces that a ray meets at a smaller cosine are not tried: at it kCoplanar is far less than a
/// tolerance along the ray.
constexpr double kLeastCosine = 0x1p-6;

constexpr uint32_t kCorners = 4;

double latest_of(const double (&t)[kPacketRays]) { return *std::max_element(t, t + kCorners); }

}  // namespace

/// Finds primitives that cover the tile and whose test, if inside, makes the list true.
void TileCuller::find_face_candidates(const CellList& list, const Box& tile, size_t most) {
  face_candidates_.clear();
  for (uint32_t i = 0; i < list.count(); ++i) {
    const uint32_t primitive = list.primitive[i];  // complements have larger numbers than groups
    if (list.if_inside[i] != CellList::kTrue || primitive >= parameters_.groups->first_group())
      continue;
    const Extent& e = parameters_.screen[primitive];
    if (covers(e, tile) && parameters_.primitives[primitive].is_convex)
      face_candidates_.push_back({i, primitive, nearest_t(e)});
  }
  if (face_candidates_.size() <= most) return;
  // Half of them are the nearest. The others are spread evenly over all others, since plates one
  // behind the other may have bounds that begin alike.
  const auto rest = face_candidates_.begin() + static_cast<long>(most / 2);
  std::nth_element(face_candidates_.begin(), rest, face_candidates_.end(),
                   [](const FaceCandidate& a, const FaceCandidate& b) {
                     return a.entry_t != b.entry_t ? a.entry_t < b.entry_t
                                                   : a.primitive > b.primitive;
                   });
  std::sort(rest, face_candidates_.end(), [](const FaceCandidate& a, const FaceCandidate& b) {
    return a.primitive < b.primitive;
  });
  const size_t left = static_cast<size_t>(face_candidates_.end() - rest);
  const size_t wanted = most - most / 2;
  for (size_t i = 0; i < wanted; ++i) {
    rest[static_cast<long>(i)] = rest[static_cast<long>(i * left / wanted)];
  }
  face_candidates_.resize(most);
}

/// Returns the plane by which all four rays enter the primitive, if there is one that they meet
/// squarely enough and behind which the primitive is thick enough.
std::optional<TileCuller::FacePlane> TileCuller::entered_plane(
    const RayPacket& rays, uint32_t primitive, const PacketSegments& segments) const {
  alignas(64) double normals[3][kPacketRays];
  find_entry_normals(*parameters_.frame, rays, parameters_.primitives[primitive], segments,
                     normals);
  const auto lane_of = [](const double(&v)[3][kPacketRays], uint32_t lane) {
    return Vec3{v[0][lane], v[1][lane], v[2][lane]};
  };
  const Vec3 normal = lane_of(normals, 0);
  for (uint32_t lane = 0; lane < kCorners; ++lane) {
    if (lane_of(normals, lane) != normal) return std::nullopt;
    const Vec3 direction = lane_of(rays.direction, lane);
    const double speed = -glm::dot(normal, direction);  // along the normal, per unit of t
    const double length = segments.end[lane] - segments.start[lane];
    if (!(speed >= kLeastCosine * glm::length(direction))) return std::nullopt;
    if (!(speed * length >= kLeastThickness * parameters_.thickness_tolerance)) return std::nullopt;
  }
  const Vec3 point = lane_of(rays.origin, 0) + segments.start[0] * lane_of(rays.direction, 0);
  return FacePlane{normal, glm::dot(normal, point)};
}

/// Returns whether the primitive or group reaches no further than `limit` beyond the plane, along
/// its normal.
bool TileCuller::lies_behind(uint32_t index, const FacePlane& plane, double limit) const {
  const Extent& e = parameters_.groups->extents()[index];
  const Vec3 center{e.center[0], e.center[1], e.center[2]};
  const double height = glm::dot(plane.normal, center - parameters_.frame->pivot) - plane.offset;
  if (height > limit) return false;
  const Vec3 half{e.half[0], e.half[1], e.half[2]};
  if (height + glm::dot(glm::abs(plane.normal), half) <= limit) return true;
  // A box fits a rotated primitive badly.
  if (parameters_.groups->is_group(index)) return false;
  const Vec3 furthest =
      furthest_point(parameters_.primitives[index], plane.normal) - parameters_.frame->pivot;
  return glm::dot(plane.normal, furthest) - plane.offset <= limit;
}

/// Returns whether the list is true wherever the test's primitive holds.
bool TileCuller::is_enough(const CellList& list, uint32_t index, Restrictor& restrictor) {
  decisions_.assign(list.count(), Decision::kOpen);
  decisions_[index] = Decision::kInside;
  restrictor.restrict(list, decisions_, probe_);
  return probe_.root == CellList::kTrue;
}

bool TileCuller::cut_by_face(const Tile& tile, const CellList& list, Restrictor& restrictor,
                             CellList& result) {
  if (parameters_.last_value != true) return false;
  const Box box = box_of(tile, parameters_.centers_only);
  const double pixels = static_cast<double>(tile.width) * tile.height;
  find_face_candidates(list, box,
                       std::max(kSomeCandidates, static_cast<size_t>(kMostForAPixel * pixels)));
  if (face_candidates_.empty()) return false;
  RayPacket rays;
  PacketSegments segments;
  make_four_rays(*parameters_.frame, laterals_of_corners(*parameters_.frame, box), rays);
  for (FaceCandidate& candidate : face_candidates_) {
    intersect_four(*parameters_.frame, rays, parameters_.primitives[candidate.primitive], segments);
    const bool are_met = std::all_of(segments.start, segments.start + kCorners, [&](double start) {
      return start > parameters_.frame->first_t && start < std::numeric_limits<double>::infinity();
    });
    candidate.entry_t =
        are_met ? latest_of(segments.start) : std::numeric_limits<double>::infinity();
  }
  // Take the nearest face; of coincident ones take that of the last primitive, which is shown. The
  // same plane is met at depths that differ by rounding.
  const auto nearest = std::ranges::min_element(face_candidates_, {}, &FaceCandidate::entry_t);
  if (std::isinf(nearest->entry_t)) return false;
  const double together_t = nearest->entry_t + kCoplanar * parameters_.thickness_tolerance;
  FaceCandidate chosen = *nearest;
  for (const FaceCandidate& candidate : face_candidates_) {
    if (candidate.entry_t <= together_t && candidate.primitive > chosen.primitive) {
      chosen = candidate;
    }
  }
  intersect_four(*parameters_.frame, rays, parameters_.primitives[chosen.primitive], segments);
  const std::optional<FacePlane> plane = entered_plane(rays, chosen.primitive, segments);
  if (!plane || !is_enough(list, chosen.index, restrictor)) return false;
  const double in_plane = kCoplanar * parameters_.thickness_tolerance;
  const double behind = -kLeastDistance * parameters_.thickness_tolerance;
  dropped_.assign(list.count(), Decision::kOpen);
  bool drops = false;
  for (uint32_t i = 0; i < list.count(); ++i) {
    const uint32_t index = list.primitive[i] & kPrimitiveBits;
    if (index == chosen.primitive) continue;
    // A primitive that comes earlier in the file is not shown where it lies in the plane.
    const double limit = index < chosen.primitive ? in_plane : behind;
    if (!lies_behind(index, *plane, limit)) continue;
    dropped_[i] = Decision::kOutside;
    drops = true;
  }
  if (!drops) return false;
  restrictor.restrict(list, dropped_, result);
  const double entry_t = latest_of(segments.start);
  cut_t_ = entry_t + slack_of({chosen.primitive, entry_t, latest_of(segments.end)});
  return true;
}

}  // namespace csgcore
