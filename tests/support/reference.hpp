// The renderers' oracle: a picture by brute force, in extended precision, in a formulation of its
// own (lists of intervals along each ray, combined by the set operations), sharing no code with
// the subdivision or the renderers.
#pragma once

#include <vector>

#include "csgcore/image.hpp"
#include "csgcore/phong.hpp"
#include "csgcore/scene.hpp"
#include "csgcore/view.hpp"

namespace csgcore {

/// Pieces and gaps along a ray that are thinner than this share of the model's box's diagonal,
/// measured along the normal at the end where the ray is more oblique, do not exist: faces that two
/// solids share leave no skin (design.md §3). Wide against the rounding of extended precision
/// (1e-19), narrow against any shell a person models (1e-4).
constexpr double kReferenceThickness = 1e-9;

/// Draws `scene.model` (neither background nor highlight) with all measured channels; rgb is white
/// at a hit and black at a miss. A perspective view sees s > 0 only, and the back faces where the
/// eye is inside; an orthographic one sees from −∞. Uses all the machine's threads; the picture
/// does not depend on their number.
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
