#include "preview_light.hpp"

#include <algorithm>
#include <vector>

#include "statements.hpp"
#include "workspace.hpp"

namespace serve {
namespace {

using csgcore::Color;
using frontend::Rgb;

/// How far the colour of what is dimmed goes towards the background's.
constexpr float kDimmed = 0.8f;

constexpr float kFullLevel = 255;

/// Returns, by node, whether it stands in the statement, or in or around a node that does.
std::vector<bool> nodes_of(const language::NodeTree& tree, language::FileId file, Span statement) {
  std::vector<bool> lit(tree.size());
  std::vector<uint32_t> before(tree.size() + 1);  // how many nodes of the statement stand before
  uint32_t within = 0;                            // the end of the last of them
  for (uint32_t i = 0; i < tree.size(); ++i) {
    const language::Place place = tree.nodes[i].place;
    const bool is_own =
        place.file == file && statement.begin <= place.offset && place.offset < statement.end;
    before[i + 1] = before[i] + (is_own ? 1 : 0);
    if (is_own) within = std::max(within, tree.nodes[i].end);
    lit[i] = i < within;
  }
  for (uint32_t i = 0; i < tree.size(); ++i)
    if (before[tree.nodes[i].end] > before[i]) lit[i] = true;
  return lit;
}

Color dimmed(const Color& color, const Rgb& background) {
  const auto mix = [](float from, uint8_t to) {
    return from + kDimmed * (static_cast<float>(to) / kFullLevel - from);
  };
  return {mix(color.r, background.r), mix(color.g, background.g), mix(color.b, background.b),
          color.a};
}

}  // namespace

Color shown_color(const csgcore::Primitive& primitive, const frontend::ColorScheme& scheme) {
  const Rgb face = primitive.cut_faces == csgcore::CutFaces::kAlways ? scheme.back : scheme.front;
  const Color given = primitive.color.value_or(Color{-1, -1, -1, 1});
  const auto channel = [](float own, uint8_t of_scheme) {
    return own < 0 ? static_cast<float>(of_scheme) / kFullLevel : own;
  };
  return {channel(given.r, face.r), channel(given.g, face.g), channel(given.b, face.b), given.a};
}

std::shared_ptr<const csgcore::Scene> lit_scene(const frontend::ImportedDesign& design,
                                                const frontend::DesignTree& tree,
                                                language::FileId file, std::size_t offset,
                                                const frontend::ColorScheme& scheme) {
  const auto statement = Statements(own_text((*tree.files)[file].text)).around(offset);
  if (!statement) return nullptr;
  const std::vector<bool> lit = nodes_of(*tree.nodes, file, *statement);
  const auto is_lit = [&](const csgcore::Primitive& primitive) {
    return lit[design.places.at(primitive.id)];
  };
  const auto& primitives = design.scene.primitives;
  if (std::ranges::none_of(primitives, is_lit) || std::ranges::all_of(primitives, is_lit))
    return nullptr;
  auto scene = std::make_shared<csgcore::Scene>(design.scene);
  for (csgcore::Primitive& primitive : scene->primitives) {
    if (is_lit(primitive)) continue;
    primitive.color = dimmed(shown_color(primitive, scheme), scheme.background);
  }
  return scene;
}

}  // namespace serve
