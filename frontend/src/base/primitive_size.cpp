#include "base/primitive_size.hpp"

#include <algorithm>
#include <cmath>

#include "base/primitive_traits.hpp"

namespace frontend {

double size_of(const csgcore::Primitive& primitive) {
  double stretch = 0;
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) {
      stretch = std::max(stretch, std::abs(primitive.local_to_world.linear[column][row]));
    }
  }
  return traits_of(primitive.shape()).extent(primitive) * stretch;
}

}  // namespace frontend
