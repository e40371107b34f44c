// Culling: drops primitives that a tile's rays cannot see from the tile's list.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "primitives/crossings.hpp"
#include "rays/frame_rays.hpp"
#include "rays/packet_blocks.hpp"
#include "solid/operand_groups.hpp"
#include "solid/restriction.hpp"

namespace csgcore {

/// Returns the box of a tile's rays on the screen, at any depth. The rays go through the pixels'
/// centres only, or through any points of the pixels.
inline Box box_of(const Tile& tile, bool centers_only) {
  constexpr double kAnyDepth = std::numeric_limits<double>::infinity();
  const double border = centers_only ? 0.0 : 0.5;
  const double x = tile.x;
  const double y = tile.y;
  return {{x - border, y - border, -kAnyDepth},
          {x + tile.width - 1 + border, y + tile.height - 1 + border, kAnyDepth}};
}

/// Returns the positions of rays through the corners of such a box, in the first four lanes.
PacketLaterals laterals_of_corners(const FrameRays& frame, const Box& box);

/// Drops primitives from the list of a tile that decide nothing although the tile's rays may meet
/// them. An *occluder* is a primitive that contains the tile's whole cross-section over a stretch
/// of depth. Within the stretch it is known to hold, which may settle the list:
/// - primitives that lie wholly within the stretch, and that the list does not depend on there, are
///   cancelled or lie inside the solid;
/// - if all rays of the tile have ended at some depth of the stretch (see Parameters::last_value),
/// all
///   primitives behind that depth are hidden.
/// Since primitives are convex, the four rays through the tile's corners give an occluder's
/// stretch.
class TileCuller {
 public:
  /// A solid on the screen. It refers to all but the numbers.
  struct Parameters {
    std::span<const CanonicalPrimitive> primitives;
    const OperandGroups* groups;
    std::span<const Extent> screen;
    const FrameRays* frame;
    bool centers_only;
    /// A ray ends as soon as the solid has this value; none: rays do not end.
    std::optional<bool> last_value;
    /// A stretch counts only if it is longer than this share of its primitive's depth.
    double cover_share;
    double thickness_tolerance;
  };
  explicit TileCuller(const Parameters& parameters) : parameters_(parameters) {}
  /// Goes on with lists of another solid.
  void aim_at(const Parameters& parameters) { parameters_ = parameters; }

  enum class Outcome : uint8_t {
    kNothing,     // no primitive can be dropped
    kSimplified,  // `result` is the list without those that decide nothing
    kCut,         // so it is, and hidden primitives were dropped: every ray of the tile ends before
                  // cut_t()
    kOpenGroups,  // the groups in marked() have to be expanded first
  };
  Outcome cull(const Tile& tile, const CellList& list, Restrictor& restrictor, CellList& result);
  /// Cuts the list by a face, if all rays of the tile enter one primitive through one plane face
  /// and end there. Then `result` lacks primitives that lie behind that plane, or that come earlier
  /// in the file and reach no further than into it. Returns false if there is no such face, or no
  /// primitive behind it. cut_t() is then the largest t at which rays enter by the face, plus a
  /// slack for rounding.
  bool cut_by_face(const Tile& tile, const CellList& list, Restrictor& restrictor,
                   CellList& result);
  /// By index in the list.
  std::span<const uint8_t> marked() const { return marked_; }
  /// After a cut, a t before which all rays of the tile end.
  double cut_t() const { return cut_t_; }
  /// Returns whether some primitive covers a part of the tile, so that it may be an occluder for
  /// smaller tiles.
  bool is_partly_covered() const { return is_partly_covered_; }

 private:
  /// An occluder: a primitive that contains the tile's cross-section at every t in [from_t, to_t].
  struct Cover {
    uint32_t primitive;
    double from_t, to_t;
  };
  struct FaceCandidate {
    uint32_t index;  // in the list
    uint32_t primitive;
    double entry_t;
  };
  /// The plane normal · (x − pivot) = offset, whose normal points towards the eye.
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
  bool drop_behind(const CellList& list, double depth);
  bool covers_at(uint32_t primitive, double from_t, double to_t) const;
  std::optional<double> free_depth(const CellList& list, double from_t, double to_t);

  Parameters parameters_;

  using Decision = Restrictor::Decision;
  std::vector<Cover> covers_;
  // The state of the list that is being culled:
  bool has_groups_ = false;
  bool is_partly_covered_ = false;
  double cut_t_ = 0;
  std::vector<Decision> decisions_;  // for single probes
  std::vector<Decision> dropped_;    // kOutside: the test decides nothing
  std::vector<uint8_t> marked_;
  CellList indices_;  // the list, with indices in place of primitives
  CellList probe_;
  std::vector<uint8_t> decides_;
  std::vector<FaceCandidate> face_candidates_;
};

}  // namespace csgcore
