#include <imgui.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <glm/geometric.hpp>

#include "frontend/overlays.hpp"
#include "panels/panels.hpp"
#include "picture/edge_overlay.hpp"

namespace window {
namespace {

/// In heights of letters: the length of an axis, and that of the picture's free corner.
constexpr float kAxisLength = 2.2f, kCornerRoom = 3.2f;

struct Axis {
  const char* name;
  ImU32 color;
  csgcore::Vec3 direction;
};

constexpr Axis kAxes[] = {{"x", IM_COL32(225, 60, 60, 255), {1, 0, 0}},
                          {"y", IM_COL32(50, 160, 60, 255), {0, 1, 0}},
                          {"z", IM_COL32(70, 110, 240, 255), {0, 0, 1}}};

}  // namespace

void draw_orientation(const State& state, const csgcore::View& view, float bottom) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const float letter = ImGui::GetFontSize();
  if (state.shows_orientation) {
    const ImVec2 origin(kCornerRoom * letter, bottom - kCornerRoom * letter);
    std::array<Axis, 3> axes = std::to_array(kAxes);
    // Those that point away from the eye are drawn first.
    std::ranges::sort(axes, std::ranges::greater(),
                      [&](const Axis& axis) { return glm::dot(axis.direction, view.forward); });
    for (const Axis& axis : axes) {
      const auto right = static_cast<float>(glm::dot(axis.direction, view.right));
      const auto up = static_cast<float>(glm::dot(axis.direction, view.up));
      const auto at = [&](float share) {
        return ImVec2(origin.x + share * letter * right, origin.y - share * letter * up);
      };
      list.AddLine(origin, at(kAxisLength), axis.color, letter / 6);
      const ImVec2 size = ImGui::CalcTextSize(axis.name);
      const ImVec2 end = at(kAxisLength + 0.55f);
      list.AddText({end.x - size.x / 2, end.y - size.y / 2}, axis.color, axis.name);
    }
  }
  if (!state.overlays.grid || state.look.show != frontend::Show::kSurface) return;
  const frontend::Rgb& background = state.look.scheme.background;
  const auto line = frontend::ContrastLines::color_on({background.r, background.g, background.b});
  char text[32];
  std::snprintf(text, sizeof text, "grid %g",
                frontend::grid_spacing(view, state.navigation.camera()));
  const float left = state.shows_orientation ? 2 * kCornerRoom * letter : letter;
  list.AddText({left, bottom - 1.5f * letter}, IM_COL32(line[0], line[1], line[2], 150), text);
}

}  // namespace window
