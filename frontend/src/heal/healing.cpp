#include "heal/healing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <vector>

#include "base/primitive_traits.hpp"
#include "heal/faces.hpp"

namespace frontend {
namespace {

using csgcore::Affine;
using csgcore::Mat3;
using csgcore::Primitive;
using csgcore::Vec3;

// Features closer than this share of the design's size coincide already: double arithmetic does not
// place them better after a chain of matrices (each product costs 1e-16).
constexpr double kPlaceNoise = 1e-14;
// Two numbers with the same exact value are printed the same. So a gap as large as both half units
// together means that the design's values differ; this factor excludes it, and its own rounding.
constexpr double kStrictly = 1 - 1e-6;
// Distinct features within one another's bounds are rare. Where a file has more than this many of
// them, the later ones are not compared with all earlier ones.
constexpr size_t kMostRepresentatives = 16;
// The columns of a circular cross-section have one length and are at right angles within this
// share. It is much finer than 6 digits, since heal_matrix has made similarities exact, and coarser
// than the shears that merging planes leaves behind.
constexpr double kCircular = 1e-5;
// A polyhedron's face is moved along a direction in which other faces run. If a step in that
// direction leads away from the plane by less than this share (60° aslant), the polyhedron would
// move by more than twice the gap.
constexpr double kLeastProgress = 0.5;

// Directions that no design has on purpose. Features are sorted by one number, their projection
// onto these. Equal features have equal numbers; different features have equal ones by accident
// only.
const Vec3 kOffsetProbe = glm::normalize(Vec3(0.61803398875, 0.41421356237, 0.73205080757));
const Vec3 kDirectionProbe = glm::normalize(Vec3(-0.30277563773, 0.77200187266, 0.56155281281));

/// The kinds of features that are made to coincide.
enum class Feature : uint8_t { kPlane, kAxis, kCenter };

/// A feature of a primitive, sorted by its key.
struct Entry {
  double key;
  double tolerance;  // an upper bound of the key's error by rounding
  uint32_t primitive;
  uint8_t face;  // number of a plane's face
};

/// The place of an axis, about which a primitive is round.
struct AxisPlace {
  std::array<Vec3, 2> point;  // two points of the axis
  Vec3 normal;                // unit; of the planes that are across the axis in local space
  Vec3 axis;                  // unit
};

Roundness roundness_of(const Primitive& primitive) {
  return traits_of(primitive.shape()).roundness(primitive);
}

AxisPlace place_of(const Primitive& primitive, const Roundness& roundness) {
  const Affine& map = primitive.local_to_world;
  AxisPlace place;
  for (int i = 0; i < 2; ++i) place.point[i] = map.point(Vec3(0, 0, roundness.axis_z[i]));
  place.normal = glm::normalize(glm::cross(map.linear[0], map.linear[1]));
  place.axis = glm::normalize(map.linear[2]);
  return place;
}

/// Returns whether the faces form three parallel pairs: the image of a cube.
bool is_parallelepiped(const PlaneFaces& faces) {
  const auto has_opposite = [](const PlaneFace& face) { return face.opposite.has_value(); };
  return faces.faces.size() == 6 &&
         std::all_of(faces.faces.begin(), faces.faces.end(), has_opposite);
}

/// Moves each point y of the primitive to y − shift − turn·(y − pivot).
void move(Primitive& primitive, const Vec3& pivot, const Vec3& shift, const Mat3& turn) {
  Affine& map = primitive.local_to_world;
  map.translation -= shift + turn * (map.translation - pivot);
  map.linear -= turn * map.linear;
}

class Merger {
 public:
  Merger(std::span<Primitive> primitives, std::span<const uint32_t> frame_of,
         const FrameTree& frames, const csgcore::Box& design)
      : primitives_(primitives),
        frame_of_(frame_of),
        frames_(frames),
        origin_(design.center()),
        size_(design.diagonal()),
        noise_(kPlaceNoise * (size_ + glm::length(origin_))) {}

  void merge() {
    merge_kind(Feature::kPlane);
    merge_kind(Feature::kAxis);
    merge_kind(Feature::kCenter);
  }

 private:
  bool exact(uint32_t primitive) const {
    const Frame& frame = frames_[frame_of_[primitive]];
    return frame.linear_error == 0 && frame.point_error == 0;
  }

