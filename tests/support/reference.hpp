// The renderers' oracle: a picture by brute force, in extended precision, in a formulation of its
// own (all crossings of a ray sorted, the tree's value kept by counting), sharing no code with the
// subdivision or the renderers.
//
// The picture that it defines (csgcore/NUMERICS.md, "The definition"):
// - Along a pixel's ray every primitive has one segment or none; its ends are crossings. Those at
//   which the solid's value changes are its boundaries.
// - Two crossings are together if they lie less than the tolerance apart, measured along the normal
//   of that of the two which the ray meets more squarely. A coincidence is a maximal run of
//   boundaries each together with the next: the pieces and gaps between them do not exist.
// - A perspective view sees what is further away than the tolerance (in s): crossings up to there
//   have happened at the eye, so that an eye in a face is not torn between its sides by rounding.
//   The hit is the first coincidence after which the value differs from that at the eye (that at −∞
//   in orthographic views).
// - What changed is the primitives with one crossing within the coincidence, or together with its
// first
//   or its last boundary: faces that coincide, whether or not rounding makes them boundaries. Shown
//   is a decider, a primitive without whose change the value would not have changed; of several
//   that of the lowest index. If there is none, since several changes would do without each other,
//   then of those that change the value's way (additions that are entered, subtractions that are
//   left, or the reverse for an eye inside) only as many are looked at, from the lowest index, as
//   make the change; among them there is a decider.
// All of that is a matter of the solid's function alone: a primitive that makes no difference where
// the ray is makes none here, and culling it changes nothing.
#pragma once

#include <memory>
#include <vector>

#include "csgcore/image.hpp"
#include "csgcore/phong.hpp"
#include "csgcore/scene.hpp"
#include "csgcore/view.hpp"

namespace csgcore {

using Real = long double;
using LongVec3 = glm::vec<3, Real>;

/// The tolerance as a share of the model's box's diagonal: wide against the rounding of double
/// (1e-16), narrow against any shell a person models (1e-6).
constexpr double kReferenceThickness = 1e-9;

/// What a ray shows. Everything in world space; the normal is unit and outward of the solid.
struct ReferenceHit {
  uint32_t primitive = kNoPrimitive;  // index into Scene::primitives; kNoPrimitive at a miss
  Real s = std::numeric_limits<Real>::infinity();  // View's s
  LongVec3 position{0};
  LongVec3 normal{0};
  bool hit() const { return primitive != kNoPrimitive; }
};

/// Rays through a scene's model (neither its background nor its highlight).
class Reference {
 public:
  Reference(const Scene& scene, const View& view);
  ~Reference();

  /// All pixels' hits, row-major from the top left corner. Uses all the machine's threads; the
  /// picture does not depend on their number.
  std::vector<ReferenceHit> picture() const;

  /// One ray: that of pixel_ray(view, x_px, y_px) (any coordinates), moved sideways by `shift`,
  /// which is in world units. By no culling: for few rays.
  ReferenceHit at(double x_px, double y_px, const LongVec3& shift = LongVec3(0)) const;

  /// Diagonal of the model's box.
  double model_size() const;

  /// How far a renderer in double may see a ray displaced, in world units: kReferenceDisplacement
  /// of the model's size, and what the rounding of the coordinates that the ray and the primitives
  /// are given in can do.
  Real displacement() const;

  /// True if rays at that distance from the pixel's own, in eight directions (and, in perspective,
  /// from an eye so much further or nearer), don't agree: in what they hit, or in where, by more
  /// than kReferencePositionError of the model's size or kReferenceNormalError.
  bool undecided(uint32_t x_px, uint32_t y_px) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// A few thousand roundings of a double: the longest chain of a renderer, from a ray in the world
/// to a root of a primitive's quadric, has some fifty, each amplified by the condition of a matrix.
constexpr double kReferenceDisplacement = 1e-12;

/// Positions that lie so far apart, as a share of the model's size, are of different places.
constexpr double kReferencePositionError = 1e-9;

/// Unit normals that differ by so much are of different faces.
constexpr double kReferenceNormalError = 1e-5;

/// Reference::picture as an Image with all measured channels; rgb is white at a hit and black at a
/// miss.
Image reference_render(const Scene& scene, const View& view);

/// The colours of a surface that the design leaves uncoloured, each channel in [0, 1].
struct ReferenceColors {
  Vec3 background{0.0};
  Vec3 front{1.0};  // faces of what is added
  Vec3 back{1.0};   // faces that something subtracted has cut
};

/// Fills rgb of a picture with measured channels by phong_color, in double, from those channels.
void reference_shade_phong(Image& image, const Scene& scene, const View& view,
                           const PhongLight& light, const ReferenceColors& colors);

/// For each primitive of the scene: true where it stands on the subtracted side of the model's
/// differences (within an odd number of them), so that its faces are cut faces.
std::vector<bool> subtracted_primitives(const Scene& scene);

/// The box of the model: of the added primitives, tight to each, differences being as their first
/// operand and intersections as their operands' common box. Empty for an empty model.
Box reference_box(const Scene& scene);

}  // namespace csgcore
