// Arguments of the 2D nodes, and of the extrusions, as OpenSCAD binds them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "csgcore/facets.hpp"
#include "csgcore/geometry.hpp"
#include "frontend/design_tree.hpp"
#include "lower/node_problems.hpp"
#include "plane/figure.hpp"
#include "plane/offset.hpp"

namespace frontend {

/// Square node → the rectangle; it may be empty, flat or infinite.
Rectangle read_square(const NodeTree& tree, const Node& node, NodeProblems& problems);

/// Polygon node → its paths, all of finite points, filled by the even-odd rule.
Polygons read_polygon(const NodeTree& tree, const Node& node, NodeProblems& problems);

/// $fn, $fa and $fs of a node.
csgcore::FacetSettings read_facet_settings(const NodeTree& tree, const Node& node);

struct OffsetArguments {
  double distance = 1;
  CornerStyle corners = CornerStyle::kRound;
  csgcore::FacetSettings facets;
};
OffsetArguments read_offset(const NodeTree& tree, const Node& node);

/// The sizes of a resize node: a plane figure has no z.
struct ResizeArguments {
  std::array<double, 3> size{};
  std::array<bool, 3> follows{};  // `auto`

  /// Returns the factors by which a box of that size is scaled, of the first `axes` axes; those of
  /// others are 1.
  csgcore::Vec3 factors(const csgcore::Vec3& box_size, int axes) const;
};
ResizeArguments read_resize(const NodeTree& tree, const Node& node);

/// Whether a projection node is a section; else it is a shadow.
bool read_cut(const NodeTree& tree, const Node& node);

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
};
LinearExtrudeArguments read_linear_extrude(const NodeTree& tree, const Node& node,
                                           NodeProblems& problems);

struct RotateExtrudeArguments {
  double angle = 360;  // from −360 to 360, the former exclusive; 0: nothing
  std::optional<double> start{};
  csgcore::FacetSettings facets;
};
RotateExtrudeArguments read_rotate_extrude(const NodeTree& tree, const Node& node);

}  // namespace frontend
