// What linear_extrude and rotate_extrude nodes say.
#pragma once

#include <optional>

#include "csgcore/facets.hpp"
#include "csgcore/geometry.hpp"
#include "nodes/node_reader.hpp"
#include "plane/figure.hpp"

namespace frontend {

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
struct RotateExtrudeArguments {
  double angle = 360;  // from −360 to 360, the former exclusive; 0: nothing
  std::optional<double> start{};
  csgcore::FacetSettings facets;
};
struct LinearExtrudeNode {
  LinearExtrudeArguments arguments;
  bool is_faceted = false;  // a twisted one has OpenSCAD's slices
};

struct RotateExtrudeNode {
  RotateExtrudeArguments arguments;
  bool is_faceted = false;
};

LinearExtrudeArguments read_linear_extrude(NodeReader& reader);

}  // namespace frontend
