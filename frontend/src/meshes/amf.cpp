// AMF: XML with the vertices and triangles of objects, perhaps within a zip archive.
#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>

#include "meshes/number_text.hpp"
#include "meshes/read_solid_file.hpp"
#include "meshes/xml_scanner.hpp"
#include "meshes/zip_archive.hpp"

namespace frontend {
namespace {

using Part = XmlScanner::Part;

/// Takes the parts of a document. Coordinates and indices are texts of their own: <x>1</x>.
class AmfReader {
 public:
  FaceSet read(std::string_view document, bool& is_amf) {
    XmlScanner scanner(document);
    for (Part part = scanner.next(); part != Part::kNone; part = scanner.next()) {
      if (part == Part::kText) {
        text_ = trimmed(scanner.text());
      } else if (part == Part::kStart) {
        if (scanner.name() == "amf") is_amf = true;
        start(scanner.name());
      } else {
        end(scanner.name());
      }
    }
    return std::move(faces_);
  }

 private:
  void start(std::string_view name) {
    text_ = {};
    if (name == "object") {
      first_ = static_cast<uint32_t>(faces_.points.size());
    } else if (name == "coordinates") {
      point_ = csgcore::Vec3(0.0);
    } else if (name == "triangle") {
      corners_.fill(kNoPoint);
    }
  }

  void end(std::string_view name) {
    if (name.size() == 1 && name[0] >= 'x' && name[0] <= 'z') {
      point_[name[0] - 'x'] = number_of(text_).value_or(0);
    } else if (name.size() == 2 && name[0] == 'v' && name[1] >= '1' && name[1] <= '3') {
      corners_[static_cast<size_t>(name[1] - '1')] = index_of(text_).value_or(kNoPoint);
    } else if (name == "coordinates") {
      faces_.points.push_back(point_);
    } else if (name == "triangle") {
      add_triangle();
    }
  }

  void add_triangle() {
    const auto count = static_cast<uint32_t>(faces_.points.size()) - first_;
    if (*std::ranges::max_element(corners_) >= count) return;
    for (const uint32_t corner : corners_) faces_.corners.push_back(first_ + corner);
  }

  static constexpr uint32_t kNoPoint = 0xFFFFFFFFu;
  FaceSet faces_;
  uint32_t first_ = 0;  // the first point of the object at hand
  csgcore::Vec3 point_{0.0};
  std::array<uint32_t, 3> corners_{};
  std::string_view text_;
};

}  // namespace

SolidFile read_amf(std::string_view bytes, const std::string& name) {
  std::string unpacked;
  if (ZipArchive::is_one(bytes)) {
    const ZipArchive archive(bytes);
    if (!archive.entries().empty()) {
      unpacked = archive.unpack(archive.entries().front()).value_or("");
    }
    bytes = unpacked;
  }
  bool is_amf = false;
  SolidFile file;
  file.faces = AmfReader().read(bytes, is_amf);
  if (!is_amf) file.problem = "Failed to parse file '" + name + "'";
  return file;
}

}  // namespace frontend
