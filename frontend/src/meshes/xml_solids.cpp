// AMF and 3MF: XML with the vertices and triangles of objects, within a zip archive (AMF: perhaps).

#include <array>
#include <charconv>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <pugixml.hpp>
#include <set>
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

/// The colours that the objects of a 3MF model name.
class ModelColors {
 public:
  using FaceColor = std::optional<csgcore::Color>;

  explicit ModelColors(const pugi::xml_node& model) {
    for_each_child(model, "resources", [&](const pugi::xml_node& resources) {
      for_each_child(resources, "basematerials",
                     [&](const pugi::xml_node& group) { add(group, "base", "displaycolor"); });
      for_each_child(resources, "colorgroup",
                     [&](const pugi::xml_node& group) { add(group, "color", "color"); });
    });
  }

  /// Returns the colour of a triangle: its own, or else its object's. Between different colours of
  /// a group it is their mean.
  FaceColor of(const pugi::xml_node& triangle, const pugi::xml_node& object) const {
    const std::string_view own = triangle.attribute("pid").value();
    const auto group = groups_.find(own.empty() ? object.attribute("pid").value() : own);
    if (group == groups_.end()) return std::nullopt;
    if (own.empty()) return at(group->second, object.attribute("pindex"), 0);
    const FaceColor a = at(group->second, triangle.attribute("p1"), kNone);
    if (group->second.are_materials || !a) return a;
    const uint32_t first = index_of(trimmed(triangle.attribute("p1").value())).value_or(kNone);
    const FaceColor b = at(group->second, triangle.attribute("p2"), first),
                    c = at(group->second, triangle.attribute("p3"), first);
    if (!b || !c) return std::nullopt;
    return csgcore::Color{(a->r + b->r + c->r) / 3, (a->g + b->g + c->g) / 3,
                          (a->b + b->b + c->b) / 3, (a->a + b->a + c->a) / 3};
  }

 private:
  struct Group {
    bool are_materials = false;  // whose alpha does not count
    std::vector<FaceColor> colors;
  };

  /// Reads #RRGGBB or #RRGGBBAA.
  static FaceColor color_of(std::string_view text) {
    if (!text.starts_with('#') || (text.size() != 7 && text.size() != 9)) return std::nullopt;
    std::array<float, 4> channels{0, 0, 0, 1};
    for (size_t i = 0; 2 * i + 1 < text.size(); ++i) {
      unsigned value = 0;
      const char* const end = text.data() + 2 * i + 3;
      if (std::from_chars(text.data() + 2 * i + 1, end, value, 16).ptr != end) return std::nullopt;
      channels[i] = static_cast<float>(value) / 255;
    }
    return csgcore::Color{channels[0], channels[1], channels[2], channels[3]};
  }

  static constexpr uint32_t kNone = 0xFFFFFFFFu;

  static FaceColor at(const Group& group, const pugi::xml_attribute& index, uint32_t otherwise) {
    const uint32_t place = index ? index_of(trimmed(index.value())).value_or(kNone) : otherwise;
    return place < group.colors.size() ? group.colors[place] : std::nullopt;
  }

  void add(const pugi::xml_node& node, std::string_view child, const char* attribute) {
    Group group;
    group.are_materials = child == "base";
    for_each_child(node, child, [&](const pugi::xml_node& entry) {
      FaceColor color = color_of(entry.attribute(attribute).value());
      if (color && group.are_materials) color->a = 1;
      group.colors.push_back(color);
    });
    groups_.try_emplace(node.attribute("id").value(), std::move(group));
  }

  std::map<std::string, Group, std::less<>> groups_;  // by their ids
};

/// A model of a 3MF package, and what it defines.
struct ThreeMfModel {
  explicit ThreeMfModel(std::unique_ptr<pugi::xml_document> of)
      : document(std::move(of)), colors(document->document_element()) {
    for_each_child(document->document_element(), "resources", [&](const pugi::xml_node& resources) {
      for_each_child(resources, "object", [&](const pugi::xml_node& object) {
        objects.try_emplace(object.attribute("id").value(), object);
      });
    });
  }

  std::unique_ptr<pugi::xml_document> document;
  ModelColors colors;
  std::map<std::string, pugi::xml_node> objects;  // by their ids
};

/// Puts together what the build of a package's model names. Objects may stand in other models of
/// the package (3MF's production extension).
class BuiltModel {
 public:
  explicit BuiltModel(ZipArchive& archive, size_t bytes)
      : archive_(archive), bytes_left_(kFreeBytes + kMostGrowth * bytes) {}