  double error_at(uint32_t primitive, const Vec3& point) const {
    const Frame& frame = frames_[frame_of_[primitive]];
    if (frame.linear_error == 0) return frame.point_error;
    return frame.point_error + frame.linear_error * glm::length(local_of(frame, point));
  }

  static Vec3 local_of(const Frame& frame, const Vec3& point) {
    return csgcore::inverse(frame.to_world.linear) * (point - frame.to_world.translation);
  }

  /// Returns how far rounding may have turned a direction of the primitive, in radians.
  double turn_error(uint32_t primitive) const {
    const double error = frames_[frame_of_[primitive]].linear_error;
    if (error == 0) return 0;
    const Mat3& map = frames_[frame_of_[primitive]].to_world.linear;
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i) least = std::min(least, glm::length(map[i]));
    return 2 * error / least;
  }

  /// Returns the sort key of a direction with a point's offset, the same for ±direction.
  double directed_key(Vec3 direction, const Vec3& offset, bool offset_is_along) const {
    if (glm::dot(direction, kOffsetProbe) < 0) direction = -direction;
    const double place = glm::dot(offset, offset_is_along ? direction : kOffsetProbe);
    return place + size_ * glm::dot(direction, kDirectionProbe);
  }

  void add_entries(Feature kind, uint32_t index, std::vector<Entry>& entries) {
    switch (kind) {
      case Feature::kPlane:
        return add_planes(index, entries);
      case Feature::kAxis:
        return add_axis(index, entries);
      case Feature::kCenter:
        return add_center(index, entries);
    }
  }

  void add_planes(uint32_t index, std::vector<Entry>& entries) {
    const Primitive& primitive = primitives_[index];
    const PlaneFaces& local = faces_.of(primitive);
    if (local.faces.empty()) return;
    const double turn = 2 * size_ * turn_error(index);
    for (uint8_t i = 0; i < local.faces.size(); ++i) {
      if (local.faces[i].corner_count == 0) continue;
      const Face face = face_in_world(local.faces[i], primitive.local_to_world);
      entries.push_back({directed_key(face.normal, face.center - origin_, true),
                         error_at(index, face.center) + turn, index, i});
    }
  }

  void add_axis(uint32_t index, std::vector<Entry>& entries) const {
    const Primitive& primitive = primitives_[index];
    const Roundness roundness = roundness_of(primitive);
    if (roundness.about != Roundness::About::kAxis) return;
    const AxisPlace place = place_of(primitive, roundness);
    const double turn = 2 * size_ * turn_error(index);
    const Vec3 from_origin = place.point[0] - origin_;
    const Vec3 foot = from_origin - place.axis * glm::dot(from_origin, place.axis);
    entries.push_back(
        {directed_key(place.axis, foot, false), error_at(index, place.point[0]) + turn, index, 0});
  }

  void add_center(uint32_t index, std::vector<Entry>& entries) const {
    const Primitive& primitive = primitives_[index];
    if (roundness_of(primitive).about != Roundness::About::kCenter) return;
    const Vec3& center = primitive.local_to_world.translation;
    entries.push_back(
        {glm::dot(center - origin_, kOffsetProbe), error_at(index, center), index, 0});
  }

