#include <array>
#include <string_view>

#include "fonts/font_face.hpp"

namespace frontend {
namespace {

constexpr uint32_t kReplacement = 0xFFFD;
constexpr uint32_t kLastCodePoint = 0x10FFFF;

/// Takes the first letter off the text; `kReplacement` for a byte that begins none.
uint32_t take_letter(std::string_view& text) {
  const auto byte = [&](size_t i) { return static_cast<unsigned char>(text[i]); };
  struct Lead {
    unsigned mask, bits;
    size_t length;
    uint32_t least;  // a letter with fewer bytes is written so
  };
  static constexpr std::array<Lead, 4> kLeads = {{{0x80, 0x00, 1, 0},
                                                  {0xE0, 0xC0, 2, 0x80},
                                                  {0xF0, 0xE0, 3, 0x800},
                                                  {0xF8, 0xF0, 4, 0x10000}}};
  for (const Lead& lead : kLeads) {
    if ((byte(0) & lead.mask) != lead.bits || text.size() < lead.length) continue;
    uint32_t letter = byte(0) & ~lead.mask & 0xFFu;
    bool is_whole = true;
    for (size_t i = 1; i < lead.length; ++i) {
      is_whole = is_whole && (byte(i) & 0xC0u) == 0x80;
      letter = letter << 6 | (byte(i) & 0x3Fu);
    }
    const bool is_surrogate = letter >= 0xD800 && letter < 0xE000;
    if (!is_whole || letter < lead.least || letter > kLastCodePoint || is_surrogate) break;
    text.remove_prefix(lead.length);
    return letter;
  }
  text.remove_prefix(1);
  return kReplacement;
}

std::vector<uint32_t> letters_of(std::string_view text) {
  std::vector<uint32_t> letters;
  letters.reserve(text.size());
  while (!text.empty()) letters.push_back(take_letter(text));
  return letters;
}

/// Returns the only script of the letters, but for those that are of all scripts.
hb_script_t shared_script(const FontLibraries::HarfBuzz& hb, const std::vector<uint32_t>& letters) {
  hb_unicode_funcs_t* const unicode = hb.unicode_funcs_get_default();
  hb_script_t shared = HB_SCRIPT_INVALID;
  for (const uint32_t letter : letters) {
    const hb_script_t script = hb.unicode_script(unicode, letter);
    if (script == HB_SCRIPT_COMMON || script == HB_SCRIPT_INHERITED) continue;
    if (shared != HB_SCRIPT_INVALID && script != shared) return HB_SCRIPT_INVALID;
    shared = script;
  }
  return shared;
}

int length_of(const std::string& word) { return static_cast<int>(word.size()); }

}  // namespace

TextRun run_of(const FontLibraries& libraries, const TextLetters& text) {
  const FontLibraries::HarfBuzz& hb = libraries.harfbuzz;
  TextRun run;
  run.letters = letters_of(text.text);
  run.script = text.script.empty()
                   ? shared_script(hb, run.letters)
                   : hb.script_from_string(text.script.data(), length_of(text.script));
  run.language = hb.language_from_string(text.language.data(), length_of(text.language));
  run.direction = hb.direction_from_string(text.direction.data(), length_of(text.direction));
  if (run.direction == HB_DIRECTION_INVALID) {
    run.direction = hb.script_get_horizontal_direction(run.script);
  }
  if (run.direction == HB_DIRECTION_INVALID) run.direction = HB_DIRECTION_LTR;
  return run;
}

}  // namespace frontend
