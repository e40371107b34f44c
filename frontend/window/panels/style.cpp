#include "panels/style.hpp"

#include <imgui.h>

#include <algorithm>

namespace window {

float text_width(const std::string& text) { return ImGui::CalcTextSize(text.c_str()).x; }

std::string cut_to(std::string text, float width) {
  if (text_width(text) <= width) return text;
  const auto continues = [&] { return (static_cast<unsigned char>(text.back()) & 0xC0) == 0x80; };
  while (!text.empty() && text_width(text + "…") > width) {
    while (text.size() > 1 && continues()) text.pop_back();
    text.pop_back();
  }
  return text + "…";
}

bool text_line(ImU32 color, const std::string& text, bool has_place) {
  const float room = std::max(ImGui::GetContentRegionAvail().x, 1.0f);
  const char* const begin = text.data();
  const char* const end = begin + text.size();
  const ImVec2 size = ImGui::CalcTextSize(begin, end, false, room);
  const bool is_chosen =
      ImGui::InvisibleButton("##line", {std::max(size.x, 1.0f), std::max(size.y, 1.0f)});
  const ImVec2 from = ImGui::GetItemRectMin(), to = ImGui::GetItemRectMax();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddText(ImGui::GetFont(), ImGui::GetFontSize(), from, color, begin, end, room);
  if (has_place && ImGui::IsItemHovered()) list.AddLine({from.x, to.y}, to, color);
  if (ImGui::IsItemFocused() && ImGui::GetIO().NavVisible) {
    list.AddRect({from.x - 2, from.y - 1}, {to.x + 2, to.y + 1},
                 ImGui::GetColorU32(ImGuiCol_NavHighlight));
  }
  return is_chosen && has_place;
}

}  // namespace window
