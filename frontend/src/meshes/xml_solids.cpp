// AMF and 3MF: XML with the vertices and triangles of objects, within a zip archive (AMF: perhaps).

#include <array>
#include <map>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <utility>
#include <vector>

#include "meshes/number_text.hpp"
#include "meshes/read_solid_file.hpp"
#include "meshes/zip_archive.hpp"

namespace frontend {
namespace {

/// Returns the element's name without the prefix of a name space, whatever the document calls it.
std::string_view local_name(const pugi::xml_node& node) {
  const std::string_view name = node.name();
  return name.substr(name.find(':') + 1);  // all of it if there is no colon
}

/// Calls visit(child) with the element's children of that name.
template <typename Visit>
void for_each_child(const pugi::xml_node& node, std::string_view name, const Visit& visit) {
  for (const pugi::xml_node& child : node.children()) {
    if (local_name(child) == name) visit(child);
  }
}

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

/// Returns the map that a `transform` attribute has; the identity where it is missing or damaged.
csgcore::Affine transform_of(const pugi::xml_node& node) {
  csgcore::Affine map;
  std::string_view text = node.attribute("transform").value();
  std::array<double, 12> numbers{};
  for (double& number : numbers) {
    const std::optional<double> read = number_of(take_word(text));
    if (!read) return {};
    number = *read;
  }
  for (int column = 0; column < 3; ++column) {
    const auto first = static_cast<size_t>(3 * column);
    map.linear[column] = {numbers[first], numbers[first + 1], numbers[first + 2]};
  }
  map.translation = {numbers[9], numbers[10], numbers[11]};
  return map;
}

/// Puts together what the build of a 3MF model names.
class BuiltModel {
 public:
  explicit BuiltModel(const pugi::xml_node& model) : model_(model) {
    for_each_child(model, "resources", [&](const pugi::xml_node& resources) {
      for_each_child(resources, "object", [&](const pugi::xml_node& object) {
        objects_.try_emplace(object.attribute("id").value(), object);
      });
    });
  }

  /// Returns false if an object is missing, or a mesh is damaged, or there would be too much.
  bool read(FaceSet& faces) {
    for_each_child(model_, "build", [&](const pugi::xml_node& build) {
      for_each_child(build, "item", [&](const pugi::xml_node& item) { open(item, {}); });
    });
    while (is_right_ && !parts_.empty()) {
      const Part part = parts_.back();
      parts_.pop_back();
      for_each_child(part.object, "mesh",
                     [&](const pugi::xml_node& mesh) { add(mesh, part.map, faces); });
      for_each_child(part.object, "components", [&](const pugi::xml_node& components) {
        for_each_child(components, "component",
                       [&](const pugi::xml_node& component) { open(component, part.map); });
      });
    }
    return is_right_;
  }

 private:
  static constexpr size_t kMostPoints = size_t{1} << 22;
  static constexpr size_t kMostParts = size_t{1} << 16;  // which may name themselves, too

  struct Part {
    pugi::xml_node object;
    csgcore::Affine map;
  };

  void open(const pugi::xml_node& reference, const csgcore::Affine& around) {
    const auto object = objects_.find(reference.attribute("objectid").value());
    is_right_ = is_right_ && object != objects_.end() && ++part_count_ <= kMostParts;
    if (is_right_) parts_.push_back({object->second, compose(around, transform_of(reference))});
  }

  void add(const pugi::xml_node& mesh, const csgcore::Affine& map, FaceSet& faces) {
    const size_t first_point = faces.points.size(), first_corner = faces.corners.size();
    is_right_ = is_right_ && read_mesh(mesh, faces) && faces.points.size() <= kMostPoints;
    if (!is_right_) return;
    for (size_t i = first_point; i < faces.points.size(); ++i) {
      faces.points[i] = map.point(faces.points[i]);
    }
    if (map.determinant() >= 0) return;
    for (size_t i = first_corner; i < faces.corners.size(); i += 3) {
      std::swap(faces.corners[i], faces.corners[i + 1]);
    }
  }

  pugi::xml_node model_;
  std::map<std::string, pugi::xml_node> objects_;  // by their ids
  std::vector<Part> parts_;                        // to be added
  size_t part_count_ = 0;
  bool is_right_ = true;
};

bool read_built_model(std::string_view model, FaceSet& faces) {
  pugi::xml_document document;
  return document.load_buffer(model.data(), model.size()) &&
         BuiltModel(document.document_element()).read(faces);
}

SolidFile read_package(std::string_view bytes, const std::string& name,
                       bool (*read)(std::string_view model, FaceSet& faces)) {
  SolidFile file;
  ZipArchive archive(bytes);
  const std::optional<std::string> model = archive.unpack(model_name(archive));
  if (model && read(*model, file.faces)) return file;
  file.faces = {};
  file.problem = "Could not read file '" + name + "'";
  return file;
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

SolidFile read_3mf(std::string_view bytes, const std::string& name) {
  return read_package(bytes, name, read_model);
}

SolidFile read_built_3mf(std::string_view bytes, const std::string& name) {
  return read_package(bytes, name, read_built_model);
}

}  // namespace frontend
