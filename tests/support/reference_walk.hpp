// One ray through a scene, by the reference's definition (see reference.hpp).
#pragma once

#include <span>
#include <vector>

#include "csgcore/scene.hpp"
#include "csgcore/view.hpp"
#include "reference.hpp"
#include "reference_primitive.hpp"
#include "reference_tree.hpp"

namespace csgcore::reference {

/// What rays need of a scene and a view, both of which must outlive it.
struct RaySetup {
  RaySetup(const Scene& rays_scene, const View& rays_view);

  const Scene& scene;
  const View& view;
  double model_size;
  Vec3 pivot{0.0};     // near the model
  double pivot_s = 0;  // there, about
  Real thickness;      // the tolerance
  Real displacement;   // see Reference::displacement
  /// Nothing is seen up to there, by the t of near_ray.
  Real first_t;
  std::vector<RayTarget> targets;  // by the primitives' index
  std::vector<bool> subtracted;    // likewise
};

/// The definition's ray (csgcore::pixel_ray: in double, by the formula of view.hpp), near the
/// model.
NearRay near_ray(const RaySetup& setup, double x_px, double y_px);

/// One ray after the other, through a tree or the part of it that makes a difference to them.
class RayWalk {
 public:
  RayWalk(const RaySetup& setup, std::span<const CsgToken> tokens) : setup_(setup), tree_(tokens) {}

  /// The primitives' indices, by their slots in the tree.
  std::span<const uint32_t> slots() const { return tree_.slots(); }

  /// `candidates`: slots that hold all primitives that the ray can meet.
  ReferenceHit hit(const NearRay& ray, std::span<const uint32_t> candidates);

 private:
  /// Where the ray crosses a primitive's surface.
  struct Crossing {
    Real t;
    uint32_t slot;
    Surface surface;
    bool enters;
  };
  /// Boundaries of the solid by which its value may turn: crossings [first, last], the first and
  /// the last of which are boundaries themselves. Other boundaries lie before `begin` or not before
  /// `end`.
  struct Coincidence {
    size_t begin, first, last, end;
    bool turns;  // the value after it is another than before it
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
  CountingTree tree_;                // that of a point after the first passed_ crossings
  std::vector<Crossing> crossings_;  // of the ray, by t
  size_t passed_ = 0;
  std::vector<Crossing> changed_;     // by a coincidence, in order of the primitives
  std::vector<uint8_t> has_changed_;  // by slot
  const NearRay* ray_ = nullptr;
};

}  // namespace csgcore::reference
