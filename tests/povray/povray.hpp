// Uses POV-Ray as an outside judge (paper §4.2): writes scenes in its language, and reads its
// pictures.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "csgcore/phong.hpp"
#include "csgcore/scene.hpp"
#include "csgcore/view.hpp"
#include "reference.hpp"

namespace povray {

/// Writes the scene's model with the view's camera, the light and phong.hpp's finish, on a black
/// background, as POV-Ray 3.7 text with linear colours. Precondition: `may_be_told_from_black`.
std::string scene_text(const csgcore::Scene& scene, const csgcore::View& view,
                       const csgcore::PhongLight& light, const csgcore::ReferenceColors& colors);

/// Writes the same model and camera with OpenSCAD's shading.
std::string openscad_scene_text(const csgcore::Scene& scene, const csgcore::View& view,
                                const csgcore::ReferenceColors& colors);

/// Writes the same with every primitive in a flat colour of its own, which primitive_of() decodes,
/// on black.
std::string id_scene_text(const csgcore::Scene& scene, const csgcore::View& view);
/// Returns the index of the primitive that a pixel of such a picture shows; csgcore::kNoPrimitive
/// if it shows none.
uint32_t primitive_of(const std::array<uint8_t, 3>& pixel);

/// Returns whether every surface's ambient part alone is brighter than 8-bit black, so that a black
/// pixel is a miss.
bool may_be_told_from_black(const csgcore::Scene& scene, const csgcore::ReferenceColors& colors);

using Pixels = std::vector<std::array<uint8_t, 3>>;  // row-major from the top left corner

/// Runs povray at the paper's quality (+Q3: no shadows), without antialiasing. Throws
/// std::runtime_error with povray's messages.
Pixels render(const std::string& scene_text, uint32_t width_px, uint32_t height_px);

/// Returns whether there is a povray to run.
bool installed();

}  // namespace povray
