#include "fonts/letter_fonts.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <string_view>

#include "fonts/font_libraries.hpp"

namespace frontend {
namespace {

using Fontconfig = FontLibraries::Fontconfig;

template <typename Object>
using Owned = std::unique_ptr<Object, void (*)(Object*)>;

/// Returns whether the font is of a format that every reader of fonts knows.
bool is_usual(const Fontconfig& fc, FcPattern* font) {
  FcChar8* text = nullptr;
  if (fc.pattern_get_string(font, FC_FONTFORMAT, 0, &text) != FcResultMatch) return false;
  const std::string_view format(reinterpret_cast<const char*>(text));
  return format == "TrueType" || format == "CFF";
}

/// Returns the font that has most of the letters; nothing if none has any.
std::optional<LetterFont> best_font(const Fontconfig& fc, FcConfig* config,
                                    std::span<const char32_t> letters) {
  const Owned<FcCharSet> wanted(fc.charset_create(), fc.charset_destroy);
  const Owned<FcPattern> asked(fc.name_parse(reinterpret_cast<const FcChar8*>("sans-serif")),
                               fc.pattern_destroy);
  if (!wanted || !asked) return std::nullopt;
  for (const char32_t letter : letters) fc.charset_add_char(wanted.get(), letter);
  fc.pattern_add_charset(asked.get(), FC_CHARSET, wanted.get());
  fc.pattern_add_bool(asked.get(), FC_SCALABLE, FcTrue);
  fc.pattern_add_bool(asked.get(), FC_OUTLINE, FcTrue);
  fc.config_substitute(config, asked.get(), FcMatchPattern);
  fc.default_substitute(asked.get());
  FcResult outcome = FcResultNoMatch;
  const Owned<FcPattern> best(fc.font_match(config, asked.get(), &outcome), fc.pattern_destroy);
  if (!best || !is_usual(fc, best.get())) return std::nullopt;
  FcChar8* path = nullptr;
  FcCharSet* has = nullptr;
  LetterFont font;
  if (fc.pattern_get_string(best.get(), FC_FILE, 0, &path) != FcResultMatch ||
      fc.pattern_get_charset(best.get(), FC_CHARSET, 0, &has) != FcResultMatch) {
    return std::nullopt;
  }
  font.path = reinterpret_cast<const char*>(path);
  fc.pattern_get_integer(best.get(), FC_INDEX, 0, &font.index);
  for (const char32_t letter : letters) {
    if (fc.charset_has_char(has, letter) == FcTrue) font.letters.push_back(letter);
  }
  if (font.letters.empty()) return std::nullopt;
  return font;
}

}  // namespace

std::vector<LetterFont> fonts_with(std::span<const char32_t> letters) {
  std::vector<LetterFont> fonts;
  const FontLibraries* const libraries = font_libraries();
  if (libraries == nullptr) return fonts;
  const Fontconfig& fc = libraries->fontconfig;
  const Owned<FcConfig> config(fc.load_fonts(), fc.config_destroy);
  if (!config) return fonts;
  std::vector<char32_t> left(letters.begin(), letters.end());
  while (!left.empty()) {
    std::optional<LetterFont> font = best_font(fc, config.get(), left);
    if (!font) break;
    std::erase_if(left, [&](char32_t letter) {
      return std::find(font->letters.begin(), font->letters.end(), letter) != font->letters.end();
    });
    fonts.push_back(*std::move(font));
  }
  return fonts;
}

}  // namespace frontend
