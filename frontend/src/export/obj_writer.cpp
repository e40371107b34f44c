// Wavefront OBJ.

#include "export/model_writers.hpp"
#include "export/written_numbers.hpp"

namespace frontend {

std::string obj_of(const csgcore::TriangleSet& surface) {
  std::string text = "o OpenSCAD_Model\n";
  for (const csgcore::Vec3& vertex : surface.vertices) {
    text += 'v';
    for (int axis = 0; axis < 3; ++axis) {
      text += ' ';
      append_number(text, static_cast<float>(vertex[axis]));
    }
    text += '\n';
  }
  for (const std::array<uint32_t, 3>& t : surface.triangles) {
    text += 'f';
    for (const uint32_t corner : t) {
      text += ' ';
      append_number(text, corner + 1);
    }
    text += '\n';
  }
  return text;
}

}  // namespace frontend
