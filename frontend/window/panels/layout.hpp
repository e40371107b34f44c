// Where labels stand so that each can be read, and which part of the picture no panel covers.
#pragma once

#include <span>
#include <vector>

#include "framing.hpp"

namespace window {

/// A rectangle of the screen, from its upper left corner, y downwards.
struct LabelBox {
  float x = 0, y = 0, width = 0, height = 0;
};

/// Moves labels into the room, and apart from each other and from the obstacles: up or down, as far
/// as it takes, the earlier ones first. Where there is no such place, a label stays where it is
/// wanted.
void separate(std::span<LabelBox> labels, std::span<const LabelBox> obstacles,
              const LabelBox& room);

/// Returns the largest part of the room that is beside the panels, less a margin. A panel that
/// would take most of it lies over the part.
PicturePart free_part(const LabelBox& display, LabelBox room, std::span<const LabelBox> panels);

}  // namespace window
