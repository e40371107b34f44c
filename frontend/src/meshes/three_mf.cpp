// 3MF: XML with the vertices and triangles of objects, within a zip archive.
#include <array>
#include <optional>
#include <string>

#include "meshes/number_text.hpp"
#include "meshes/read_solid_file.hpp"
#include "meshes/xml_scanner.hpp"
#include "meshes/zip_archive.hpp"

namespace frontend {
namespace {

using Part = XmlScanner::Part;

std::optional<std::string> unpack(const ZipArchive& archive, std::string_view name) {
  for (const ZipArchive::Entry& entry : archive.entries()) {
    if (entry.name == name) return archive.unpack(entry);
  }
  return std::nullopt;
}

/// Returns the name of the model's part: that which the package's relationships name.
std::string model_name(const ZipArchive& archive) {
  constexpr std::string_view kModelType = "/3dmodel";
  const std::string relationships = unpack(archive, "_rels/.rels").value_or("");
  XmlScanner scanner(relationships);
  for (Part part = scanner.next(); part != Part::kNone; part = scanner.next()) {
    if (part != Part::kStart || scanner.name() != "Relationship") continue;
    if (!scanner.attribute("Type").ends_with(kModelType)) continue;
    std::string_view target = scanner.attribute("Target");
    if (target.starts_with('/')) target.remove_prefix(1);
    return std::string(target);
  }
  return "3D/3dmodel.model";
}

/// Returns false if the model is damaged, or a triangle names a vertex that its mesh does not have.
bool read_model(std::string_view model, FaceSet& faces) {
  XmlScanner scanner(model);
  uint32_t first = 0;  // the first point of the mesh at hand
  for (Part part = scanner.next(); part != Part::kNone; part = scanner.next()) {
    if (part != Part::kStart) continue;
    if (scanner.name() == "mesh") {
      first = static_cast<uint32_t>(faces.points.size());
    } else if (scanner.name() == "vertex") {
      csgcore::Vec3& point = faces.points.emplace_back(0.0);
      constexpr std::array<std::string_view, 3> kAxes = {"x", "y", "z"};
      for (int axis = 0; axis < 3; ++axis) {
        const std::string_view text = scanner.attribute(kAxes[static_cast<size_t>(axis)]);
        point[axis] = number_of(trimmed(text)).value_or(0);
      }
    } else if (scanner.name() == "triangle") {
      const auto count = static_cast<uint32_t>(faces.points.size()) - first;
      for (const std::string_view name : {"v1", "v2", "v3"}) {
        const std::optional<uint32_t> corner = index_of(trimmed(scanner.attribute(name)));
        if (!corner || *corner >= count) return false;
        faces.corners.push_back(first + *corner);
      }
    }
  }
  return scanner.is_whole();
}

}  // namespace

SolidFile read_3mf(std::string_view bytes, const std::string& name) {
  SolidFile file;
  const ZipArchive archive(bytes);
  const std::optional<std::string> model = unpack(archive, model_name(archive));
  if (model && read_model(*model, file.faces)) return file;
  file.faces = {};
  file.problem = "Could not read file '" + name + "'";
  return file;
}

}  // namespace frontend
