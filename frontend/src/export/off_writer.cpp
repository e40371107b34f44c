// OFF.

#include "export/model_writers.hpp"
#include "export/written_numbers.hpp"

namespace frontend {

std::string off_of(const csgcore::TriangleSet& surface) {
  std::string text = "OFF " + std::to_string(surface.vertices.size()) + ' ' +
                     std::to_string(surface.triangles.size()) + " 0\n";
  for (const csgcore::Vec3& vertex : surface.vertices) {
    for (int axis = 0; axis < 3; ++axis) {
      append_number(text, vertex[axis]);
      text += ' ';
    }
    text += '\n';
  }
  for (const std::array<uint32_t, 3>& t : surface.triangles) {
    text += '3';
    for (const uint32_t corner : t) {
      text += ' ';
      append_number(text, corner);
    }
    text += '\n';
  }
  return text;
}

}  // namespace frontend
