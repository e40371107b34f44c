#include "panels/point_labels.hpp"

#include <imgui.h>

#include <optional>
#include <string>
#include <vector>

#include "measured_text.hpp"
#include "projection.hpp"

namespace window {
namespace {

constexpr ImU32 kPointColor = IM_COL32(220, 30, 90, 255);
constexpr ImU32 kShadowColor = IM_COL32(255, 255, 255, 220);

/// The space around a label's text, and around a point.
constexpr float kPaddingX = 3, kPaddingY = 2, kPointRadius = 5;
constexpr float kBesidePoint = 12;

LabelBox box_around(const std::string& text, const ImVec2& at) {
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  return {at.x - kPaddingX, at.y - kPaddingY, size.x + 2 * kPaddingX, size.y + 2 * kPaddingY};
}

void draw_label(ImDrawList& list, const LabelBox& box, const std::string& text) {
  list.AddRectFilled({box.x, box.y}, {box.x + box.width, box.y + box.height}, kShadowColor, 3);
  list.AddText({box.x + kPaddingX, box.y + kPaddingY}, kPointColor, text.c_str());
}

}  // namespace

void draw_points(const State& state, const csgcore::View& view, const LabelRoom& room) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  std::vector<std::optional<ImVec2>> places;
  for (const MeasuredPoint& point : state.points) {
    const std::optional<PicturePoint> place = project(view, point.position);
    places.push_back(place ? std::optional(ImVec2(static_cast<float>(place->x_px),
                                                  static_cast<float>(place->y_px)))
                           : std::nullopt);
  }
  std::vector<LabelBox> labels, obstacles = {room.place};
  std::vector<std::string> texts;
  const auto add = [&](const std::string& text, const ImVec2& at) {
    texts.push_back(text);
    labels.push_back(box_around(text, at));
  };
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!places[i]) continue;
    // The label is above the first point and below the second, which leaves room between them.
    const float above = -ImGui::GetTextLineHeight() - kBesidePoint;
    add(coordinates(state.points[i].position),
        {places[i]->x, places[i]->y + (i == 0 ? above : kBesidePoint)});
    obstacles.push_back({places[i]->x - kPointRadius, places[i]->y - kPointRadius, 2 * kPointRadius,
                         2 * kPointRadius});
  }
  if (places.size() == 2 && places[0] && places[1]) {
    list.AddLine(*places[0], *places[1], kShadowColor, 4);
    list.AddLine(*places[0], *places[1], kPointColor, 2);
    add(distance_text(state.points),
        {(places[0]->x + places[1]->x) / 2 + 8, (places[0]->y + places[1]->y) / 2});
  }
  const float top = ImGui::GetFrameHeight();
  separate(labels, obstacles, {0, top, ImGui::GetIO().DisplaySize.x, room.bottom - top});
  for (const std::optional<ImVec2>& place : places) {
    if (!place) continue;
    list.AddCircleFilled(*place, kPointRadius, kShadowColor);
    list.AddCircleFilled(*place, 0.7f * kPointRadius, kPointColor);
  }
  for (std::size_t i = 0; i < labels.size(); ++i) draw_label(list, labels[i], texts[i]);
}

}  // namespace window
