// What the arguments of a node say, whatever node stands above it.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "arguments/file_arguments.hpp"
#include "arguments/file_matrix.hpp"
#include "arguments/round_node.hpp"
#include "csgcore/geometry.hpp"
#include "fonts/text_layout.hpp"
#include "meshes/face_set.hpp"
#include "plane/figure.hpp"
#include "plane/offset.hpp"

namespace frontend {

/// What the figure of a circle, square or polygon node is in its own coordinates.
struct FigureNode {
  /// Nothing: it is empty. A circle is a disc, or OpenSCAD's polygon if its facets are kept.
  std::optional<Figure> figure;
  /// Of a circle: OpenSCAD's polygon, whose box it draws a picture of. 0: not a circle.
  int fragments = 0;
};

/// The letters of a text node, whose union it is; none: it is empty.
struct TextNode {
  std::vector<PlacedGlyph> letters;
};

/// The sizes of a resize node: a plane figure has no z.
struct ResizeArguments {
  std::array<double, 3> size{};
  std::array<bool, 3> follows{};  // `auto`
};

struct LinearExtrudeArguments {
  double height = 100;  // ≤ 0: nothing
  bool is_centered = false;
  /// Returns the height of the bottom.
  double z_min() const { return is_centered ? -height / 2 : 0; }
  double twist = 0;                // degrees, clockwise
  Vec2 top_scale{1.0};             // ≥ 0
  Vec2 lean{0.0};                  // how far the top is moved against the bottom
  std::optional<double> slices{};  // ≥ 1
  std::optional<double> segments{};
  csgcore::FacetSettings facets;
  bool cuts_edges = false;  // GeometryDialect::cuts_twisted_edges
};
struct RotateExtrudeArguments {
  double angle = 360;  // from −360 to 360, the former exclusive; 0: nothing
  std::optional<double> start{};
  csgcore::FacetSettings facets;
};
struct LinearExtrudeNode {
  LinearExtrudeArguments arguments;
  bool is_faceted = false;  // a twisted one has OpenSCAD's slices
  /// What is needed is the surface: figures are united in the plane, which takes less time than the
  /// same operations on prisms.
  bool unites_figures = false;
};

struct RotateExtrudeNode {
  RotateExtrudeArguments arguments;
  bool is_faceted = false;
};

struct RoofNode {
  bool is_straight = false;  // by the straight skeleton; else by the distance from the outline
  csgcore::FacetSettings facets;
  bool is_faceted = false;  // its cones have OpenSCAD's number of facets
};

struct ProjectionNode {
  bool is_cut = false;  // it is a section; else it is a shadow
};

/// What a color node sets: nothing if it says nothing.
using NodeColor = std::optional<csgcore::Color>;

/// Returns the colour within color(): the outermost one counts that has all of its channels.
/// OpenSCAD takes those that are missing of the scheme.
inline NodeColor inner_color(const NodeColor& outer, const NodeColor& own) {
  const bool is_whole = outer && outer->r >= 0 && outer->g >= 0 && outer->b >= 0;
  return is_whole ? outer : own;
}

/// Of a cube its box, of a polyhedron its faces. Nothing for a node whose arguments do not matter.
using NodeData =
    std::variant<std::monostate, RoundNode, csgcore::Box, std::shared_ptr<const FaceSet>,
                 FileArguments, FigureNode, TextNode, FileMatrix, NodeColor, OffsetSettings,
                 ResizeArguments, LinearExtrudeNode, RotateExtrudeNode, RoofNode, ProjectionNode>;

}  // namespace frontend
