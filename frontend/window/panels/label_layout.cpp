#include "panels/label_layout.hpp"

#include <algorithm>

namespace window {
namespace {

bool overlap(const LabelBox& a, const LabelBox& b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

/// Returns the coordinate that is nearest to `wanted` and keeps a length within a range.
float kept_within(float wanted, float length, float from, float range) {
  return std::max(from, std::min(wanted, from + range - length));
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

}  // namespace window
