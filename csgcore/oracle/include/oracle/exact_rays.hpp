// The exact ray oracle: what a ray sees of a scene's model, by the definition of
// csgcore/NUMERICS.md, in exact arithmetic. Slow beside a renderer, and a judge of it: it shares no
// code with the subdivision, the tracer or their geometry.
//
// Numbers, local→world matrices and rays are taken as exact. A ray crosses a quadric or a plane at
// an algebraic number of degree 2; crossings are ordered exactly (Deakin and Snoeyink, "On the
// Precision to Sort Line-Quadric Intersections", CCCG 2003), by intervals of doubles where these
// tell, and else by CGAL::Sqrt_extension over dyadic numbers of any length.
//
// The thickness tolerance τ is compared with intervals, of a relative width of some 1e-7 of it.
// What they do not tell lies far within the displacement at which a ray counts as undecided.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "csgcore/scene.hpp"
#include "csgcore/view.hpp"

namespace oracle {

/// A closed interval of doubles.
struct Bounds {
  double lower, upper;
};

/// What a ray sees, in world space.
struct ExactHit {
  static constexpr uint32_t kMiss = 0xFFFFFFFFu;
  uint32_t primitive = kMiss;  // index into Scene::primitives
  /// The ray's parameter: one double where it is a double itself, else the two next to it. Both
  /// +inf at a miss.
  Bounds s{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  csgcore::Vec3 position{0.0};  // to the last bits of its coordinates; 0 at a miss
  csgcore::Vec3 normal{0.0};    // unit, outward of the solid, to some 1e-15; 0 at a miss
  bool hit() const { return primitive != kMiss; }
};

/// Why a renderer in double may see something else than the exact ray.
enum class Doubt : uint8_t {
  kNone,
  kSilhouette,  // rays at the displacement to the side see another surface, or another place of it
  kEye,         // rays from so much further or nearer do (perspective)
  kThickness,   // with surfaces so much closer or further apart, what is τ thick comes or goes
};

/// How often intervals of doubles did not suffice.
struct ExactCounts {
  uint64_t rays = 0;
  uint64_t segments = 0;  // of a ray with a primitive whose box it meets
  uint64_t exact_segments = 0;
  uint64_t comparisons = 0;  // of two crossings, or of one with the eye
  uint64_t exact_comparisons = 0;
  uint64_t thicknesses = 0;            // of what lies between two crossings
  uint64_t unsettled_thicknesses = 0;  // those too near τ for intervals
  void add(const ExactCounts& other);
};

/// The displacement, as a share of the model's size, that rounding may do to a renderer in double:
/// a few thousand roundings, where the longest chain has some fifty, each amplified by the
/// condition of a matrix.
constexpr double kExactDisplacement = 1e-12;

/// Positions that lie so far apart, as a share of the model's size, are of different places; unit
/// normals that differ by so much are of different faces.
constexpr double kExactPositionError = 1e-9;
constexpr double kExactNormalError = 1e-5;

/// A scene's model (not its layers), prepared for rays. The scene must
/// outlive it.
class ExactScene {
 public:
  explicit ExactScene(const csgcore::Scene& scene);
  ~ExactScene();

  /// Diagonal of the model's box, in world units; 0 of an empty model.
  double size() const;
  /// τ, in world units: a thickness along the normal.
  double thickness() const;
  /// kExactDisplacement of the size, and what the rounding of coordinates can do, in world units.
  double displacement() const;

 private:
  friend class ExactRays;
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Rays through a scene, one after the other; one object a thread.
class ExactRays {
 public:
  explicit ExactRays(const ExactScene& scene);
  ~ExactRays();

  /// What the ray sees: in perspective beyond s = τ, else along the whole line. Its direction is
  /// not 0, and all of its coordinates are finite.
  ExactHit first_hit(const csgcore::Ray& ray, csgcore::Projection projection);

  /// Traces a dozen rays more. The ray is undecided where the answer is not kNone.
  Doubt doubt(const csgcore::Ray& ray, csgcore::Projection projection);

  const ExactCounts& counts() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// All pixels' hits by csgcore::pixel_ray, row-major from the top left corner. Uses all the
/// machine's threads; the picture does not depend on their number. Adds to `counts`, if given.
std::vector<ExactHit> exact_picture(const ExactScene& scene, const csgcore::View& view,
                                    ExactCounts* counts = nullptr);

}  // namespace oracle
