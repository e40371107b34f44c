// The winding numbers of all operands at a point of a face.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "arrangement/facets.hpp"
#include "arrangement/planar_subdivision.hpp"

namespace csgcore {

/// Follows rays along the axes through a hierarchy of the facets' boxes.
class Windings {
 public:
  explicit Windings(const Facets& facets);

  /// The operands whose winding number is not 0, in rising order, with the number.
  using Numbers = std::vector<std::pair<uint32_t, int>>;

  /// Returns the winding numbers at the centre of a triangle in the plane of the facets `over`,
  /// which are all that lie there; they are not counted. `axis` is one along which the plane is
  /// seen well. No other facet may meet the inside of the triangle.
  Numbers at(const std::array<const ArrangedPoint*, 3>& triangle, int axis,
             std::span<const uint32_t> over) const;

 private:
  struct Node {
    std::array<float, 3> min;
    std::array<float, 3> max;
    uint32_t first;  // of the facets of a leaf in order_, or the second child: the first is next
    uint32_t count;  // 0: it is no leaf
  };
  void build();

  const Facets& facets_;
  std::vector<uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace csgcore
