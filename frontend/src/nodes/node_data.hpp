// What the arguments of a node say, whatever node stands above it.
#pragma once

#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "csgcore/geometry.hpp"
#include "fonts/text_layout.hpp"
#include "meshes/face_set.hpp"
#include "nodes/color.hpp"
#include "nodes/extrusion_arguments.hpp"
#include "nodes/file_arguments.hpp"
#include "nodes/multmatrix.hpp"
#include "nodes/resize.hpp"
#include "nodes/round.hpp"
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

struct ProjectionNode {
  bool is_cut = false;  // it is a section; else it is a shadow
};

/// Of a cube its box, of a polyhedron its faces. Nothing for a node whose arguments do not matter.
using NodeData =
    std::variant<std::monostate, RoundNode, csgcore::Box, std::shared_ptr<const FaceSet>,
                 FileArguments, FigureNode, TextNode, FileMatrix, NodeColor, OffsetSettings,
                 ResizeArguments, LinearExtrudeNode, RotateExtrudeNode, ProjectionNode>;

}  // namespace frontend
