#include "panels/message_panel.hpp"

#include <imgui.h>

#include <algorithm>
#include <string>
#include <vector>

#include "panels/style.hpp"

namespace window {
namespace {

ImU32 color_of_line(const std::string& line) {
  if (line.find("ERROR") != std::string::npos || line.find("error: ") != std::string::npos) {
    return kErrorColor;
  }
  if (line.find("WARNING") != std::string::npos || line.find("warning: ") != std::string::npos) {
    return kWarningColor;
  }
  return kTextColor;
}

void colored_text(ImU32 color, const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, color);
  ImGui::PushTextWrapPos(0.0f);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
}

}  // namespace

void draw_messages(const State& state, float bottom) {
  std::vector<std::string> lines;
  if (state.version) {
    if (!state.version->error.empty()) lines.push_back(state.version->error);
    if (state.shows_messages) {
      lines.insert(lines.end(), state.version->messages.begin(), state.version->messages.end());
    }
  }
  if (state.painting && !state.painting->error.empty()) lines.push_back(state.painting->error);
  if (lines.empty()) return;
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const float width = std::max(display.x - 20, 50.0f);
  ImGui::SetNextWindowPos({10, bottom - 8}, ImGuiCond_Always, {0, 1});
  ImGui::SetNextWindowSizeConstraints({width, 0}, {width, display.y / 2});
  ImGui::SetNextWindowBgAlpha(0.85f);
  if (ImGui::Begin("##messages", nullptr, kOverlay & ~ImGuiWindowFlags_NoScrollbar)) {
    for (const std::string& line : lines) colored_text(color_of_line(line), line);
  }
  ImGui::End();
}

}  // namespace window
