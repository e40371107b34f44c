// 3MF: XML with the vertices and triangles of objects, within a zip archive.
#include <array>
#include <optional>
#include <string>

#include "meshes/number_text.hpp"
#include "meshes/read_solid_file.hpp"
#include "meshes/xml_names.hpp"
#include "meshes/zip_archive.hpp"

namespace frontend {
namespace {

/// Returns the name of the model's part: that which the package's relationships name.
std::string model_name(ZipArchive& archive) {
  constexpr std::string_view kModelType = "/3dmodel";
  const std::string relationships = archive.unpack("_rels/.rels").value_or("");
  pugi::xml_document document;
  document.load_buffer(relationships.data(), relationships.size());
  std::string name = "3D/3dmodel.model";
  for_each_child(document.document_element(), "Relationship", [&](const pugi::xml_node& part) {
    if (!std::string_view(part.attribute("Type").value()).ends_with(kModelType)) return;
    const std::string_view target = part.attribute("Target").value();
    name = target.substr(target.starts_with('/') ? 1 : 0);
  });
  return name;
}

/// Adds the mesh. Returns false if a coordinate is no number, or a triangle names a vertex that the
/// mesh does not have.
bool read_mesh(const pugi::xml_node& mesh, FaceSet& faces) {
  const auto first = static_cast<uint32_t>(faces.points.size());
  bool is_right = true;
  for_each_child(mesh, "vertices", [&](const pugi::xml_node& vertices) {
    for_each_child(vertices, "vertex", [&](const pugi::xml_node& vertex) {
      csgcore::Vec3& point = faces.points.emplace_back(0.0);
      constexpr std::array<const char*, 3> kAxes = {"x", "y", "z"};
      for (int axis = 0; axis < 3; ++axis) {
        const std::string_view text =
            trimmed(vertex.attribute(kAxes[static_cast<size_t>(axis)]).value());
        const std::optional<double> number = number_of(text);
        is_right = is_right && (number || text.empty());
        point[axis] = number.value_or(0);
      }
    });
  });
  const auto count = static_cast<uint32_t>(faces.points.size()) - first;
  for_each_child(mesh, "triangles", [&](const pugi::xml_node& triangles) {
    for_each_child(triangles, "triangle", [&](const pugi::xml_node& triangle) {
      for (const char* const name : {"v1", "v2", "v3"}) {
        const std::optional<uint32_t> corner = index_of(trimmed(triangle.attribute(name).value()));
        is_right = is_right && corner && *corner < count;
        faces.corners.push_back(first + corner.value_or(0));
      }
    });
  });
  return is_right;
}

bool read_model(std::string_view model, FaceSet& faces) {
  pugi::xml_document document;
  if (!document.load_buffer(model.data(), model.size())) return false;
  bool is_right = true;
  for_each_child(document.document_element(), "resources", [&](const pugi::xml_node& resources) {
    for_each_child(resources, "object", [&](const pugi::xml_node& object) {
      for_each_child(object, "mesh", [&](const pugi::xml_node& mesh) {
        is_right = is_right && read_mesh(mesh, faces);
      });
    });
  });
  return is_right;
}

}  // namespace

SolidFile read_3mf(std::string_view bytes, const std::string& name) {
  SolidFile file;
  ZipArchive archive(bytes);
  const std::optional<std::string> model = archive.unpack(model_name(archive));
  if (model && read_model(*model, file.faces)) return file;
  file.faces = {};
  file.problem = "Could not read file '" + name + "'";
  return file;
}

}  // namespace frontend
