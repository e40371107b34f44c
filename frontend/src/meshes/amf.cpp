// AMF: XML with the vertices and triangles of objects, perhaps within a zip archive.
#include <array>
#include <optional>
#include <string>
#include <utility>

#include "meshes/number_text.hpp"
#include "meshes/read_solid_file.hpp"
#include "meshes/xml_names.hpp"
#include "meshes/zip_archive.hpp"

namespace frontend {
namespace {

/// Takes the objects of a document. Coordinates and indices are texts of their own: <x>1</x>.
class AmfReader {
 public:
  void read_object(const pugi::xml_node& object) {
    first_ = static_cast<uint32_t>(faces_.points.size());
    for_each_child(object, "mesh", [&](const pugi::xml_node& mesh) {
      for_each_child(mesh, "vertices", [&](const pugi::xml_node& vertices) {
        for_each_child(vertices, "vertex", [&](const pugi::xml_node& vertex) {
          for_each_child(vertex, "coordinates",
                         [&](const pugi::xml_node& place) { read_point(place); });
        });
      });
      for_each_child(mesh, "volume", [&](const pugi::xml_node& volume) {
        for_each_child(volume, "triangle",
                       [&](const pugi::xml_node& triangle) { read_triangle(triangle); });
      });
    });
  }

  /// Returns nothing if something else than a number stood somewhere.
  std::optional<FaceSet> take_faces() {
    if (!has_numbers_) return std::nullopt;
    return std::move(faces_);
  }

 private:
  void read_point(const pugi::xml_node& place) {
    csgcore::Vec3 point(0.0);
    for (const pugi::xml_node& child : place.children()) {
      const std::string_view name = local_name(child);
      if (name.size() != 1 || name[0] < 'x' || name[0] > 'z') continue;
      point[name[0] - 'x'] = number(child, number_of(child.child_value()));
    }
    faces_.points.push_back(point);
  }

  void read_triangle(const pugi::xml_node& triangle) {
    constexpr uint32_t kNoPoint = 0xFFFFFFFFu;
    std::array<uint32_t, 3> corners{kNoPoint, kNoPoint, kNoPoint};
    for (const pugi::xml_node& child : triangle.children()) {
      const std::string_view name = local_name(child);
      if (name.size() != 2 || name[0] != 'v' || name[1] < '1' || name[1] > '3') continue;
      corners[static_cast<size_t>(name[1] - '1')] = number(child, index_of(child.child_value()));
    }
    const auto count = static_cast<uint32_t>(faces_.points.size()) - first_;
    for (const uint32_t corner : corners) {
      if (corner >= count) return;
    }
    for (const uint32_t corner : corners) faces_.corners.push_back(first_ + corner);
  }

  /// An empty text counts as 0.
  template <typename Number>
  Number number(const pugi::xml_node& node, const std::optional<Number>& read) {
    has_numbers_ = has_numbers_ && (read || *node.child_value() == '\0');
    return read.value_or(0);
  }

  FaceSet faces_;
  uint32_t first_ = 0;  // the first point of the object at hand
  bool has_numbers_ = true;
};

std::optional<FaceSet> read_document(std::string_view text) {
  pugi::xml_document document;
  if (!document.load_buffer(text.data(), text.size())) return std::nullopt;
  const pugi::xml_node root = document.document_element();
  if (local_name(root) != "amf") return std::nullopt;
  AmfReader reader;
  for_each_child(root, "object", [&](const pugi::xml_node& object) { reader.read_object(object); });
  return reader.take_faces();
}

}  // namespace

SolidFile read_amf(std::string_view bytes, const std::string& name) {
  std::string unpacked;
  if (ZipArchive::is_one(bytes)) {
    unpacked = ZipArchive(bytes).unpack_first().value_or("");
    bytes = unpacked;
  }
  SolidFile file;
  if (std::optional<FaceSet> faces = read_document(bytes)) {
    file.faces = std::move(*faces);
  } else {
    file.problem = "Failed to parse file '" + name + "'";
  }
  return file;
}

}  // namespace frontend