  /// Returns false if a model or an object is missing, or a mesh is damaged, or there would be too
  /// much.
  bool read(FaceSet& faces) {
    const ThreeMfModel* const main = model(model_name(archive_));
    if (main == nullptr) return false;
    for_each_child(main->document->document_element(), "build", [&](const pugi::xml_node& build) {
      for_each_child(build, "item", [&](const pugi::xml_node& item) { open(item, *main, {}); });
    });
    while (is_right_ && !parts_.empty()) {
      const Part part = parts_.back();
      parts_.pop_back();
      for_each_child(part.object, "mesh",
                     [&](const pugi::xml_node& mesh) { add(mesh, part, faces); });
      for_each_child(part.object, "components", [&](const pugi::xml_node& components) {
        for_each_child(components, "component", [&](const pugi::xml_node& component) {
          open(component, *part.model, part.map);
        });
      });
    }
    return is_right_;
  }

 private:
  // What parts of a package may take together; zip_archive.cpp has the same for one part.
  static constexpr size_t kFreeBytes = size_t{64} << 20, kMostGrowth = 64;
  static constexpr size_t kMostRepeated = size_t{1} << 23;  // points and triangles
  static constexpr size_t kMostParts = size_t{1} << 16;     // which may name themselves, too

  struct Part {
    const ThreeMfModel* model;
    pugi::xml_node object;
    csgcore::Affine map;
  };

  /// Returns the package's model of that name; null if it is missing or damaged.
  const ThreeMfModel* model(const std::string& name) {
    const auto [entry, is_new] = models_.try_emplace(name);
    if (!is_new) return entry->second.get();
    const std::optional<std::string> text = archive_.unpack(name, bytes_left_);
    if (!text) return nullptr;
    bytes_left_ -= text->size();
    auto document = std::make_unique<pugi::xml_document>();
    if (!document->load_buffer(text->data(), text->size())) return nullptr;
    entry->second = std::make_unique<const ThreeMfModel>(std::move(document));
    return entry->second.get();
  }

  /// Returns the name of the model that an item or a component names; empty: it names none.
  static std::string_view path_of(const pugi::xml_node& reference) {
    for (const pugi::xml_attribute& attribute : reference.attributes()) {
      const std::string_view name = attribute.name();
      if (!name.ends_with(":path")) continue;
      const std::string_view path = attribute.value();
      return path.substr(path.starts_with('/') ? 1 : 0);
    }
    return {};
  }

  void open(const pugi::xml_node& reference, const ThreeMfModel& within,
            const csgcore::Affine& around) {
    if (!is_right_) return;
    const std::string_view path = path_of(reference);
    const ThreeMfModel* const from = path.empty() ? &within : model(std::string(path));
    is_right_ = from != nullptr && ++part_count_ <= kMostParts;
    if (!is_right_) return;
    const auto object = from->objects.find(reference.attribute("objectid").value());
    is_right_ = object != from->objects.end();
    if (!is_right_) return;
    parts_.push_back({from, object->second, compose(around, transform_of(reference))});
  }

  void add(const pugi::xml_node& mesh, const Part& part, FaceSet& faces) {
    const csgcore::Affine& map = part.map;
    const size_t first_point = faces.points.size(), first_corner = faces.corners.size();
    is_right_ = is_right_ && read_mesh(mesh, faces);
    const bool is_first = added_.insert(mesh.internal_object()).second;
    if (!is_first) {
      repeated_ += faces.points.size() - first_point + (faces.corners.size() - first_corner) / 3;
    }
    is_right_ = is_right_ && repeated_ <= kMostRepeated;
    if (!is_right_) return;
    for_each_child(mesh, "triangles", [&](const pugi::xml_node& triangles) {
      for_each_child(triangles, "triangle", [&](const pugi::xml_node& triangle) {
        faces.colors.push_back(part.model->colors.of(triangle, part.object));
      });
    });
    for (size_t i = first_point; i < faces.points.size(); ++i) {
      faces.points[i] = map.point(faces.points[i]);
    }
    if (map.determinant() >= 0) return;
    for (size_t i = first_corner; i < faces.corners.size(); i += 3) {
      std::swap(faces.corners[i], faces.corners[i + 1]);
    }
  }

  ZipArchive& archive_;
  size_t bytes_left_;
  std::map<std::string, std::unique_ptr<const ThreeMfModel>> models_;  // by their names
  std::vector<Part> parts_;                                            // to be added
  std::set<const void*> added_;                                        // meshes
  size_t part_count_ = 0;
  size_t repeated_ = 0;
  bool is_right_ = true;
};

SolidFile unless_damaged(bool is_right, FaceSet faces, const std::string& name) {
  if (is_right) return {std::move(faces), {}};
  return {{}, "Could not read file '" + name + "'"};
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
  FaceSet faces;
  ZipArchive archive(bytes);
  const std::optional<std::string> model = archive.unpack(model_name(archive));
  const bool is_right = model && read_model(*model, faces);
  return unless_damaged(is_right, std::move(faces), name);
}

SolidFile read_built_3mf(std::string_view bytes, const std::string& name) {
  FaceSet faces;
  ZipArchive archive(bytes);
  const bool is_right = BuiltModel(archive, bytes.size()).read(faces);
  return unless_damaged(is_right, std::move(faces), name);
}

}  // namespace frontend
