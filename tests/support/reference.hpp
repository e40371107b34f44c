// The renderers' oracle: a picture by brute force in extended precision. It uses a formulation of
// its own (it sorts all crossings of a ray, and counts to keep the tree's value), and shares no
// code with the subdivision or the renderers.
//
// The picture that it defines (csgcore/NUMERICS.md, "The definition"):
// - Along a pixel's ray every primitive has some disjoint segments (a convex one: one or none),
// whose
//   ends are crossings. Those at which the solid's value changes are its boundaries. mesh_solid.hpp
//   has the segments of meshes.
// - Two crossings are coincident if they are less than the tolerance apart, measured along the
//   normal of the one that the ray meets more squarely. A coincidence is a maximal run of
//   boundaries each of which is coincident with the next: the pieces and gaps between them do not
//   exist.
// - A perspective view sees what is further away than the tolerance (in s). Nearer crossings count
//   as passed at the eye, so that rounding does not tear an eye in a face between its sides. The
//   hit is the first coincidence after which the value differs from that at the eye (at −∞ in
//   orthographic views).
// - A primitive has changed by a coincidence if the ray crosses it an odd number of times at
//   crossings that are within the coincidence, or coincident with its first or last boundary; the
//   first of these is its crossing. An operation has
//   turned if its value with all of these changes differs from that without any. From the root of
//   the tree down, the turn of an operation is due to those operands that have turned the same way
//   (subtracted operands: the other way). Of the primitives that are reached in this way, the last
//   in file order is shown.
//
// The definition depends only on the solid's function: a primitive that makes no difference where
// the ray is makes none to the picture, so that culling it changes nothing.
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

/// The tolerance as a share of the diagonal of the model's box: far above the rounding of double
/// (1e-16), far below any shell that a person models (1e-6).
constexpr double kReferenceThickness = 1e-9;

/// What a ray shows, in world space. The normal has unit length and points out of the solid.
struct ReferenceHit {
  uint32_t primitive = kNoPrimitive;  // index into Scene::primitives; kNoPrimitive at a miss
  Real s = std::numeric_limits<Real>::infinity();  // View's s
  LongVec3 position{0};
  LongVec3 normal{0};
  bool hit() const { return primitive != kNoPrimitive; }
};

/// Traces rays through a scene's model, without its background and highlight.
class Reference {
 public:
  Reference(const Scene& scene, const View& view);
  ~Reference();

  /// Returns all pixels' hits, row-major from the top left corner. Uses all the machine's threads;
  /// the picture does not depend on their number.
  std::vector<ReferenceHit> picture() const;

  /// Returns the hit of the ray pixel_ray(view, x_px, y_px) (any coordinates), moved sideways by
  /// `shift`, which is in world units. It culls nothing, and so is for few rays.
  ReferenceHit at(double x_px, double y_px, const LongVec3& shift = LongVec3(0)) const;

  /// Returns what lies behind that hit: where the pixel's ray leaves what it has entered there.
  ReferenceHit behind(double x_px, double y_px) const;

  /// The diagonal of the model's box.
  double model_size() const;

  /// Returns how far a renderer in double may see a ray displaced, in world units:
  /// kReferenceDisplacement of the model's size, plus the possible rounding of the coordinates of
  /// the ray and the primitives.
  Real displacement() const;

  /// Returns whether rays that are displaced by displacement() in eight directions (and in
  /// perspective also forward and back) disagree with the pixel's ray: in what they hit, or in
  /// where, by more than kReferencePositionError of the model's size or kReferenceNormalError.
  bool undecided(uint32_t x_px, uint32_t y_px) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Some thousand roundings of a double. The longest chain of a renderer, from a ray in the world to
/// a root of a primitive's quadric, has some fifty, each amplified by the condition of a matrix.
constexpr double kReferenceDisplacement = 1e-12;

/// Positions further apart than this share of the model's size are different places.
constexpr double kReferencePositionError = 1e-9;

/// Unit normals that differ by more belong to different faces.
constexpr double kReferenceNormalError = 1e-5;

/// Returns Reference::picture as an Image with all measured channels; rgb is white at a hit and
/// black at a miss.
Image reference_render(const Scene& scene, const View& view);

/// The colours of a surface that the design leaves uncoloured, each channel in [0, 1].
struct ReferenceColors {
  Vec3 background{0.0};
  Vec3 front{1.0};  // faces of what is added
  Vec3 back{1.0};   // faces that something subtracted has cut
};

/// Fills rgb of a picture from its measured channels by phong_color, in double.
void reference_shade_phong(Image& image, const Scene& scene, const View& view,
                           const PhongLight& light, const ReferenceColors& colors);

/// Returns for each primitive of the scene whether it is on the subtracted side of an odd number of
/// the model's differences, so that its faces are cut faces.
std::vector<bool> subtracted_primitives(const Scene& scene);

/// Returns the box of the model: the union of its operands' boxes, tight to each primitive. A
/// difference has the box of its first operand, an intersection the common box of its operands.
/// Empty for an empty model.
Box reference_box(const Scene& scene);

}  // namespace csgcore
