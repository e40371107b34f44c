// The part of the picture that no panel covers.
#pragma once

#include <span>

#include "framing.hpp"
#include "panels/label_layout.hpp"

namespace window {

/// Returns the largest part of the room that is beside the panels, less a margin. A panel that
/// would take most of it lies over the part.
PicturePart free_part(const LabelBox& display, LabelBox room, std::span<const LabelBox> panels);

}  // namespace window
