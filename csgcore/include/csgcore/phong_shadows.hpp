// Hard shadows of the paper's light (phong.hpp): "a two-pass approach, rendering … from the light
// source point of view" (paper §5), exact for each pixel.
#pragma once

#include "csgcore/image.hpp"
#include "csgcore/solid.hpp"
#include "csgcore/tracer.hpp"
#include "csgcore/view.hpp"

namespace csgcore {

/// Takes the light's diffuse and specular parts from the pixels whose centre the solid keeps from
/// its light. `image` was drawn with Shading::kPhong, `light_box` as the box that the light is
/// fitted to (phong_light()), one ray a pixel and Boundary::kFirst. `strength`: which share of
/// these parts, in [0, 1]. What has an alpha below 1 casts shadows, and keeps its own light.
/// `options` may name no area; its samples do not count. Adds to `stats`.
void cast_phong_shadows(const Solid& solid, const View& view, const Box& light_box, double strength,
                        const TraceOptions& options, Image& image, TraceStats& stats);

}  // namespace csgcore
