#include "solids/solid_shape.hpp"

#include <utility>

namespace frontend {
namespace {

using csgcore::Primitive;

std::optional<SolidShape> shape_of_faces(const SolidOfFaces* faces, std::string file = {}) {
  if (faces == nullptr) return std::nullopt;
  SolidShape shape;
  shape.faces = faces;
  shape.file = std::move(file);
  if (!faces->is_empty()) shape.primitive = faces->under({});
  return shape;
}

std::optional<SolidShape> valid(SolidShape shape) {
  if (!csgcore::has_valid_shape(shape.primitive)) return std::nullopt;
  return shape;
}

}  // namespace

std::optional<SolidShape> solid_shape(const NodeData& data, const Node& node,
                                      const SolidSources& sources, NodeProblems& problems) {
  if (const auto* round = std::get_if<RoundNode>(&data)) {
    return valid({round->primitive, round->facets});
  }
  if (const auto* box = std::get_if<csgcore::Box>(&data)) {
    return valid({sources.polyhedra.box(*box, {})});
  }
  if (const auto* faces = std::get_if<std::shared_ptr<const FaceSet>>(&data)) {
    uint64_t unfinite_faces = 0;  // none: the points are finite
    return shape_of_faces(&sources.polyhedra.solid(**faces, unfinite_faces));
  }
  const auto& arguments = std::get<FileArguments>(data);
  const ImportedFile& file =
      arguments.is_surface ? sources.files.surface(arguments) : sources.files.import(arguments);
  if (!file.problem.empty()) problems.add(node, {": " + file.problem, file.todo});
  std::optional<SolidShape> shape = shape_of_faces(file.solid, arguments.file);
  if (shape) shape->color = file.color;
  return shape;
}

}  // namespace frontend
