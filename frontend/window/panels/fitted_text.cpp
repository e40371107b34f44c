#include "panels/fitted_text.hpp"

#include <imgui.h>

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

}  // namespace window
