// What the nodes of solids say within a subtree that OpenSCAD evaluates as a whole.
#pragma once

#include <memory>
#include <optional>
#include <variant>

#include "csgcore/facets.hpp"
#include "csgcore/geometry.hpp"
#include "csgcore/primitive.hpp"
#include "frontend/design_tree.hpp"
#include "frontend/import_options.hpp"
#include "lower/import_arguments.hpp"
#include "lower/node_problems.hpp"
#include "meshes/face_set.hpp"

namespace frontend {

/// A sphere or a cylinder. Its shape may be invalid: it is empty.
struct RoundNode {
  csgcore::Primitive primitive;
  csgcore::FacetSettings facets;
};

/// What color() sets: nothing if it says nothing.
using NodeColor = std::optional<csgcore::Color>;

/// A cube's box, a polyhedron's faces, a file's name, a multmatrix, or a color. Nothing for other
/// nodes.
using SolidNode =
    std::variant<std::monostate, RoundNode, csgcore::Box, std::shared_ptr<const FaceSet>,
                 FileArguments, FileMatrix, NodeColor>;

/// Reads the node's arguments.
SolidNode read_solid_node(const NodeTree& tree, const Node& node, const ImportOptions& options,
                          NodeProblems& problems);

}  // namespace frontend
