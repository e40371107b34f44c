#include <algorithm>
#include <array>

#include "language/color_names.hpp"
#include "subtrees/node_row.hpp"
#include "subtrees/subtree_evaluation.hpp"

namespace frontend {
namespace {

/// −1 or any other negative channel marks an invalid colour; nan compares false, so it is one too.
/// A channel far beyond what any light shows as white.
constexpr double kBrightestChannel = 1000;

/// Channels that are negative, or no numbers, are the scheme's; none of them is the colour's: no
/// colour.
std::optional<csgcore::Color> color_of_channels(const std::array<double, 4>& channels) {
  std::array<float, 4> result;
  bool has_own = false;
  for (size_t i = 0; i < 3; ++i) {
    const bool is_own = channels[i] >= 0;
    result[i] = is_own ? static_cast<float>(std::min(channels[i], kBrightestChannel)) : -1.0f;
    has_own = has_own || is_own;
  }
  const bool has_alpha = channels[3] >= 0 && channels[3] < 1;
  result[3] = has_alpha ? static_cast<float>(channels[3]) : 1.0f;
  if (!has_own && !has_alpha) return std::nullopt;
  return csgcore::Color{result[0], result[1], result[2], result[3]};
}

/// None if the colour is invalid (in a .csg: -1,-1,-1,±1), which for a name that is no colour is a
/// problem. Channels above 1 count as 1.
NodeColor read_color(NodeReader& reader) {
  const ArgumentValue color = reader.find("c", 0);
  if (color.is_undef()) return std::nullopt;
  std::array<double, 4> channels{1, 1, 1, 1};  // OpenSCAD's for those that are missing
  if (color.is_list()) {
    const ValueList elements = color.elements();
    for (size_t i = 0; i < std::min<size_t>(elements.size(), 4); ++i) {
      if (elements[i].is_number()) {
        channels[i] = elements[i].number();
        continue;
      }
      channels[i] = 0;  // as OpenSCAD reads it
      if (elements[i].is_undef()) continue;
      reader.tell_wrong("a channel", std::string(name_of(elements[i].kind())), "counts as 0",
                        "a number from 0 to 1");
    }
  } else if (color.is_string()) {
    const std::optional<std::array<float, 4>> named = language::color_of_name(color.text());
    if (!named) {
      reader.tell({": \"" + std::string(color.text()) + "\" is no colour, and is ignored",
                   "use a CSS colour name, \"#rrggbb\" or [r, g, b]"});
      return std::nullopt;
    }
    std::copy(named->begin(), named->end(), channels.begin());
  } else {
    reader.tell_wrong_type("the colour", color, "a list of numbers or a name");
    return std::nullopt;
  }
  const ArgumentValue alpha = reader.find("alpha", 1);
  if (alpha.is_number()) {
    channels[3] = alpha.number();
  } else {
    reader.tell_wrong_type("alpha", alpha, "a number from 0 to 1");
  }
  return color_of_channels(channels);
}

SolidValue colored(SubtreeEvaluation& evaluation, uint32_t node) {
  SolidValue result = combined(csgcore::Op::kUnion, evaluation.solids_of_operands(node));
  if (evaluation.keeps_colors()) {
    const NodeColor& own = evaluation.data<NodeColor>(node);
    for (SolidPart& part : result.parts) part.color = inner_color(own, part.color);
  }
  return result;
}

}  // namespace

const NodeRow kColorRow{
    .role = Role::kOperation,
    .inner_parts = InnerParts::kOfMembers,
    .read = [](NodeReader& reader, const NodeSources&) -> NodeData { return read_color(reader); },
    .solid = colored,
};

}  // namespace frontend
