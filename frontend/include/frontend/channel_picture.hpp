// A measured channel as a picture: --show=depth|normals|id.
#pragma once

#include "csgcore/image.hpp"
#include "frontend/render_settings.hpp"

namespace frontend {

/// Replaces `image.rgb` by a picture of the channel `show`; misses get `background`. kSurface and
/// kCells, which renderers draw, leave the image as it is. Depth: near is white, far dark grey,
/// linear in z over the range of the hits. Normals: (n + 1)/2. Id: a colour of its own for each id
/// below 2^24. Precondition: the image has its measured channels.
void show_channel(csgcore::Image& image, Show show, Rgb background);

}  // namespace frontend
