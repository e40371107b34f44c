// OFF: points, and faces of any number of corners.
#include "meshes/number_text.hpp"
#include "meshes/read_solid_file.hpp"

namespace frontend {
namespace {

/// The words of the file, without its comments.
class OffText {
 public:
  explicit OffText(std::string_view text) : text_(text) {}

  std::string_view word() {
    for (;;) {
      std::string_view rest = text_;
      const std::string_view word = take_word(rest);
      if (!word.starts_with('#')) {
        text_ = rest;
        return word;
      }
      text_ = text_.substr(static_cast<size_t>(word.data() - text_.data()));
      take_line(text_);
    }
  }
  void end_line() { take_line(text_); }

 private:
  std::string_view text_;
};

bool is_header(std::string_view word) {
  if (!word.ends_with("OFF")) return false;
  word.remove_suffix(3);
  return word.find_first_not_of("STCN") == std::string_view::npos;
}

bool read_points(OffText& text, uint32_t count, FaceSet& faces) {
  for (uint32_t i = 0; i < count; ++i) {
    csgcore::Vec3 point;
    for (int axis = 0; axis < 3; ++axis) {
      const std::optional<double> coordinate = number_of(text.word());
      if (!coordinate) return false;
      point[axis] = *coordinate;
    }
    faces.points.push_back(point);
    text.end_line();
  }
  return true;
}

bool read_faces(OffText& text, uint32_t count, FaceSet& faces) {
  for (uint32_t i = 0; i < count; ++i) {
    const std::optional<uint32_t> corners = index_of(text.word());
    if (!corners) return false;
    for (uint32_t k = 0; k < *corners; ++k) {
      const std::optional<uint32_t> corner = index_of(text.word());
      if (!corner || *corner >= faces.points.size()) return false;
      faces.corners.push_back(*corner);
    }
    faces.end_face();
    text.end_line();
  }
  return true;
}

}  // namespace

SolidFile read_off(std::string_view bytes, const std::string& name) {
  SolidFile file;
  OffText text(bytes);
  const bool has_header = is_header(text.word());
  const std::optional<uint32_t> points = index_of(text.word()), faces = index_of(text.word());
  if (has_header && points && faces) {
    text.end_line();  // with the count of edges
    if (read_points(text, *points, file.faces) && read_faces(text, *faces, file.faces)) return file;
  }
  file.faces = {};
  file.problem = "The file '" + name + "' is not in OFF";
  return file;
}

}  // namespace frontend
