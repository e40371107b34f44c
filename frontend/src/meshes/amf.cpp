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
  /// Returns nothing if the document is damaged, or has something else than a number somewhere.
  std::optional<FaceSet> read(std::string_view document) {
    XmlScanner scanner(document);
    bool is_amf = false;
    for (Part part = scanner.next(); part != Part::kNone; part = scanner.next()) {
      if (part == Part::kText) {
        text_ = scanner.text();
      } else if (part == Part::kStart) {
        if (scanner.name() == "amf") is_amf = true;
        start(scanner.name());
      } else {
        end(scanner.name());
      }
    }
    if (!is_amf || !has_numbers_ || !scanner.is_whole()) return std::nullopt;
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
      point_[name[0] - 'x'] = number(number_of(text_));
    } else if (name.size() == 2 && name[0] == 'v' && name[1] >= '1' && name[1] <= '3') {
      corners_[static_cast<size_t>(name[1] - '1')] = number(index_of(text_));
    } else if (name == "coordinates") {
      faces_.points.push_back(point_);
    } else if (name == "triangle") {
      add_triangle();
    }
  }

  /// An empty text counts as 0.
  template <typename Number>
  Number number(const std::optional<Number>& read) {
    has_numbers_ = has_numbers_ && (read || text_.empty());
    return read.value_or(0);
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
  bool has_numbers_ = true;
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
  SolidFile file;
  if (std::optional<FaceSet> faces = AmfReader().read(bytes)) {
    file.faces = std::move(*faces);
  } else {
    file.problem = "Failed to parse file '" + name + "'";
  }
  return file;
}

}  // namespace frontend
