// 3MF: a zip archive with the parts as XML, in millimetres.

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "export/model_writers.hpp"
#include "export/written_numbers.hpp"
#include "export/zip_writer.hpp"

namespace frontend {
namespace {

constexpr std::string_view kContentTypes =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\">\n"
    "\t<Default Extension=\"rels\" "
    "ContentType=\"application/vnd.openxmlformats-package.relationships+xml\" />\n"
    "\t<Default Extension=\"model\" "
    "ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\" />\n"
    "</Types>\n";

constexpr std::string_view kRelationships =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">\n"
    "\t<Relationship Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\" "
    "Target=\"/3D/3dmodel.model\" Id=\"rel0\" />\n"
    "</Relationships>\n";

/// Returns #RRGGBBAA.
std::string hex_of(const csgcore::Color& color) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  std::string text = "#";
  for (const float channel : {color.r, color.g, color.b, color.a}) {
    const auto byte = static_cast<size_t>(std::lround(255 * std::clamp(channel, 0.0f, 1.0f)));
    text += kDigits[byte >> 4];
    text += kDigits[byte & 0xF];
  }
  return text;
}

/// Appends ` NAME="NUMBER"`.
template <typename Number>
void append_attribute(std::string& text, std::string_view name, Number number) {
  text.append(" ").append(name) += "=\"";
  append_number(text, number);
  text += '"';
}

void append_mesh(std::string& text, const csgcore::TriangleSet& surface) {
  text += "\t\t\t<mesh>\n\t\t\t\t<vertices>\n";
  for (const csgcore::Vec3& vertex : surface.vertices) {
    text += "\t\t\t\t\t<vertex";
    append_attribute(text, "x", static_cast<float>(vertex.x));
    append_attribute(text, "y", static_cast<float>(vertex.y));
    append_attribute(text, "z", static_cast<float>(vertex.z));
    text += " />\n";
  }
  text += "\t\t\t\t</vertices>\n\t\t\t\t<triangles>\n";
  for (const std::array<uint32_t, 3>& t : surface.triangles) {
    text += "\t\t\t\t\t<triangle";
    append_attribute(text, "v1", t[0]);
    append_attribute(text, "v2", t[1]);
    append_attribute(text, "v3", t[2]);
    text += " />\n";
  }
  text += "\t\t\t\t</triangles>\n\t\t\t</mesh>\n";
}

/// Opens an element with an identifier.
void append_start(std::string& text, std::string_view element, size_t id) {
  text.append("\t\t<").append(element);
  append_attribute(text, "id", id);
}

class ModelText {
 public:
  ModelText(std::span<const ExportedPart> parts, const ExportSettings& settings)
      : parts_(parts), settings_(settings), is_color_group_(settings.three_mf_material == "color") {
    has_colors_ = std::any_of(parts.begin(), parts.end(),
                              [](const ExportedPart& part) { return part.color.has_value(); });
  }

  std::string take() {
    text_ =
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<model xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\" ";
    if (is_color_group_) {
      text_ += "xmlns:m=\"http://schemas.microsoft.com/3dmanufacturing/material/2015/02\" ";
    }
    text_ += "unit=\"" + settings_.three_mf_unit + "\" xml:lang=\"en-US\">\n";
    if (settings_.three_mf_meta_data) add_meta_data();
    text_ += "\t<resources>\n";
    if (has_colors_) add_materials();
    for (size_t i = 0; i < parts_.size(); ++i) add_object(i);
    const bool is_assembly = parts_.size() > 1;
    if (is_assembly) add_assembly();
    text_ += "\t</resources>\n\t<build>\n\t\t<item";
    append_attribute(text_, "objectid", is_assembly ? object_id(parts_.size()) : object_id(0));
    text_ += " />\n\t</build>\n</model>\n";
    return std::move(text_);
  }

 private:
  static constexpr size_t kMaterialsId = 1;

  size_t object_id(size_t part) const { return kMaterialsId + has_colors_ + part; }

  void add_meta_data() {
    const std::pair<const char*, const std::string&> all[] = {
        {"Title", settings_.three_mf_title},
        {"Designer", settings_.three_mf_designer},
        {"Description", settings_.three_mf_description},
        {"Copyright", settings_.three_mf_copyright},
        {"LicenseTerms", settings_.three_mf_license},
        {"Rating", settings_.three_mf_rating}};
    for (const auto& [name, value] : all) {
      if (value.empty()) continue;
      text_ +=
          "\t<metadata name=\"" + std::string(name) + "\">" + xml_text(value) + "</metadata>\n";
    }
  }

  /// Adds one for each part that has a colour.
  void add_materials() {
    const char* const element = is_color_group_ ? "m:colorgroup" : "basematerials";
    append_start(text_, element, kMaterialsId);
    text_ += ">\n";
    for (const ExportedPart& part : parts_) {
      if (!part.color) continue;
      const std::string hex = hex_of(*part.color);
      text_ += is_color_group_
                   ? "\t\t\t<m:color color=\"" + hex + "\" />\n"
                   : "\t\t\t<base name=\"" + hex + "\" displaycolor=\"" + hex + "\" />\n";
    }
    text_ += "\t\t</" + std::string(element) + ">\n";
  }

  void add_object(size_t index) {
    const ExportedPart& part = parts_[index];
    append_start(text_, "object", object_id(index));
    text_ += " name=\"OpenSCAD Model";
    if (parts_.size() > 1) text_ += ", part " + std::to_string(index + 1);
    text_ += "\" type=\"model\"";
    if (part.color) {
      append_attribute(text_, "pid", kMaterialsId);
      append_attribute(text_, "pindex", next_material_++);
    }
    text_ += ">\n";
    append_mesh(text_, part.surface);
    text_ += "\t\t</object>\n";
  }

  /// Adds the object of all parts, which stay where they are when a slicer moves it.
  void add_assembly() {
    append_start(text_, "object", object_id(parts_.size()));
    text_ += " name=\"OpenSCAD Model\" type=\"model\">\n\t\t\t<components>\n";
    for (size_t i = 0; i < parts_.size(); ++i) {
      text_ += "\t\t\t\t<component";
      append_attribute(text_, "objectid", object_id(i));
      text_ += " />\n";
    }
    text_ += "\t\t\t</components>\n\t\t</object>\n";
  }

  std::span<const ExportedPart> parts_;
  const ExportSettings& settings_;
  bool is_color_group_;
  bool has_colors_;
  size_t next_material_ = 0;
  std::string text_;
};

}  // namespace

std::string three_mf_of(std::span<const ExportedPart> parts, const ExportSettings& settings) {
  const std::string model = ModelText(parts, settings).take();
  const std::array<ZippedFile, 3> files = {{{"[Content_Types].xml", kContentTypes},
                                            {"_rels/.rels", kRelationships},
                                            {"3D/3dmodel.model", model}}};
  return zip_of(files);
}

}  // namespace frontend
