// The exact ray oracle finds what a ray sees of a scene's model, by the definition of
// csgcore/NUMERICS.md, in exact arithmetic. It is slow, and judges renderers: it shares no code
// with the subdivision, the tracer or their geometry.
//
// Numbers, local→world matrices and rays are taken as exact. A ray crosses a quadric or a plane at
// an algebraic number of degree 2; crossings are ordered exactly (Deakin and Snoeyink, "On the
// Precision to Sort Line-Quadric Intersections", CCCG 2003), by intervals of doubles if these
// suffice, and otherwise by CGAL::Sqrt_extension over dyadic numbers of any length. Extruded and
// revolved profiles, whose crossings are of degree 4 at most, are enclosed by exact signs to 2^-90
// of the way through their box; crossings that are nearer to each other count as equal.
//
// Thicknesses are compared with the tolerance τ by intervals, whose width is some 1e-7 of τ.
// Thicknesses that they cannot compare differ from τ by far less than the displacement at which a
// ray counts as undecided.
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
  /// The ray's parameter: two equal doubles if it is a double, else the doubles next to it on both
  /// sides. Both are +inf at a miss.
  Bounds s{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  csgcore::Vec3 position{0.0};  // exact to the last bits; 0 at a miss
  csgcore::Vec3 normal{0.0};    // unit, outward of the solid, exact to some 1e-15; 0 at a miss
  bool hit() const { return primitive != kMiss; }
};

/// The reason why a renderer in double may see something else than the exact ray.
enum class Doubt : uint8_t {
  kNone,
  kSilhouette,  // rays moved sideways by the displacement see another surface or position
  kEye,         // rays moved forwards or backwards by it do (perspective)
  kThickness,   // rays do by a τ that is larger or smaller by twice the displacement
};

/// Counts of the computations, and of those for which intervals of doubles did not suffice.
struct ExactCounts {
  uint64_t rays = 0;
  uint64_t segments = 0;  // of one ray with one primitive whose box it meets
  uint64_t exact_segments = 0;
  uint64_t comparisons = 0;  // of two crossings, or of one with the eye
  uint64_t exact_comparisons = 0;
  uint64_t thicknesses = 0;            // between two crossings
  uint64_t unsettled_thicknesses = 0;  // those too near τ for intervals
  void add(const ExactCounts& other);
};

/// The displacement of a surface by rounding that a renderer in double is allowed, as a share of
/// the model's size. It is a few thousand roundings; the longest chain has some fifty, each
/// amplified by the condition of a matrix.
constexpr double kExactDisplacement = 1e-12;

/// Two positions that are further apart than this share of the model's size are different places.
/// Two unit normals that differ by more than kExactNormalError belong to different faces.
constexpr double kExactPositionError = 1e-9;
constexpr double kExactNormalError = 1e-5;

/// A scene's model, without its layers, prepared for rays. The scene must outlive it.
class ExactScene {
 public:
  explicit ExactScene(const csgcore::Scene& scene);
  ~ExactScene();

  /// Diagonal of the model's box, in world units; 0 for an empty model.
  double size() const;
  /// The thickness tolerance τ, in world units.
  double thickness() const;
  /// kExactDisplacement of the size plus the displacement by the rounding of coordinates, in world
  /// units.
  double displacement() const;

 private:
  friend class ExactRays;
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Traces rays through a scene, one after the other. Each thread needs its own object; the scene
/// must outlive it.
class ExactRays {
 public:
  explicit ExactRays(const ExactScene& scene);
  ~ExactRays();

  /// Returns what the ray sees: in perspective at s > τ, else along the whole line. The ray's
  /// direction must not be 0, and all of its coordinates must be finite.
  ExactHit first_hit(const csgcore::Ray& ray, csgcore::Projection projection);

  /// Traces a dozen rays near the given one. The ray is undecided unless the result is kNone.
  Doubt doubt(const csgcore::Ray& ray, csgcore::Projection projection);

  const ExactCounts& counts() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Returns the hits of all pixels' rays (csgcore::pixel_ray), row-major from the top left corner.
/// It uses all the machine's threads; the picture does not depend on their number. It adds to
/// `counts`, if given.
std::vector<ExactHit> exact_picture(const ExactScene& scene, const csgcore::View& view,
                                    ExactCounts* counts = nullptr);

}  // namespace oracle
