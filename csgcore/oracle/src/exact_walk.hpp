// One ray through a prepared scene, by the definition of csgcore/NUMERICS.md, 1.
#pragma once

#include <optional>
#include <vector>

#include "csgcore/view.hpp"
#include "near_planes.hpp"
#include "oracle/exact_rays.hpp"
#include "prepared_scene.hpp"

namespace oracle {

/// A ray, with how far it is moved and what is taken for τ, both in world units.
struct SeenRay {
  csgcore::Ray ray;
  csgcore::Projection projection;
  double thickness;
  csgcore::Vec3 shift{0.0};
};

/// One ray after the other. RoundingUp must be on.
class ExactWalk {
 public:
  explicit ExactWalk(const PreparedScene& scene) : scene_(scene), tree_(scene.outside) {}

  struct Shown {
    ExactHit hit;
    csgcore::Vec3 from_pivot{0.0};  // the hit's position
  };
  Shown see(const SeenRay& ray);
  /// Whether something between the last ray's crossings was too near τ for intervals.
  bool unsettled() const { return unsettled_; }

  const ExactCounts& counts() const { return counts_; }

 private:
  /// A primitive that the ray meets.
  struct Candidate {
    uint32_t primitive;
    Ends ends;
    // In intervals, by a parameter u = t − base.
    double base;
    LocalRay<Interval> local;
    Interval u[2], t[2];  // of the ends
    /// By t; where intervals did not suffice.
    std::optional<LocalRay<Exact>> exact;
  };
  struct Crossing {
    uint32_t candidate;
    bool at_end;
  };
  /// Boundaries of the solid of which each is together with the next: crossings [first, last], the
  /// first and the last of which are boundaries themselves. Other boundaries lie before `begin` and
  /// not before `end`.
  struct Coincidence {
    size_t begin, first, last, end;
  };

  void set_ray(const SeenRay& ray);
  void collect();
  void add_candidate(uint32_t primitive);
  void evaluate();
  std::optional<Coincidence> first_turning_coincidence();

  const Interval& t_of(const Crossing& crossing) const {
    return candidates_[crossing.candidate].t[crossing.at_end];
  }
  Surface surface_of(const Crossing& crossing) const;
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

  // The ray: x(t) = pivot + origin + t·direction, s = base_s + t.
  SeenRay seen_;
  double base_s_ = 0;
  NearRay<Exact> exact_ray_;
  NearRay<Interval> ray_;
  Exact exact_eye_t_;  // nothing is seen up to there, in perspective
  Interval eye_t_;

  std::vector<uint32_t> items_;
  NearPlanes near_planes_;
  std::vector<Candidate> candidates_;
  std::vector<Crossing> crossings_;  // in order along the ray
  std::vector<uint8_t> values_;      // of the solid, before each crossing and after the last
  std::vector<Crossing> changed_;    // by a coincidence, in order of the primitives
  std::vector<uint32_t> changed_primitives_;
  size_t eye_ = 0;  // crossings behind the eye
};

}  // namespace oracle
