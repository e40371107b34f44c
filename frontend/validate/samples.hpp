// Makes the rays, views and points that are compared.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "csgcore/facets.hpp"
#include "csgcore/view.hpp"
#include "random.hpp"

namespace validation {

/// Returns a random line or ray through the box, as a view of one pixel. Half of them are
/// orthographic, half a perspective from within the box. Precondition: the box is not empty.
csgcore::View random_ray_view(const csgcore::Box& box, uint64_t seed, uint64_t index);

/// Returns a camera in a random direction that has the box in its picture. Half of them are
/// perspective, half orthographic.
csgcore::View random_view(const csgcore::Box& box, uint64_t seed, uint64_t index);

/// Returns all pixels of a picture, in an order in which the first ones already lie all over it.
std::vector<uint32_t> scattered_pixels(const csgcore::View& view);

/// Makes points in and about a solid.
class PointSampler {
 public:
  /// `boundary` is the solid's, in triangles; the points do not depend on their order. The box
  /// contains it and is not empty.
  PointSampler(const csgcore::Box& box, const csgcore::Mesh& boundary, uint64_t seed);

  /// Returns a point anywhere in the box.
  csgcore::Vec3 in_box(uint64_t index) const;
  /// Returns a point above or below the boundary. Its distance, as a share of the box's diagonal,
  /// is log-uniform between kNearest and kFurthest. Without a boundary it is anywhere in the box.
  csgcore::Vec3 near_surface(uint64_t index) const;
  /// Returns a point that far from an edge of the boundary, in any direction.
  csgcore::Vec3 near_edge(uint64_t index) const;

  static constexpr double kFurthest = 1e-2;
  static constexpr double kNearest = 1e-7;  // 100 times the tolerance below which pieces do not
                                            // exist

 private:
  using Triangle = std::array<csgcore::Vec3, 3>;
  const Triangle& pick_triangle(Random& random) const;

  csgcore::Box box_;
  std::vector<Triangle> triangles_;
  std::vector<double> areas_;  // cumulative, each triangle included
  uint64_t seed_;
};

}  // namespace validation
