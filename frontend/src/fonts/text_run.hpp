// A text as HarfBuzz takes it: its letters, and how they run.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fonts/font_libraries.hpp"

namespace frontend {

/// What a text node says of its letters. An empty word means that it says nothing.
struct TextLetters {
  std::string text;  // in UTF-8
  std::string direction, script, language;
};

struct TextRun {
  std::vector<uint32_t> letters;  // code points
  hb_direction_t direction = HB_DIRECTION_LTR;
  hb_script_t script = HB_SCRIPT_UNKNOWN;
  hb_language_t language = nullptr;

  bool is_vertical() const { return HB_DIRECTION_IS_VERTICAL(direction); }
};

/// Returns the letters, with the script that all of them share, where none is given, and the
/// direction of the script (text_layout.hpp). Bytes that are no UTF-8 are replaced.
TextRun run_of(const FontLibraries& libraries, const TextLetters& text);

}  // namespace frontend
