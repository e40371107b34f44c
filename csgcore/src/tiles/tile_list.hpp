// A tile's list, made smaller by what the tile's rays cannot see.
#pragma once

#include <atomic>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "primitives/packet_segments.hpp"
#include "rays/frame_rays.hpp"
#include "rays/make_rays.hpp"
#include "rays/packet_blocks.hpp"
#include "screen/screen_bounds.hpp"
#include "solid/restriction.hpp"

namespace csgcore {

/// Where a tile's rays go through the screen, at any depth: through its pixels' centres alone, or
/// anywhere in its pixels.
inline Box box_of(const Tile& tile, bool centers_only) {
  constexpr double kAnyDepth = std::numeric_limits<double>::infinity();
  const double border = centers_only ? 0.0 : 0.5;
  const double x = tile.x;
  const double y = tile.y;
  return {{x - border, y - border, -kAnyDepth},
          {x + tile.width - 1 + border, y + tile.height - 1 + border, kAnyDepth}};
}

/// Rays through the corners of such a box, in the first four lanes.
PacketLaterals laterals_of_corners(const FrameRays& frame, const Box& box);

/// Why a primitive was never intersected; the largest that any tile saw counts.
enum class CullReason : uint8_t {
  kUnknown,
  kOffScreen,
  kSubPixel,
  kCancelled,
  kInside,
  kHidden,
  kIntersected
};
/// One entry for each primitive; written by all threads. Empty if nobody wants to know.
class CullReasons {
 public:
  void resize(size_t primitives) { cull_reasons_ = std::vector<uint8_t>(primitives); }
  bool wanted() const { return !cull_reasons_.empty(); }
  void note(uint32_t primitive, CullReason cull_reason) {
    if (!wanted()) return;
    std::atomic_ref<uint8_t> entry(cull_reasons_[primitive]);
    const uint8_t value = static_cast<uint8_t>(cull_reason);
    uint8_t old = entry.load(std::memory_order_relaxed);
    while (old < value && !entry.compare_exchange_weak(old, value, std::memory_order_relaxed)) {
    }
  }
  std::span<const uint8_t> all() const { return cull_reasons_; }

 private:
  std::vector<uint8_t> cull_reasons_;
};

/// Drops, from the list of a tile, primitives that decide nothing there although its rays may meet
/// them. A primitive that holds the tile's whole cross-section over a stretch of depth settles
/// there what the operations make of others:
/// - where the rest of the list then agrees whatever these others do, those that lie wholly within
///   the stretch are cancelled, or lie inside the solid;
/// - where the solid then holds, all that lies behind is hidden.
/// By convexity the four rays through the tile's corners tell the stretch of a primitive.
class TileCuller {
 public:
  /// `last_value`: a ray ends once the solid has that value; none: rays go on.
  /// `cover_share`: a stretch counts if it is longer than this share of its primitive's depth.
  TileCuller(std::span<const CanonicalPrimitive> primitives, const OperandGroups& groups,
             ScreenBounds& bounds, const FrameRays& frame, bool centers_only,
             std::optional<bool> last_value, double cover_share, double thickness_tolerance,
             CullReasons& cull_reasons)
      : primitives_(primitives),
        groups_(groups),
        bounds_(bounds),
        screen_(bounds.extents()),
        frame_(frame),
        centers_only_(centers_only),
        last_value_(last_value),
        cover_share_(cover_share),
        thickness_tolerance_(thickness_tolerance),
        cull_reasons_(cull_reasons) {}

  enum class Outcome : uint8_t {
    kNothing,     // there are none
    kSimplified,  // the list without them is in `result`
    kCut,         // so it is, and what is hidden was dropped: every ray of the tile ends before it
    kOpenGroups,  // marked() tells of groups that have to be opened first
  };
  Outcome cull(const Tile& tile, const CellList& list, Restrictor& restrictor, CellList& result);
  /// If all rays of the tile enter one primitive by one plane face, and have ended where they do:
  /// `result` is without what lies behind that plane, or touches it from behind and comes earlier
  /// in the file. False: there is no such primitive, or nothing behind it. cut_t() is the furthest
  /// depth of that face.
  bool cut_by_face(const Tile& tile, const CellList& list, Restrictor& restrictor,
                   CellList& result);
  /// By the list's indices.
  std::span<const uint8_t> marked() const { return marked_; }
  /// After a cut for all of a tile's rays: the depth that all rays of the tile end before.
  double cut_t() const { return cut_t_; }
  /// Whether some primitive covers a part of the tile that smaller tiles may lie in wholly.
  bool is_partly_covered() const { return is_partly_covered_; }

 private:
  /// A primitive that holds the tile's cross-section at every depth between.
  struct Cover {
    uint32_t primitive;
    double from_t, to_t;
  };
  struct FaceCandidate {
    uint32_t index;  // in the list
    uint32_t primitive;
    double entry_t;
  };
  /// normal · (x − pivot) = offset.
  struct FacePlane {
    Vec3 normal;
    double offset;
  };
  void find_face_candidates(const CellList& list, const Box& tile, size_t most);
  std::optional<FacePlane> entered_plane(const RayPacket& rays, uint32_t primitive,
                                         const PacketSegments& segments) const;
  bool lies_behind(uint32_t index, const FacePlane& plane, double limit) const;
  bool is_enough(const CellList& list, uint32_t index, Restrictor& restrictor);
  static double slack_of(const Cover& cover);
  bool find_covers(const Tile& tile, const CellList& list);
  void decide_within(const CellList& list, double from_t, double to_t);
  void drop_undecisive(const CellList& list, Restrictor& restrictor, const Cover& cover);
  bool all_end_before(const CellList& list, Restrictor& restrictor, double depth);
  bool drop_behind(const CellList& list, double depth, const Cover& cover);
  bool covers_at(uint32_t primitive, double from_t, double to_t) const;
  std::optional<double> free_depth(const CellList& list, double from_t, double to_t);
  void note(uint32_t index, CullReason cull_reason);

  std::span<const CanonicalPrimitive> primitives_;
  const OperandGroups& groups_;
  ScreenBounds& bounds_;
  std::span<const Extent> screen_;
  const FrameRays& frame_;
  bool centers_only_;
  std::optional<bool> last_value_;
  double cover_share_;
  double thickness_tolerance_;
  CullReasons& cull_reasons_;

  using Decision = Restrictor::Decision;
  std::vector<Cover> covers_;
  // Of the list that is culled:
  bool has_groups_ = false;
  bool is_partly_covered_ = false;
  double cut_t_ = 0;
  std::vector<Decision> decisions_;  // while a question is asked
  std::vector<Decision> dropped_;    // kOutside: the test decides nothing
  std::vector<uint8_t> marked_;
  CellList indices_;  // the list, with its indices for primitives
  CellList probe_;
  std::vector<uint8_t> decides_;
  std::vector<uint32_t> noted_;
  std::vector<FaceCandidate> face_candidates_;
};

}  // namespace csgcore
