// The look of a section plane's faces: each part of the assembly is hatched in a direction of its
// own, and has an outline.
#pragma once

#include <cstdint>
#include <span>

#include "csgcore/image.hpp"
#include "csgcore/view.hpp"
#include "section_plane.hpp"

namespace window {

/// Returns the distance of the hatches, in world units: about as many pixels of the view as are
/// right for the eye, and a power of two, so that lines stay where they are while the view moves.
/// `distance` is the camera's.
double hatch_spacing(const csgcore::View& view, double distance);

/// Hatches the section's faces, and draws the outlines 1 px wide, within them. Lines lie in the
/// plane, at places that depend on the plane and the part alone. Where they are closer than pixels
/// the face is evenly darker. Faces of translucent parts, and those that are seen through such
/// parts, have lines that are as faint (Image::shares). `parts` is CutScene::parts. Precondition:
/// the image has the view's size and its id channel.
void draw_section_faces(csgcore::Image& image, const csgcore::View& view, const SectionPlane& plane,
                        std::span<const uint32_t> parts, double spacing);

}  // namespace window
