#include "letters.hpp"

#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <system_error>

namespace window {
namespace {

constexpr float kFontSize = 15;     // units
constexpr float kOwnFontSize = 13;  // of ImGui's own font, whose pixels are drawn for it

/// A font with letters beyond ASCII, which file names may have. Without it ImGui's own font is
/// used.
constexpr const char* kFont = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
/// Its letters: Latin, Greek, Cyrillic, and the signs of texts and measures. Pairs of first and
/// last.
constexpr ImWchar kLetters[] = {0x0020, 0x024F, 0x0370, 0x052F, 0x2010, 0x2044, 0x20AC,
                                0x20AC, 0x2190, 0x2195, 0x2200, 0x2265, 0};
constexpr char32_t kLastOfOwnFont = 0xFF;

}  // namespace

Letters::Letters(float scale) : scale_(scale) {
  std::error_code missing;
  has_first_font_ = std::filesystem::exists(kFont, missing);
  add_fonts();
}

bool Letters::has_from_start(char32_t letter) const {
  if (!has_first_font_) return letter <= kLastOfOwnFont;
  for (const ImWchar* range = kLetters; *range != 0; range += 2) {
    if (letter >= range[0] && letter <= range[1]) return true;
  }
  return letter < kLetters[0];
}

void Letters::need(std::string_view text) {
  const char* const end = text.data() + text.size();
  for (const char* at = text.data(); at < end;) {
    if (static_cast<unsigned char>(*at) < 0x80) {
      ++at;
      continue;
    }
    unsigned int letter = 0;
    at += std::max(ImTextCharFromUtf8(&letter, at, end), 1);
    if (letter > IM_UNICODE_CODEPOINT_MAX || has_from_start(letter)) continue;
    if (known_.insert(letter).second) missing_.push_back(letter);
  }
}

bool Letters::load() {
  if (missing_.empty()) return false;
  const std::vector<frontend::LetterFont> found = frontend::fonts_with(missing_);
  missing_.clear();
  if (found.empty()) return false;
  for (const frontend::LetterFont& font : found) {
    const auto same = std::find_if(fonts_.begin(), fonts_.end(), [&](const auto& other) {
      return other.path == font.path && other.index == font.index;
    });
    if (same == fonts_.end()) {
      fonts_.push_back(font);
    } else {
      same->letters.insert(same->letters.end(), font.letters.begin(), font.letters.end());
    }
  }
  ImGui::GetIO().Fonts->Clear();
  add_fonts();
  return true;
}

void Letters::add_fonts() {
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  const float size_px = std::round(kFontSize * scale_);
  if (has_first_font_) {
    atlas.AddFontFromFileTTF(kFont, size_px, nullptr, kLetters);
  } else {
    ImFontConfig own;
    own.SizePixels = std::round(kOwnFontSize * scale_);
    atlas.AddFontDefault(&own);
  }
  ranges_.clear();
  for (const frontend::LetterFont& font : fonts_) {
    std::vector<ImWchar>& ranges = ranges_.emplace_back();
    for (const char32_t letter : font.letters) {
      ranges.insert(ranges.end(), 2, static_cast<ImWchar>(letter));
    }
    ranges.push_back(0);
  }
  for (std::size_t i = 0; i < fonts_.size(); ++i) {
    ImFontConfig added;
    added.MergeMode = true;
    added.FontNo = fonts_[i].index;
    added.OversampleH = 1;  // such letters are wide, and may be many
    std::error_code missing;
    if (!std::filesystem::exists(fonts_[i].path, missing)) continue;
    atlas.AddFontFromFileTTF(fonts_[i].path.c_str(), size_px, &added, ranges_[i].data());
  }
}

}  // namespace window
