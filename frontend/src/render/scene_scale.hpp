// Scenes of sizes that floats cannot square: drawn scaled by a power of two, which is exact.
#pragma once

#include "csgcore/image.hpp"
#include "csgcore/scene.hpp"
#include "csgcore/view.hpp"

namespace frontend {

/// The exponent of 2 by which the scene is to be scaled before floats draw it; 0 for every scene of
/// a sensible size. Throws Error if it is beyond what even a scaled scene can hold.
int scale_exponent(const csgcore::Scene& scene);

/// The same scene and view in units 2^−exponent times as large. What is too thin there to have a
/// volume becomes a speck.
csgcore::Scene scaled(const csgcore::Scene& scene, int exponent);
csgcore::View scaled(const csgcore::View& view, int exponent);

/// Takes the measured channels of a scaled scene's picture back to the scene's own units.
void undo_scale(int exponent, csgcore::Image& image);

}  // namespace frontend
