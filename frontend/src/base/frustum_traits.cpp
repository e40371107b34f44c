// The frustum's traits: cylinders, and cones with either end pointed.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/plane_faces.hpp"
#include "base/polygon_box.hpp"
#include "base/primitive_traits.hpp"
#include "csgcore/polyhedron.hpp"

namespace frontend {
namespace {

using csgcore::Box;
using csgcore::Primitive;
using csgcore::Vec3;

double larger_radius(const Primitive& p) { return std::max(p.r_bottom, p.r_top); }

class FrustumTraits final : public PrimitiveTraits {
 public:
  double extent(const Primitive& p) const override {
    return std::max({p.r_bottom, p.r_top, std::abs(p.z_min), std::abs(p.z_max)});
  }

  int fragments(const Primitive& primitive, const csgcore::FacetSettings& settings) const override {
    return csgcore::fragment_count(larger_radius(primitive), settings);
  }
  Box faceted_box(const Primitive& primitive,
                  const csgcore::FacetSettings& settings) const override {
    const double radius = larger_radius(primitive);
    const Box& unit = unit_polygon_box(fragments(primitive, settings));
    Box box{radius * unit.min, radius * unit.max};
    box.min.z = primitive.z_min;
    box.max.z = primitive.z_max;
    return box;
  }
  Faceting faceting(const Primitive& p, int fragments) const override {
    const double radius = larger_radius(p);
    return {csgcore::make_frustum(0, 1, p.r_bottom / radius, p.r_top / radius), Vec3(0, 0, p.z_min),
            Vec3(radius, radius, p.z_max - p.z_min), static_cast<uint64_t>(fragments) + 2};
  }
  std::shared_ptr<const csgcore::Polyhedron> faceted(const Primitive& primitive,
                                                     int fragments) const override {
    return csgcore::Polyhedron::faceted(primitive, fragments);
  }

  Roundness roundness(const Primitive& p) const override {
    return {Roundness::About::kAxis, {p.r_bottom, p.r_top}, {p.z_min, p.z_max}};
  }
  /// Face 0 is the cap at z_min, face 1 the one at z_max; each may be an apex. Both normals point
  /// to z_max, and the corners are three points of each rim.
  void find_plane_faces(const Primitive& p, PlaneFaces& faces) const override {
    const double r = p.r_bottom, s = p.r_top;
    const std::array<Vec3, 6> rims{Vec3(r, 0, p.z_min), Vec3(0, r, p.z_min), Vec3(-r, -r, p.z_min),
                                   Vec3(s, 0, p.z_max), Vec3(0, s, p.z_max), Vec3(-s, -s, p.z_max)};
    const uint32_t below = r > 0 ? 3 : 0, above = s > 0 ? 3 : 0;
    faces.corners.assign(rims.begin() + (3 - below), rims.begin() + (3 + above));
    const Vec3 up(0, 0, 1);
    faces.faces = {{Vec3(0, 0, p.z_min), up, 1, 0, below},
                   {Vec3(0, 0, p.z_max), up, 0, below, above}};
  }

  /// The middle of a chord between two neighbouring vertices of a circle is nearest.
  double inscribed_share(int fragments) const override {
    return std::cos(std::numbers::pi / fragments);
  }
  std::optional<RadialPlace> radial_place(const Primitive& p, const Vec3& point) const override {
    const double height = (point.z - p.z_min) / (p.z_max - p.z_min);
    return RadialPlace{Vec3(point.x, point.y, 0), p.r_bottom + height * (p.r_top - p.r_bottom),
                       larger_radius(p), height};
  }
};

constexpr FrustumTraits kTraits;

}  // namespace

constinit const PrimitiveTraits& Frustum_traits = kTraits;

}  // namespace frontend
