// Font files that have letters which another font lacks.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace frontend {

struct LetterFont {
  std::string path;
  int index = 0;  // of the font in the file
  std::vector<char32_t> letters;
};

/// Returns TrueType or OpenType fonts that have these letters, each as many of the remaining ones
/// as any of this computer's fonts has, in fontconfig's order of preference. Letters that no font
/// has are left out. Reads fontconfig's settings anew, which takes some tens of milliseconds.
std::vector<LetterFont> fonts_with(std::span<const char32_t> letters);

}  // namespace frontend
