// The letters of a design's texts.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "fonts/text_layout.hpp"

namespace frontend {

/// A text's letters, or why there are none; and what its font is.
struct DrawnText {
  enum class Problem : uint8_t {
    kNone,
    kNoLibraries,  // FreeType, HarfBuzz or fontconfig is not installed
    kNoFont,       // there is none, or it cannot be opened
  };
  Problem problem = Problem::kNone;
  std::vector<PlacedGlyph> glyphs;
  std::string font_family;
  std::string missing_family;  // the one that was asked for, if the font is of another
};

/// Loads the libraries and the list of fonts when the first text comes.
class DesignFonts {
 public:
  /// `files` returns the font files that the design brings along; it may be empty, and is called
  /// once at most.
  explicit DesignFonts(std::function<std::vector<std::string>()> files)
      : find_files_(std::move(files)) {}

  /// `pieces`: how many chords a curve becomes; 0: it stays a curve.
  DrawnText letters(const TextSettings& text, int pieces);

  /// The font files that the design brings along, where there was a text.
  const std::vector<std::string>& files() const { return files_; }

 private:
  std::function<std::vector<std::string>()> find_files_;
  std::vector<std::string> files_;
  bool are_used_ = false;
};

}  // namespace frontend