  void merge_kind(Feature kind) {
    std::vector<Entry> entries;
    entries.reserve(primitives_.size() * (kind == Feature::kPlane ? 2 : 1));
    for (uint32_t i = 0; i < primitives_.size(); ++i) add_entries(kind, i, entries);
    // Features with sizes near the ends of double's range have no usable place or direction.
    std::erase_if(entries, [](const Entry& entry) {
      return !std::isfinite(entry.key) || !std::isfinite(entry.tolerance);
    });
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
      return a.key < b.key || (a.key == b.key && a.primitive < b.primitive);
    });
    for (size_t begin = 0, end; begin < entries.size(); begin = end) {
      // A run: each feature may coincide with the next one.
      bool rounded = !exact(entries[begin].primitive);
      for (end = begin + 1; end < entries.size(); ++end) {
        const double reach = entries[end].tolerance + entries[end - 1].tolerance + noise_;
        if (entries[end].key - entries[end - 1].key > reach) break;
        rounded = rounded || !exact(entries[end].primitive);
      }
      if (end - begin > 1 && rounded) {
        merge_run(kind, std::span(entries).subspan(begin, end - begin));
      }
    }
  }

  /// Exact features lead, then those first in the file; the others follow them.
  void merge_run(Feature kind, std::span<Entry> run) {
    std::sort(run.begin(), run.end(), [&](const Entry& a, const Entry& b) {
      const bool exact_a = exact(a.primitive);
      const bool exact_b = exact(b.primitive);
      if (exact_a != exact_b) return exact_a;
      return a.primitive < b.primitive || (a.primitive == b.primitive && a.face < b.face);
    });
    std::vector<Entry> leaders;
    for (const Entry& entry : run) {
      bool found = false;
      for (const Entry& leader : leaders) {
        if (leader.primitive == entry.primitive) continue;
        found = merge_pair(kind, leader, entry);
        if (found) break;
      }
      if (!found && leaders.size() < kMostRepresentatives) leaders.push_back(entry);
    }
  }

  bool merge_pair(Feature kind, const Entry& leader, const Entry& entry) {
    switch (kind) {
      case Feature::kPlane:
        return merge_planes(leader, entry);
      case Feature::kAxis:
        return merge_axes(leader, entry);
      case Feature::kCenter:
        return merge_centers(leader, entry);
    }
    return false;
  }

  /// Returns how far rounding may have separated, along the unit direction, a point that both
  /// primitives have at `point`: as far as the matrices from each primitive to their common frame
  /// explain.
  double explained(uint32_t a, uint32_t b, const Vec3& point, const Vec3& direction) const {
    const std::optional<uint32_t> common = frames_.common(frame_of_[a], frame_of_[b]);
    if (!common) return 0;
    Vec3 error(0.0);
    for (const uint32_t primitive : {a, b}) {
      const Vec3 local = local_of(frames_[frame_of_[primitive]], point);
      error += frames_.error_of_point(frame_of_[primitive], *common, local);
    }
    const Vec3 seen = glm::abs(direction * frames_[*common].to_world.linear);
    return kStrictly * glm::dot(seen, error);
  }

  bool is_noise(double gap) const { return std::abs(gap) <= noise_; }

  /// Returns whether the gap is noise, or rounding explains it. It is at most the sum of the
  /// entries' tolerances, which are faster to compare.
  bool may_close(const Entry& leader, const Entry& entry, const Vec3& point, const Vec3& direction,
                 double gap) const {
    if (is_noise(gap)) return true;
    if (std::abs(gap) > leader.tolerance + entry.tolerance) return false;
    return std::abs(gap) < explained(leader.primitive, entry.primitive, point, direction);
  }

  bool locked(uint32_t primitive, uint32_t face) const {
    return !locks_.empty() && (locks_[primitive] >> face & 1) != 0;
  }

  void lock(const Entry& entry) {
    if (locks_.empty()) locks_.resize(primitives_.size());
    locks_[entry.primitive] |= uint32_t{1} << entry.face;
  }

  bool merge_planes(const Entry& leader, const Entry& entry) {
    const Face theirs = faces_.at(primitives_[leader.primitive], leader.face);
    const Affine& map = primitives_[entry.primitive].local_to_world;
    const PlaneFaces& local = faces_.of(primitives_[entry.primitive]);
    const Face ours = face_in_world(local.faces[entry.face], map);
    // The corners show both the place and the tilt of the face.
    double extent = 0;
    bool all_noise = true;
    for (const Vec3& corner_local : local.corners_of(local.faces[entry.face])) {
      const Vec3 corner = map.point(corner_local);
      const double gap = glm::dot(theirs.normal, corner - theirs.center);
      if (!may_close(leader, entry, corner, theirs.normal, gap)) return false;
      all_noise = all_noise && is_noise(gap);
      extent = std::max(extent, glm::length(corner - ours.center));
    }
    if (!all_noise && !align_face(entry, ours, theirs, extent)) return false;
    lock(leader);
    lock(entry);
    return true;
  }

  /// Moves the face, whose corners are at most `extent` from its centre, onto the target's plane.
  bool align_face(const Entry& entry, const Face& ours, const Face& target, double extent) {
    Primitive& primitive = primitives_[entry.primitive];
    const std::optional<Vec3> along = way_of(entry, ours, target.normal);
    if (!along) return false;
    const std::optional<uint32_t> other = faces_.of(primitive).faces[entry.face].opposite;
    const double gap = glm::dot(target.normal, ours.center - target.center);
    const Vec3 step = *along / glm::dot(*along, target.normal);
    const Vec3 slope = target.normal - ours.normal / glm::dot(ours.normal, step);
    const bool other_locked = other && locked(entry.primitive, *other);
    if (other_locked && !is_noise(glm::length(slope) * extent)) return false;
    const Vec3 other_center = other ? faces_.at(primitive, *other).center : Vec3(0.0);
    // A shear along the way moves the parallel face in the same manner …
    move(primitive, ours.center, step * gap, glm::outerProduct(step, slope));
    if (!other || !(other_locked || others_run_along(primitive, ours.normal, *along))) return true;
    // … and a stretch from the target's plane puts that face back.
    const Vec3 moved = faces_.at(primitive, *other).center;
    move(primitive, target.center, Vec3(0.0),
         glm::outerProduct((moved - other_center) / glm::dot(target.normal, moved - target.center),
                           target.normal));
    return true;
  }

  /// Returns whether all faces that are not parallel to `normal` run in the direction: then a
  /// stretch along it moves none of them out of its plane.
  bool others_run_along(const Primitive& primitive, const Vec3& normal, const Vec3& direction) {
    for (const PlaneFace& face : faces_.of(primitive).faces) {
      const Vec3 other = face_in_world(face, primitive.local_to_world).normal;
      if (!parallel(other, normal) && std::abs(glm::dot(other, direction)) > kParallel) {
        return false;
      }
    }
    return true;
  }

  /// Returns the direction in which the face may move so that the other faces stay in their planes:
  /// all of them in a parallelepiped, which has that freedom, and the locked ones in any other
  /// polyhedron. A cap moves along its normal. Nothing if the face may not move.
  std::optional<Vec3> way_of(const Entry& entry, const Face& ours, const Vec3& normal) {
    const Primitive& primitive = primitives_[entry.primitive];
    const PlaneFaces& local = faces_.of(primitive);
    const bool keeps_all = is_parallelepiped(local);
    std::vector<Vec3> kept;  // normals of those planes, no two of them parallel
    for (uint32_t face = 0; face < local.faces.size(); ++face) {
      if (!keeps_all && !locked(entry.primitive, face)) continue;
      const Vec3 other = face_in_world(local.faces[face], primitive.local_to_world).normal;
      const auto is_parallel = [&](const Vec3& known) { return parallel(known, other); };
      if (is_parallel(ours.normal) || std::any_of(kept.begin(), kept.end(), is_parallel)) continue;
      kept.push_back(other);
    }
    Vec3 way = normal;
    if (kept.size() == 1) way = normal - kept[0] * glm::dot(kept[0], normal);
    if (kept.size() > 1) way = glm::cross(kept[0], kept[1]);
    way = glm::normalize(way);
    for (const Vec3& other : kept) {
      if (std::abs(glm::dot(way, other)) > kParallel) return std::nullopt;
    }
    if (!(std::abs(glm::dot(way, normal)) >= kLeastProgress)) return std::nullopt;
    return way;
  }

  bool merge_axes(const Entry& leader, const Entry& entry) {
    const uint32_t index = entry.primitive;
    const Primitive& leading = primitives_[leader.primitive];
    const AxisPlace ours = place_of(primitives_[index], roundness_of(primitives_[index]));
    const AxisPlace theirs = place_of(leading, roundness_of(leading));
    std::array<Vec3, 2> gaps;
    bool all_noise = true;
    for (int i = 0; i < 2; ++i) {
      const Vec3 offset = ours.point[i] - theirs.point[0];
      gaps[i] = offset - theirs.axis * glm::dot(offset, theirs.axis);
      const double size = glm::length(gaps[i]);
      if (is_noise(size)) continue;
      all_noise = false;
      if (!may_close(leader, entry, ours.point[i], gaps[i] / size, size)) return false;
    }
    if (!all_noise) align_axis(primitives_[index], ours, theirs.axis, gaps);
    merge_radii(leader.primitive, index);
    return true;
  }

  /// Moves the axis onto the line, along the planes across it, which stay in place.
  static void align_axis(Primitive& primitive, const AxisPlace& ours, const Vec3& line,
                         std::array<Vec3, 2> gaps) {
    for (Vec3& gap : gaps) gap -= line * (glm::dot(ours.normal, gap) / glm::dot(ours.normal, line));
    const double height = glm::dot(ours.normal, ours.point[1] - ours.point[0]);
    const Vec3 slope = (gaps[1] - gaps[0]) / height;
    move(primitive, ours.point[0], gaps[0], glm::outerProduct(slope, ours.normal));
  }

  bool merge_centers(const Entry& leader, const Entry& entry) {
    const uint32_t index = entry.primitive;
    const Vec3 center = primitives_[index].local_to_world.translation;
    const Vec3 gap = center - primitives_[leader.primitive].local_to_world.translation;
    bool all_noise = true;
    for (int i = 0; i < 3; ++i) {
      Vec3 direction(0.0);
      direction[i] = 1;
      if (!may_close(leader, entry, center, direction, gap[i])) return false;
      all_noise = all_noise && is_noise(gap[i]);
    }
    if (!all_noise) primitives_[index].local_to_world.translation -= gap;
    merge_radii(leader.primitive, index);
    return true;
  }

  /// Returns the world radius per unit of local radius; 0 if the cross-section is not a circle
  /// (about a centre: if the image is not a sphere).
  static double radial_scale(const Primitive& primitive, const Roundness& roundness) {
    const Mat3& map = primitive.local_to_world.linear;
    const int columns = roundness.about == Roundness::About::kCenter ? 3 : 2;
    const double scale = glm::length(map[0]);
    for (int i = 1; i < columns; ++i) {
      if (std::abs(glm::length(map[i]) - scale) > kCircular * scale) return 0;
      for (int j = 0; j < i; ++j) {
        if (std::abs(glm::dot(map[i], map[j])) > kCircular * scale * scale) return 0;
      }
    }
    return scale;
  }

  /// Returns how far rounding may have separated the radii of two primitives that both have a point
  /// at `radius` (a vector in the world) from their axis.
  double explained_radius(uint32_t a, uint32_t b, const Vec3& radius) const {
    const std::optional<uint32_t> common = frames_.common(frame_of_[a], frame_of_[b]);
    if (!common) return 0;
    Vec3 error(0.0);
    for (const uint32_t primitive : {a, b}) {
      const Vec3 local = csgcore::inverse(frames_[frame_of_[primitive]].to_world.linear) * radius;
      error += frames_.error_of_vector(frame_of_[primitive], *common, local);
    }
    const Vec3 direction = glm::normalize(radius);
    const Vec3 seen = glm::abs(direction * frames_[*common].to_world.linear);
    return kStrictly * glm::dot(seen, error);
  }

  /// Merges the radii about an axis or centre that the two primitives share.
  void merge_radii(uint32_t leader, uint32_t index) {
    if (exact(index)) return;
    Primitive& ours = primitives_[index];
    const Primitive& theirs = primitives_[leader];
    const Roundness our_roundness = roundness_of(ours);
    const Roundness their_roundness = roundness_of(theirs);
    const double our_scale = radial_scale(ours, our_roundness);
    const double their_scale = radial_scale(theirs, their_roundness);
    if (our_scale == 0 || their_scale == 0) return;
    for (const double r : our_roundness.radii) {
      for (const double other : their_roundness.radii) {
        if (r == 0 || other == 0) continue;
        const double gap = r * our_scale - other * their_scale;
        const Vec3 radius = r * ours.local_to_world.linear[0];
        if (is_noise(gap)) return;
        if (std::abs(gap) >= explained_radius(leader, index, radius)) continue;
        widen(ours, our_roundness, other * their_scale / (r * our_scale));
        return;
      }
    }
  }

  /// Multiplies the radii in the world: about the centre, or along the planes across the axis.
  static void widen(Primitive& primitive, const Roundness& roundness, double factor) {
    Mat3& map = primitive.local_to_world.linear;
    map[0] *= factor;
    map[1] *= factor;
    if (roundness.about == Roundness::About::kCenter) map[2] *= factor;
  }

  std::span<Primitive> primitives_;
  std::span<const uint32_t> frame_of_;
  const FrameTree& frames_;
  Faces faces_;
  Vec3 origin_;
  double size_;
  double noise_;
  static_assert(kMostComparedFaces <= 32, "a bit each");
  std::vector<uint32_t> locks_;  // a bit per face: its plane is shared, and must not move any more
};

}  // namespace

void merge_features(std::span<Primitive> primitives, std::span<const uint32_t> frame_of,
                    const FrameTree& frames, const csgcore::Box& design) {
  if (frames.exact() || !std::isfinite(design.diagonal())) return;
  Merger(primitives, frame_of, frames, design).merge();
}

}  // namespace frontend
