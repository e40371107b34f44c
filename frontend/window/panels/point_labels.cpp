#include "panels/point_labels.hpp"

#include <imgui.h>

#include <algorithm>
#include <cstdio>
#include <glm/geometric.hpp>
#include <optional>
#include <string>
#include <vector>

#include "projection.hpp"

namespace window {
namespace {

using csgcore::Vec3;

constexpr ImU32 kPointColor = IM_COL32(220, 30, 90, 255);
constexpr ImU32 kShadowColor = IM_COL32(255, 255, 255, 220);

/// Writes a label, moved to the left if it would leave the window.
void label(ImDrawList& list, ImVec2 at, const std::string& text) {
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  at.x = std::max(4.0f, std::min(at.x, ImGui::GetIO().DisplaySize.x - size.x - 4));
  list.AddRectFilled({at.x - 3, at.y - 2}, {at.x + size.x + 3, at.y + size.y + 2}, kShadowColor, 3);
  list.AddText(at, kPointColor, text.c_str());
}

}  // namespace

void draw_points(const State& state, const csgcore::View& view) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  std::vector<std::optional<ImVec2>> places;
  for (const MeasuredPoint& point : state.points) {
    const std::optional<PicturePoint> place = project(view, point.position);
    places.push_back(place ? std::optional(ImVec2(static_cast<float>(place->x_px),
                                                  static_cast<float>(place->y_px)))
                           : std::nullopt);
  }
  if (places.size() == 2 && places[0] && places[1]) {
    list.AddLine(*places[0], *places[1], kShadowColor, 4);
    list.AddLine(*places[0], *places[1], kPointColor, 2);
    const Vec3 apart = state.points[1].position - state.points[0].position;
    char text[64];
    std::snprintf(text, sizeof text, "%.6g", glm::length(apart));
    label(list, {(places[0]->x + places[1]->x) / 2 + 8, (places[0]->y + places[1]->y) / 2},
          std::string(text) + "  " + coordinates(apart));
  }
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!places[i]) continue;
    list.AddCircleFilled(*places[i], 5, kShadowColor);
    list.AddCircleFilled(*places[i], 3.5f, kPointColor);
    // The label is above the first point and below the second, which leaves room between them.
    const float top = places[i]->y + (i == 0 ? -ImGui::GetTextLineHeight() - 12 : 12);
    label(list, {places[i]->x, top}, coordinates(state.points[i].position));
  }
}

}  // namespace window
