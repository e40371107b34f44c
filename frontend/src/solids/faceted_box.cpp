#include "solids/faceted_box.hpp"

#include <glm/common.hpp>

#include "base/primitive_traits.hpp"

namespace frontend {

csgcore::Box faceted_box(const csgcore::Primitive& primitive,
                         const csgcore::FacetSettings& settings) {
  const csgcore::Box local = traits_of(primitive.shape()).faceted_box(primitive, settings);
  return mapped(primitive.local_to_world, local);
}

bool is_axis_aligned(const csgcore::Affine& map) {
  for (int column = 0; column < 3; ++column) {
    int entries = 0;
    for (int row = 0; row < 3; ++row) entries += map.linear[column][row] != 0;
    if (entries > 1) return false;
  }
  return true;
}

csgcore::Box mapped(const csgcore::Affine& map, const csgcore::Box& box) {
  const csgcore::Vec3 half = 0.5 * box.size();
  const csgcore::Vec3 reach = glm::abs(map.linear[0]) * half.x + glm::abs(map.linear[1]) * half.y +
                              glm::abs(map.linear[2]) * half.z;
  const csgcore::Vec3 center = map.point(box.center());
  return {center - reach, center + reach};
}

}  // namespace frontend
