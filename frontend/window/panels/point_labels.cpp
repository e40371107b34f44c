#include <imgui.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "panels/panels.hpp"
#include "projection.hpp"
#include "state_texts.hpp"

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

void draw_hover_tip(const State& state, float pixels_per_unit) {
  if (!state.hovered || state.shows_help || ImGui::GetIO().WantCaptureMouse) return;
  const std::string text = hover_text(*state.hovered);
  const ImVec2 padding = ImGui::GetStyle().WindowPadding;
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const float most = std::max(display.x - 2 * padding.x, 1.0f);
  ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, most);
  size = {size.x + 2 * padding.x, size.y + 2 * padding.y};
  const ImVec2 mouse(static_cast<float>(state.hovered->at.x_px) / pixels_per_unit,
                     static_cast<float>(state.hovered->at.y_px) / pixels_per_unit);
  // Below the pointer, or above it where there is no room.
  const float below = mouse.y + 1.5f * ImGui::GetFontSize();
  const ImVec2 at(std::clamp(mouse.x, 0.0f, std::max(display.x - size.x, 0.0f)),
                  below + size.y <= display.y ? below : mouse.y - size.y - 4);
  ImGui::SetNextWindowPos(at);
  ImGui::SetNextWindowBgAlpha(0.85f);
  ImGui::BeginTooltip();  // which lies over the panels
  ImGui::PushTextWrapPos(padding.x + most);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

}  // namespace window
