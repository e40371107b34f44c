// The letters of the window's texts.
#pragma once

#include <imgui.h>

#include <set>
#include <string_view>
#include <vector>

#include "fonts/letter_fonts.hpp"

namespace window {

/// Gives ImGui a font for most texts, and the letters that others need when they come. There is one
/// at a time, which needs ImGui's context.
class Letters {
 public:
  explicit Letters(float scale);

  /// Notes the letters of a text in UTF-8 that is to be shown.
  void need(std::string_view text);
  /// Looks the letters up that are needed and not there yet. Returns whether there are new ones,
  /// whose texture is to be made. Not to be called within a frame.
  bool load();

 private:
  bool has_from_start(char32_t letter) const;
  void add_fonts();

  const float scale_;
  bool has_first_font_ = false;  // else ImGui's own stands in
  std::set<char32_t> known_;     // beyond those of the first font: loaded, or nowhere to be found
  std::vector<char32_t> missing_;
  std::vector<frontend::LetterFont> fonts_;
  std::vector<std::vector<ImWchar>> ranges_;  // of fonts_, which ImGui reads from here
};

}  // namespace window
