// The rays, views and points that are compared.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "csgcore/facets.hpp"
#include "csgcore/view.hpp"
#include "random.hpp"

namespace validation {

/// A random line or ray through the box, as a view of one pixel: of two, one is orthographic, the
/// other a perspective from within the box. The box is not empty.
csgcore::View random_ray_view(const csgcore::Box& box, uint64_t seed, uint64_t index);

/// A camera that has the box in its picture, from a random direction. Of two, one is perspective,
/// the other orthographic.
csgcore::View random_view(const csgcore::Box& box, uint64_t seed, uint64_t index);

/// All pixels of a picture in an order in which the first of them lie all over it.
std::vector<uint32_t> scattered_pixels(const csgcore::View& view);

/// Points in and about a solid.
class PointSampler {
 public:
  /// `boundary`: the solid's, in triangles; the points do not depend on their order. The box is not
  /// empty, and holds it.
  PointSampler(const csgcore::Box& box, const csgcore::Mesh& boundary, uint64_t seed);

  /// Anywhere in the box.
  csgcore::Vec3 in_box(uint64_t index) const;
  /// Above or below the boundary; between kFurthest and kNearest of the box's diagonal away, by
  /// orders of magnitude alike. Anywhere if there is no boundary.
  csgcore::Vec3 near_surface(uint64_t index) const;
  /// The same about an edge of the boundary, in any direction.
  csgcore::Vec3 near_edge(uint64_t index) const;

  static constexpr double kFurthest = 1e-2;
  static constexpr double kNearest = 1e-7;  // 100 times the thickness that does not exist

 private:
  using Triangle = std::array<csgcore::Vec3, 3>;
  const Triangle& pick_triangle(Random& random) const;

  csgcore::Box box_;
  std::vector<Triangle> triangles_;
  std::vector<double> areas_;  // of the triangles up to each, it included
  uint64_t seed_;
};

}  // namespace validation
