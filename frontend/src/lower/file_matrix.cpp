#include "lower/file_matrix.hpp"

#include <cmath>

namespace frontend {

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

}  // namespace frontend
