#include "panels/free_part.hpp"

#include <algorithm>
#include <array>

namespace window {
namespace {

/// The least share of the display's width and height that the part has.
constexpr float kLeastPart = 0.3f;
/// The margin at each of the part's sides, as a share of its width or height.
constexpr float kPartMargin = 0.03f;

float area(const LabelBox& box) { return std::max(box.width, 0.0f) * std::max(box.height, 0.0f); }

/// Returns the largest part of a room that is left of, right of, above or below a panel.
LabelBox beside(const LabelBox& room, const LabelBox& panel) {
  const float right = panel.x + panel.width, below = panel.y + panel.height;
  const std::array<LabelBox, 4> parts = {
      {{room.x, room.y, panel.x - room.x, room.height},
       {right, room.y, room.x + room.width - right, room.height},
       {room.x, room.y, room.width, panel.y - room.y},
       {room.x, below, room.width, room.y + room.height - below}}};
  return *std::max_element(parts.begin(), parts.end(),
                           [](const LabelBox& a, const LabelBox& b) { return area(a) < area(b); });
}

}  // namespace

PicturePart free_part(const LabelBox& display, LabelBox room, std::span<const LabelBox> panels) {
  const auto is_enough = [&](const LabelBox& part) {
    return part.width >= kLeastPart * display.width && part.height >= kLeastPart * display.height;
  };
  if (!is_enough(room)) room = display;
  for (const LabelBox& panel : panels) {
    const bool overlaps = panel.width > 0 && panel.height > 0 && panel.x < room.x + room.width &&
                          room.x < panel.x + panel.width && panel.y < room.y + room.height &&
                          room.y < panel.y + panel.height;
    const LabelBox part = overlaps ? beside(room, panel) : room;
    if (is_enough(part)) room = part;
  }
  const float margin_x = kPartMargin * room.width, margin_y = kPartMargin * room.height;
  PicturePart part;
  part.left = (room.x + margin_x) / display.width;
  part.right = (room.x + room.width - margin_x) / display.width;
  part.top = (room.y + margin_y) / display.height;
  part.bottom = (room.y + room.height - margin_y) / display.height;
  part.aspect = display.width / display.height;
  return part;
}

}  // namespace window
