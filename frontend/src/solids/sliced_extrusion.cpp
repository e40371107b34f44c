#include "solids/sliced_extrusion.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/angles.hpp"
#include "solids/sliced_solid.hpp"
#include "solids/smooth_slices.hpp"

namespace frontend {
namespace {

double reach_of_figures(std::span<const Figure> figures) {
  Rectangle bounds;
  for (const Figure& figure : figures) bounds.merge(bounds_of(figure));
  return bounds.empty() ? 0 : std::max(glm::length(bounds.min), glm::length(bounds.max));
}

/// A round outline with flat sides has at least as many chords as there are slices in a turn.
Chords chords_for(const TwistedLayers& layers, const std::optional<double>& slices, double reach) {
  const double tolerance = smooth_tolerance(layers, reach);
  if (!has_flat_sides(layers, reach)) return {kSmoothChords, tolerance};
  const double turns = layers.turn() / kTurn;
  const auto in_a_turn =
      static_cast<int>(std::min(std::ceil(slices.value_or(1) / turns), double{kChordsOfCircle}));
  return {std::max(in_a_turn, kSmoothChords), tolerance, std::max(in_a_turn, Chords{}.fewest)};
}

}  // namespace

TwistedLayers layers_of(const LinearExtrudeArguments& arguments) {
  TwistedLayers layers;
  layers.z_min = arguments.z_min();
  layers.z_max = layers.z_min + arguments.height;
  layers.twist = arguments.twist;
  layers.top_scale = arguments.top_scale;
  return layers;
}

csgcore::Affine leaning(const LinearExtrudeArguments& arguments) {
  csgcore::Affine map;
  map.linear[2] = csgcore::Vec3(arguments.lean / arguments.height, 1);
  return map;
}

std::optional<SlicedExtrusion> sliced_extrusion(const LinearExtrudeNode& data, const Node& node,
                                                std::span<const Figure> figures,
                                                NodeProblems& problems) {
  const LinearExtrudeArguments& given = data.arguments;
  const TwistedLayers layers = layers_of(given);
  std::optional<SimplePolygons> outline =
      united(figures, chords_for(layers, given.slices, reach_of_figures(figures)));
  if (!outline) {
    problems.add(node,
                 {" is left out: its edges cross too often", "let its outline not cross itself"});
    return std::nullopt;
  }
  if (outline->empty()) return std::nullopt;
  // Where sides turn, a corner that only rounding has made would show as a stripe.
  if (std::ranges::all_of(figures, is_polygonal)) {
    outline = without_slight_corners(*outline, kOpenScadsRounding);
  }
  const double slices =
      given.slices ? *given.slices : slice_count(layers, *outline, given.facets, given.cuts_edges);
  // Smooth sides have pieces of their own.
  Slicing slicing = given.cuts_edges && data.is_faceted
                        ? cut_slicing(layers, slices, given.segments, given.facets, *outline)
                        : openscad_slicing(slices, given.segments, *outline);
  if (slicing.slices < slices) {
    problems.add(node, {" is drawn with " + std::to_string(slicing.slices) +
                            " slices: more would be too many triangles",
                        "give fewer slices, or a simpler outline"});
  }
  const csgcore::Box box = sliced_box(layers, slicing.slices, *outline);
  if (!data.is_faceted) slicing = smooth_slicing(layers, slices, std::move(*outline));
  SlicedExtrusion result{sliced_mesh(layers, slicing), folded_sides(layers, slicing), box};
  if (!result.sheets.empty()) {
    problems.add(node, {" turns by half a turn in a slice, where its sides cross themselves",
                        "give it more slices"});
  }
  return result;
}

}  // namespace frontend
