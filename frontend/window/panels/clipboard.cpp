#include "panels/clipboard.hpp"

#include <imgui.h>

#include "measured_text.hpp"

namespace window {

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
