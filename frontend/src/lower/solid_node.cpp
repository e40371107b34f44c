#include "lower/solid_node.hpp"

#include <utility>

#include "lower/read_drawing.hpp"

namespace frontend {

SolidNode read_solid_node(const NodeTree& tree, const Node& node, const ImportOptions& options,
                          NodeProblems& problems) {
  switch (node.kind) {
    case NodeKind::kSphere:
    case NodeKind::kCylinder: {
      RoundPrimitive round = read_round_primitive(tree, node, problems);
      if (options.fn) round.facets.fn = *options.fn;
      return RoundNode{std::move(round.primitive), round.facets};
    }
    case NodeKind::kCube:
      return read_cube(tree, node, problems);
    case NodeKind::kPolyhedron:
      return std::make_shared<const FaceSet>(read_polyhedron(tree, node, problems));
    case NodeKind::kImport:
      if (names_drawing(tree, node)) return std::monostate();
      [[fallthrough]];
    case NodeKind::kSurface:
      return read_file_arguments(tree, node, problems);
    case NodeKind::kMultmatrix: {
      NodeProblems told;  // read_matrix() of the same node tells the subtree's
      return read_matrix(tree, node, told);
    }
    case NodeKind::kColor: {
      NodeProblems told;  // a color within a solid of one colour counts for its `%` parts only
      return read_color(tree, node, told);
    }
    default:
      return std::monostate();
  }
}

}  // namespace frontend
