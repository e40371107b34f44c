#include "panels/layout.hpp"

#include <algorithm>
#include <array>

namespace window {
namespace {

bool overlap(const LabelBox& a, const LabelBox& b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

/// Returns the coordinate that is nearest to `wanted` and keeps a length within a range.
float kept_within(float wanted, float length, float from, float range) {
  return std::max(from, std::min(wanted, from + range - length));
}

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

void separate(std::span<LabelBox> labels, std::span<const LabelBox> obstacles,
              const LabelBox& room) {
  std::vector<LabelBox> taken(obstacles.begin(), obstacles.end());
  for (LabelBox& label : labels) {
    label.x = kept_within(label.x, label.width, room.x, room.width);
    label.y = kept_within(label.y, label.height, room.y, room.height);
    // A free place begins where it is wanted, or at an end of something that is taken.
    std::vector<float> places = {label.y};
    for (const LabelBox& box : taken) {
      places.push_back(box.y - label.height);
      places.push_back(box.y + box.height);
    }
    const auto is_free = [&](float y) {
      LabelBox moved = label;
      moved.y = y;
      const bool is_within = y >= room.y && y + label.height <= room.y + room.height;
      return is_within && std::none_of(taken.begin(), taken.end(),
                                       [&](const LabelBox& box) { return overlap(moved, box); });
    };
    std::stable_sort(places.begin(), places.end(), [&](float a, float b) {
      return std::abs(a - label.y) < std::abs(b - label.y);
    });
    const auto place = std::find_if(places.begin(), places.end(), is_free);
    if (place != places.end()) label.y = *place;
    taken.push_back(label);
  }
}

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
