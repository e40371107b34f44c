#include <imgui.h>

#include <algorithm>
#include <string>
#include <vector>

#include "panels/panels.hpp"
#include "panels/style.hpp"
#include "projection.hpp"
#include "state_texts.hpp"

namespace window {
namespace {

/// The least width of texts beside the parameters, in heights of the font.
constexpr float kLeastBesideParameters = 16;
constexpr ImU32 kPlaceColor = IM_COL32(170, 190, 215, 255);

/// The widths of the trail's two columns, and the gap between them.
struct Columns {
  float left = 0, gap = 0, right = 0;
  float width() const { return left + gap + right; }
};

/// Returns columns that fit into a width.
Columns columns_of(const frontend::LeafPlace& place, float width) {
  Columns columns;
  for (const frontend::TrailStep& step : place.trail) {
    columns.left = std::max(columns.left, text_width(step.what));
    columns.right = std::max(columns.right, text_width(text_of(step.place)));
  }
  columns.gap = ImGui::GetFontSize();
  columns.left = std::min(columns.left, std::max(width - columns.gap - columns.right, width / 3));
  columns.right = std::min(columns.right, std::max(width - columns.gap - columns.left, 0.0f));
  return columns;
}

/// The trail, a line for each step, of which one is chosen.
void draw_trail(State& state, const frontend::LeafPlace& place, const Columns& columns) {
  for (std::size_t i = 0; i < place.trail.size(); ++i) {
    const frontend::TrailStep& step = place.trail[i];
    ImGui::PushID(static_cast<int>(i));
    const float start = ImGui::GetCursorPosX();
    if (ImGui::Selectable("##step", i == state.chosen_step, 0, {columns.width(), 0})) {
      state.chosen_step = i;
    }
    ImGui::SameLine(start);
    ImGui::TextUnformatted(cut_to(step.what, columns.left).c_str());
    ImGui::SameLine(start + columns.left + columns.gap);
    ImGui::PushStyleColor(ImGuiCol_Text, kPlaceColor);
    ImGui::TextUnformatted(cut_to(text_of(step.place), columns.right).c_str());
    ImGui::PopStyleColor();
    ImGui::PopID();
  }
}

struct Layout {
  std::vector<std::string> measured;
  float most_text = 0;  // the width that texts may take
  Columns columns;
  ImVec2 size;
  bool is_below = false;  // the parameters, which leave little room beside them
};

/// Precondition: a point is measured.
Layout layout_of(const State& state, const FreeRoom& room) {
  const MeasuredPoint& point = state.points.back();
  const ImVec2 padding = ImGui::GetStyle().WindowPadding;
  const float around = 2 * (kPanelMargin + padding.x), display = ImGui::GetIO().DisplaySize.x;
  Layout layout;
  layout.is_below =
      room.left > 0 && display - room.left - around < kLeastBesideParameters * ImGui::GetFontSize();
  layout.most_text = std::max(display - (layout.is_below ? 0 : room.left) - around, 50.0f);
  layout.measured = measured_lines(state.points);
  layout.columns = columns_of(point.place, layout.most_text);
  const auto rows =
      static_cast<float>(point.place.trail.size() + layout.measured.size() + point.is_cut);
  layout.size = {layout.columns.width() + 2 * padding.x,
                 rows * ImGui::GetTextLineHeightWithSpacing() + ImGui::GetFrameHeightWithSpacing() +
                     2 * padding.y};
  return layout;
}

/// Returns the panel's corner at the left of the room: below the menu, and below the section panel
/// if there is no room beside it; or at the room's lower end if the point would be hidden.
ImVec2 corner_of(const Layout& layout, const State& state, const csgcore::View& view,
                 const FreeRoom& room) {
  const ImVec2& size = layout.size;
  const float left = (layout.is_below ? 0 : room.left) + kPanelMargin;
  if (layout.is_below) return {left, room.bottom - size.y - kPanelMargin};
  float top = ImGui::GetFrameHeight() + kPanelMargin;
  if (left + size.x > room.section.left) top = room.section.bottom + kPanelMargin;
  const auto point = project(view, state.points.back().position);
  const bool hides = point && point->x_px > left - kPanelMargin &&
                     point->x_px < left + size.x + kPanelMargin && point->y_px > top &&
                     point->y_px < top + size.y + kPanelMargin;
  const float bottom = room.bottom - size.y - kPanelMargin;
  return {left, hides && bottom > point->y_px + kPanelMargin ? bottom : top};
}

}  // namespace

float height_below_parameters(const State& state, const FreeRoom& room) {
  if (!state.shows_place || state.points.empty()) return 0;
  const Layout layout = layout_of(state, room);
  return layout.is_below ? layout.size.y + kPanelMargin : 0;
}

LabelBox draw_place(State& state, const csgcore::View& view, const FreeRoom& room,
                    const RunCommand& run) {
  if (!state.shows_place || state.points.empty()) return {};
  const MeasuredPoint& point = state.points.back();
  const Layout layout = layout_of(state, room);
  const frontend::SourcePlace* const place = state.place_to_open();
  const bool has_file = place != nullptr && !place->path.empty();
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos(corner_of(layout, state, view, room));
  ImGui::SetNextWindowSizeConstraints({0, 0}, {display.x - 2 * kPanelMargin, display.y / 2});
  ImGui::SetNextWindowBgAlpha(0.85f);
  if (ImGui::Begin("##place", nullptr, kOverlay & ~ImGuiWindowFlags_NoScrollbar)) {
    if (point.is_cut) ImGui::TextUnformatted("cut by the section plane:");
    draw_trail(state, point.place, layout.columns);
    if (!layout.measured.empty()) ImGui::Separator();
    ImGui::PushTextWrapPos(ImGui::GetStyle().WindowPadding.x + layout.most_text);
    for (const std::string& line : layout.measured) ImGui::TextUnformatted(line.c_str());
    ImGui::PopTextWrapPos();
    if (has_file && ImGui::SmallButton("Open in the editor (E)")) run(Command::kOpenEditor);
    if (ImGui::IsWindowHovered() && ImGui::IsMouseClicked(ImGuiMouseButton_Right)) {
      copy_measured_or_said(state);
    }
  }
  const ImVec2 at = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
  ImGui::End();
  return {at.x, at.y, size.x, size.y};
}

}  // namespace window
