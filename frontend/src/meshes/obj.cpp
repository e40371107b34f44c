// OBJ: points, and faces of any number of corners.
#include "meshes/number_text.hpp"
#include "meshes/read_solid_file.hpp"

namespace frontend {
namespace {

/// Returns the point that a corner names, `4`, `4/1` or `4//2`: counted from 1, or back from the
/// last one.
std::optional<uint32_t> obj_corner(std::string_view word, size_t points) {
  word = word.substr(0, word.find('/'));
  const bool is_back = word.starts_with('-');
  const std::optional<uint32_t> index = index_of(word.substr(is_back ? 1 : 0));
  if (!index || *index == 0 || *index > points) return std::nullopt;
  return is_back ? static_cast<uint32_t>(points) - *index : *index - 1;
}

bool read_obj_point(std::string_view line, FaceSet& faces) {
  csgcore::Vec3 point(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    const std::optional<double> coordinate = number_of(take_word(line));
    if (!coordinate) return false;
    point[axis] = *coordinate;
  }
  faces.points.push_back(point);
  return true;
}

/// Returns whether all corners name points.
bool read_obj_face(std::string_view line, FaceSet& faces) {
  bool is_right = true;
  for (std::string_view word = take_word(line); !word.empty(); word = take_word(line)) {
    const std::optional<uint32_t> corner = obj_corner(word, faces.points.size());
    is_right = is_right && corner;
    if (corner) faces.corners.push_back(*corner);
  }
  faces.end_face();
  return is_right;
}

}  // namespace

SolidFile read_obj(std::string_view bytes, const std::string& name) {
  SolidFile file;
  for (uint32_t number = 1; !bytes.empty(); ++number) {
    const std::string_view line = trimmed(take_line(bytes));
    std::string_view rest = line;
    const std::string_view kind = take_word(rest);
    const bool is_right = kind == "v"   ? read_obj_point(rest, file.faces)
                          : kind == "f" ? read_obj_face(rest, file.faces)
                                        : true;
    if (is_right || !file.problem.empty()) continue;
    const char* const what = kind == "v" ? "Unrecognized Line '" : "Index out of range in '";
    file.problem =
        what + std::string(line) + "', line " + std::to_string(number) + " of '" + name + "'";
  }
  return file;
}

}  // namespace frontend
