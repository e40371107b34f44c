#include "arguments/file_matrix.hpp"

#include <cmath>

#include "plane/plane_map.hpp"

namespace frontend {

bool is_identity(const FileMatrix& file) {
  return file.divisor == 1 && file.map.linear == csgcore::Mat3(1.0) &&
         file.map.translation == csgcore::Vec3(0.0);
}

bool is_affine(const FileMatrix& file) {
  return csgcore::Affine{file.map.linear / file.divisor, file.map.translation / file.divisor}
      .finite();
}

HealedMatrix heal(const FileMatrix& file) {
  HealedMatrix matrix = file.has_all_digits ? heal_typed_matrix(file.map) : heal_matrix(file.map);
  if (file.divisor != 1) {
    const double size = std::abs(file.divisor);
    matrix.map = {matrix.map.linear / file.divisor, matrix.map.translation / file.divisor};
    matrix.linear_error /= size;
    matrix.translation_error /= size;
  }
  return matrix;
}

HealedMatrix heal_in_plane(FileMatrix file) {
  file.map = in_space(plane_part(file.map));
  file.map.linear[2][2] = file.divisor;
  return heal(file);
}

}  // namespace frontend
