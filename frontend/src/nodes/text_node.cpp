#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "base/geometry_dialect.hpp"
#include "subtrees/node_row.hpp"

namespace frontend {
namespace {

constexpr language::ArgumentName kTextLabel[] = {"text"};

/// OpenSCAD's development version writes this where nothing is said.
constexpr std::string_view kDefaultWord = "default";

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

template <typename Align, size_t kCount>
Align read_alignment(NodeReader& reader, language::ArgumentName name,
                     const std::array<AlignWord<Align>, kCount>& words) {
  const std::string_view given = reader.text(name);
  const Align align = align_of(given, words);
  if (align == Align::kDefault && !given.empty() && given != kDefaultWord) {
    reader.tell({": Unknown value for the " + std::string(name.text()) + " parameter (use " +
                     listed(words) + "): '" + std::string(given) + "'",
                 "it counts as missing"});
  }
  return align;
}

/// A text that is no string is empty.
TextSettings read_settings(NodeReader& reader, const GeometryDialect& dialect) {
  TextSettings result;
  result.letters.text = reader.text("text", 0);
  result.size = reader.number("size", 1).value_or(result.size);
  result.font = reader.text("font", 2);
  result.spacing = reader.number("spacing").value_or(result.spacing);
  result.letters.direction = reader.text("direction");
  result.letters.script = reader.text("script");
  result.letters.language = reader.text("language");
  if (result.letters.language.empty()) result.letters.language = "en";
  result.halign = read_alignment(reader, "halign", kHorizontalWords);
  result.valign = read_alignment(reader, "valign", kVerticalWords);
  result.is_placed_exactly = dialect.places_letters_exactly;
  result.has_features = dialect.has_font_features;
  return result;
}

/// The letters that have ink. It tells which font stands in for one that is missing. `pieces`: how
/// many chords a curve becomes; 0: it stays a curve.
std::vector<PlacedGlyph> letters_of(NodeReader& reader, const TextSettings& text, int pieces,
                                    DesignFonts& fonts) {
  DrawnText drawn = fonts.letters(text, pieces);
  switch (drawn.problem) {
    case DrawnText::Problem::kNoLibraries:
      reader.tell({" is left out: FreeType, HarfBuzz or fontconfig is not installed",
                   "install libfreetype6, libharfbuzz0b and libfontconfig1"});
      break;
    case DrawnText::Problem::kNoFont:
      reader.tell({" is left out: no font can be opened for '" + text.font + "'",
                   "install a font with outlines"});
      break;
    case DrawnText::Problem::kNone:
      if (drawn.missing_family.empty()) break;
      reader.tell({": the font '" + drawn.missing_family + "' is not installed: '" +
                       drawn.font_family + "' stands in for it",
                   "install it, or name its file in use <…>", true});
      break;
  }
  return std::move(drawn.glyphs);
}

/// OpenSCAD's chords of a curve in a text; 0: it is kept.
int pieces_of_curves(const csgcore::FacetSettings& facets, double size,
                     const ImportOptions& options) {
  const int fragments = csgcore::fragment_count(size, facets);
  if (!keeps_facets(options, facets) || fragments > kMostFragments) return 0;
  constexpr int kFragmentsOfPiece = 8, kFewestPieces = 2;
  return std::max(kFewestPieces, fragments / kFragmentsOfPiece + 1);
}

TextNode read_text(NodeReader& reader, const NodeSources& sources) {
  const TextSettings text = read_settings(reader, GeometryDialect(sources.options.language));
  const csgcore::FacetSettings facets = chosen(sources, reader.facets());
  const int pieces = pieces_of_curves(facets, text.size, sources.options);
  return {letters_of(reader, text, pieces, sources.fonts)};
}

}  // namespace

const NodeRow kTextRow{
    .role = Role::kWhole,
    .dimension = 2,
    .label = kTextLabel,
    .read = [](NodeReader& reader, const NodeSources& sources) -> NodeData {
      return read_text(reader, sources);
    },
};

}  // namespace frontend
