// Traces one ray through a prepared scene, by the definition of csgcore/NUMERICS.md, 1.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "csgcore/view.hpp"
#include "near_planes.hpp"
#include "oracle/exact_rays.hpp"
#include "prepared_scene.hpp"

namespace oracle {

/// A ray to be traced, moved by `shift`, with `thickness` for τ; both are in world units.
struct SeenRay {
  csgcore::Ray ray;
  csgcore::Projection projection;
  double thickness;
  csgcore::Vec3 shift{0.0};
};

/// Traces rays one after the other. RoundingUp must be on.
class ExactWalk {
 public:
  explicit ExactWalk(const PreparedScene& scene) : scene_(scene), tree_(scene.outside) {}

  struct Shown {
    ExactHit hit;
    csgcore::Vec3 from_pivot{0.0};  // the hit's position relative to the pivot
  };
  Shown see(const SeenRay& ray);
  /// Returns whether some thickness along the last ray was too near τ for intervals.
  bool unsettled() const { return unsettled_; }

  const ExactCounts& counts() const { return counts_; }

 private:
  /// A segment of the ray within a primitive.
  struct Candidate {
    uint32_t primitive;
    uint32_t segment;  // how many segments with this primitive come before it
    Ends ends;
    // The ray in intervals, with the parameter u = t − base.
    double base;
    LocalRay<Interval> local;
    Interval u[2], t[2];  // of the two ends
    /// The exact ray with the parameter t, if intervals did not suffice.
    std::optional<LocalRay<Exact>> exact;
    /// The ends' parameters t, up to an error, if the primitive is made of a profile.
    std::optional<std::array<ExactRoot, 2>> found = {};
    double error = 0;
  };
  struct Crossing {
    uint32_t candidate;
    bool at_end;
  };
  /// A coincidence: boundaries of the solid each of which coincides with the next. `first` and
  /// `last` are the crossings of its first and last boundary. The boundary before it has an index
  /// below `begin`, and the one after it has the index `end`.
  struct Coincidence {
    size_t begin, first, last, end;
  };

  void set_ray(const SeenRay& ray);
  void collect();
  void add_candidates(uint32_t primitive);
  void add_mesh_candidates(uint32_t primitive);
  void add_profile_candidates(uint32_t primitive);
  void evaluate();
  std::optional<Coincidence> first_turning_coincidence();

  const Interval& t_of(const Crossing& crossing) const {
    return candidates_[crossing.candidate].t[crossing.at_end];
  }
  Surface surface_of(const Crossing& crossing) const;
  /// How much later than it meets that surface the ray crosses the primitive.
  double beyond_of(const Crossing& crossing) const {
    return crossing.at_end ? candidates_[crossing.candidate].ends.beyond : 0;
  }
  uint32_t primitive_of(const Crossing& crossing) const {
    return candidates_[crossing.candidate].primitive;
  }
  ExactRoot exact_of(const Crossing& crossing) const;
  void refine(Candidate& candidate);
  void find_ends(Candidate& candidate);

  int order(const Crossing& a, const Crossing& b);
  bool is_behind_eye(const Crossing& crossing);
  bool together(const Crossing& a, const Crossing& b);
  Interval thickness_between(const Crossing& a, const Crossing& b) const;
  Interval steepness(const Crossing& crossing) const;

  void pass_until(size_t count);
  void collect_changes(const Coincidence& coincidence);
  void drop_what_came_back();
  bool turns(const Crossing& crossing) const;
  Crossing shown_of(const Coincidence& coincidence);
  Shown describe(const Crossing& crossing) const;
  Bounds tight_s(const ExactRoot& u, double base, const Interval& s) const;

  const PreparedScene& scene_;
  TreeValue tree_;  // after the first passed_ crossings
  size_t passed_ = 0;
  ExactCounts counts_;
  bool unsettled_ = false;

  // The ray is x(t) = pivot + origin + t·direction, with s = base_s + t.
  SeenRay seen_;
  double base_s_ = 0;
  NearRay<Exact> exact_ray_;
  NearRay<Interval> ray_;
  Exact exact_eye_t_;  // in perspective, only t beyond it is seen
  Interval eye_t_;

  std::vector<uint32_t> items_;
  NearPlanes near_planes_;
  std::vector<Candidate> candidates_;
  std::vector<Crossing> crossings_;  // in order along the ray
  std::vector<uint8_t> values_;      // the solid's, before each crossing and after the last
  std::vector<Crossing> changed_;    // see collect_changes()
  std::vector<uint32_t> changed_primitives_;
  size_t eye_ = 0;  // the number of crossings behind the eye
};

}  // namespace oracle
