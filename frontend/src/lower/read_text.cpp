#include "lower/read_text.hpp"

#include <array>
#include <string>
#include <string_view>

#include "lower/argument_lookup.hpp"

namespace frontend {
namespace {

template <typename Align>
struct AlignWord {
  std::string_view word;
  Align align;
};
constexpr std::array<AlignWord<HorizontalAlign>, 3> kHorizontalWords = {
    {{"left", HorizontalAlign::kLeft},
     {"right", HorizontalAlign::kRight},
     {"center", HorizontalAlign::kCenter}}};
constexpr std::array<AlignWord<VerticalAlign>, 4> kVerticalWords = {
    {{"baseline", VerticalAlign::kBaseline},
     {"bottom", VerticalAlign::kBottom},
     {"top", VerticalAlign::kTop},
     {"center", VerticalAlign::kCenter}}};
/// OpenSCAD's development version writes this where nothing is said.
constexpr std::string_view kDefaultWord = "default";

std::string_view string_argument(const NodeTree& tree, const Node& node,
                                 language::ArgumentName name, size_t position = kByNameOnly) {
  const ArgumentValue value = find_argument(tree, node, name, position);
  return value.is_string() ? value.text() : std::string_view();
}

/// Returns the words as a sentence has them: "left", "right" or "center".
template <typename Words>
std::string listed(const Words& words) {
  std::string text;
  for (size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 < words.size() ? ", " : " or ";
    text += '"' + std::string(words[i].word) + '"';
  }
  return text;
}

/// The first of the words is the default.
template <typename Words>
auto align_argument(const NodeTree& tree, const Node& node, language::ArgumentName name,
                    const Words& words, NodeProblems& problems) {
  const std::string_view given = string_argument(tree, node, name);
  for (const auto& known : words) {
    if (given == known.word) return known.align;
  }
  if (!given.empty() && given != kDefaultWord) {
    problems.add(node, {": Unknown value for the " + std::string(name.text()) + " parameter (use " +
                            listed(words) + "): '" + std::string(given) + "'",
                        "it counts as missing"});
  }
  return words.front().align;
}

}  // namespace

TextSettings read_text(const NodeTree& tree, const Node& node, NodeProblems& problems) {
  TextSettings result;
  result.letters.text = string_argument(tree, node, "text", 0);
  result.size = number_argument(tree, node, "size", 1).value_or(result.size);
  result.font = string_argument(tree, node, "font", 2);
  result.spacing = number_argument(tree, node, "spacing").value_or(result.spacing);
  result.letters.direction = string_argument(tree, node, "direction");
  result.letters.script = string_argument(tree, node, "script");
  result.letters.language = string_argument(tree, node, "language");
  if (result.letters.language.empty()) result.letters.language = "en";
  result.halign = align_argument(tree, node, "halign", kHorizontalWords, problems);
  result.valign = align_argument(tree, node, "valign", kVerticalWords, problems);
  return result;
}

std::vector<PlacedGlyph> letters_of(const Node& node, const TextSettings& text, int pieces,
                                    DesignFonts& fonts, NodeProblems& problems) {
  DrawnText drawn = fonts.letters(text, pieces);
  switch (drawn.problem) {
    case DrawnText::Problem::kNoLibraries:
      problems.add(node, {" is left out: FreeType, HarfBuzz or fontconfig is not installed",
                          "install libfreetype6, libharfbuzz0b and libfontconfig1"});
      break;
    case DrawnText::Problem::kNoFont:
      problems.add(node, {" is left out: no font can be opened for '" + text.font + "'",
                          "install a font with outlines"});
      break;
    case DrawnText::Problem::kNone:
      if (drawn.missing_family.empty()) break;
      problems.add(node, {": the font '" + drawn.missing_family + "' is not installed: '" +
                              drawn.font_family + "' stands in for it",
                          "install it, or name its file in use <…>", true});
      break;
  }
  return std::move(drawn.glyphs);
}

}  // namespace frontend
