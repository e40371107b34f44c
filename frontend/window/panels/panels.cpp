#include "panels/panels.hpp"

#include <imgui.h>

#include "panels/keyboard.hpp"
#include "panels/layout.hpp"
#include "state_texts.hpp"

namespace window {

void draw_panels(State& state, const csgcore::View& view, float pixels_per_unit,
                 const PanelActions& actions) {
  draw_menu_bar(state, actions.run, actions.open_design);
  const float status_top = draw_status_line(state);
  const float messages_top = draw_messages(state, status_top, actions.open);
  const float animation_top = draw_animation(state, messages_top);
  draw_orientation(state, view, animation_top);
  const SectionCorner section = draw_section(state);
  const FreeRoom room{customizer_right(state, section), animation_top, section};
  draw_customizer(state, animation_top - height_below_parameters(state, room), section);
  const LabelBox place = draw_place(state, view, room, actions.run);
  draw_points(state, view, {room.bottom, place});
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const float top = ImGui::GetFrameHeight(), height = animation_top - top;
  const LabelBox panels[] = {{0, top, room.left, height},
                             {section.left, top, display.x - section.left, section.bottom - top},
                             place};
  state.free_part = free_part({0, 0, display.x, display.y}, {0, top, display.x, height}, panels);
  draw_hover_tip(state, pixels_per_unit);
  draw_progress(state, actions.run);
  draw_help(state, status_top);
  draw_save_dialogue(state, actions.save);
  draw_export_dialogue(state, actions.export_model);
  draw_open_dialogue(state, actions.open_design);
  mark_entered_panel();
}

void copy(State& state, const std::string& text) {
  ImGui::SetClipboardText(text.c_str());
  const std::size_t end = text.find('\n');
  state.notice = "copied: " + text.substr(0, end) + (end == std::string::npos ? "" : " …");
}

void copy_measured_or_said(State& state) {
  const std::string text = text_to_copy(state);
  if (text.empty()) {
    state.notice = "nothing is measured or said: a click on the design measures a point";
  } else {
    copy(state, text);
  }
}

}  // namespace window
