// Traces one ray through a scene, by the reference's definition (reference.hpp).
#pragma once

#include <span>
#include <vector>

#include "csgcore/image.hpp"
#include "csgcore/scene.hpp"
#include "csgcore/view.hpp"
#include "reference.hpp"
#include "reference_primitive.hpp"
#include "reference_tree.hpp"

namespace csgcore::reference {

/// What all rays need of a scene and a view, both of which must outlive this object.
struct RaySetup {
  RaySetup(const Scene& rays_scene, const View& rays_view);

  const Scene& scene;
  const View& view;
  double model_size;
  Vec3 pivot{0.0};     // a point near the model
  double pivot_s = 0;  // about the s of the pivot
  Real thickness;      // the tolerance
  Real displacement;   // see Reference::displacement
  /// The t of near_ray up to which nothing is seen.
  Real first_t;
  std::vector<RayTarget> targets;  // by primitive's index
  std::vector<bool> subtracted;    // by primitive's index
};

/// Returns the definition's ray (csgcore::pixel_ray, in double by the formula of view.hpp), with
/// its origin near the model.
NearRay near_ray(const RaySetup& setup, double x_px, double y_px);

/// Traces one ray after the other through a tree, or through the part of it that concerns them.
class RayWalk {
 public:
  RayWalk(const RaySetup& setup, std::span<const CsgToken> tokens) : setup_(setup), tree_(tokens) {}

  /// The primitives' indices, by their slots in the tree.
  std::span<const uint32_t> slots() const { return tree_.slots(); }

  /// `candidates` contains the slots of all primitives that the ray can meet.
  ReferenceHit hit(const NearRay& ray, std::span<const uint32_t> candidates,
                   Boundary boundary = Boundary::kFirst);

 private:
  /// A crossing of the ray with a primitive's surface.
  struct Crossing {
    Real t;
    uint32_t slot;
    Surface surface;
    bool enters;
  };
  /// Boundaries of the solid that may together turn its value: crossings [first, last], whose first
  /// and last are boundaries. No other boundary is in [begin, end).
  struct Coincidence {
    size_t begin, first, last, end;
    bool turns;  // the values before and after it differ
  };

  void collect(std::span<const uint32_t> candidates);
  void pass();
  void pass_until(size_t count);
  size_t next_boundary(size_t from);
  Coincidence cluster_of(size_t begin, size_t first);

  const RayTarget& target(const Crossing& crossing) const;
  bool is_subtracted(const Crossing& crossing) const;
  LongVec3 normal(const Crossing& crossing) const;
  Real steepness(const Crossing& crossing) const;
  bool together(const Crossing& a, const Crossing& b) const;

  void collect_changes(const Coincidence& coincidence);
  void drop_what_came_back();
  const Crossing& shown(const Coincidence& coincidence);
  ReferenceHit describe(const Crossing& crossing) const;

  const RaySetup& setup_;
  CountingTree tree_;  // its point is behind the first passed_ crossings
  std::vector<Span> spans_;
  std::vector<Crossing> crossings_;  // sorted by t
  size_t passed_ = 0;
  std::vector<Crossing> changed_;     // the crossings of a coincidence that change primitives,
                                      // sorted by primitive
  std::vector<uint8_t> has_changed_;  // by slot
  const NearRay* ray_ = nullptr;
};

}  // namespace csgcore::reference
