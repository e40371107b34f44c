// The frustum's traits, for cylinders and for cones with a point at either end.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/primitive_traits.hpp"

namespace frontend {
namespace {

using csgcore::Box;
using csgcore::FrustumShape;
using csgcore::Primitive;
using csgcore::Vec3;

double larger_radius(const FrustumShape& shape) { return std::max(shape.r_bottom, shape.r_top); }

/// Adds a cap, with three points of its rim and its normal towards z_max, or an apex. It is built
/// in place: healing asks for caps often, and a copy would wait for what has just been written.
void add_cap(double z, double radius, uint32_t opposite, PlaneFaces& faces) {
  PlaneFace& cap = faces.faces.emplace_back();
  cap.center = Vec3(0, 0, z);
  cap.normal = Vec3(0, 0, 1);
  cap.opposite = opposite;
  cap.first_corner = static_cast<uint32_t>(faces.corners.size());
  if (radius == 0) return;
  cap.corner_count = 3;
  faces.corners.emplace_back(radius, 0.0, z);
  faces.corners.emplace_back(0.0, radius, z);
  faces.corners.emplace_back(-radius, -radius, z);
}

class FrustumTraits final : public PrimitiveTraits {
 public:
  double extent(const Primitive& primitive) const override {
    const auto& [z_min, z_max, r_bottom, r_top] = primitive.as<FrustumShape>();
    return std::max({r_bottom, r_top, std::abs(z_min), std::abs(z_max)});
  }

  int fragments(const Primitive& primitive, const csgcore::FacetSettings& settings) const override {
    return csgcore::fragment_count(larger_radius(primitive.as<FrustumShape>()), settings);
  }
  Box faceted_box(const Primitive& primitive,
                  const csgcore::FacetSettings& settings) const override {
    const auto& frustum = primitive.as<FrustumShape>();
    const double radius = larger_radius(frustum);
    const Box& unit = unit_polygon_box(fragments(primitive, settings));
    Box box{radius * unit.min, radius * unit.max};
    box.min.z = frustum.z_min;
    box.max.z = frustum.z_max;
    return box;
  }
  Faceting faceting(const Primitive& primitive, int fragments) const override {
    const auto& p = primitive.as<FrustumShape>();
    const double radius = larger_radius(p);
    return {csgcore::make_frustum(0, 1, p.r_bottom / radius, p.r_top / radius), Vec3(0, 0, p.z_min),
            Vec3(radius, radius, p.z_max - p.z_min), static_cast<uint64_t>(fragments) + 2};
  }
  /// OpenSCAD leaves a cylinder's sides whole.
  RevolvedFaces revolved_faces(const Primitive& primitive, int fragments) const override {
    const auto& p = primitive.as<FrustumShape>();
    return {csgcore::frustum_mesh(p.z_min, p.z_max, p.r_bottom, p.r_top, fragments),
            p.r_bottom != p.r_top};
  }

  Roundness roundness(const Primitive& primitive) const override {
    const auto& p = primitive.as<FrustumShape>();
    return {Roundness::About::kAxis, {p.r_bottom, p.r_top}, {p.z_min, p.z_max}};
  }
  /// Face 0 is the cap at z_min, face 1 the one at z_max.
  void find_plane_faces(const Primitive& primitive, PlaneFaces& faces) const override {
    const auto& p = primitive.as<FrustumShape>();
    add_cap(p.z_min, p.r_bottom, 1, faces);
    add_cap(p.z_max, p.r_top, 0, faces);
  }

  /// The middle of a chord between two neighbouring vertices of a circle is nearest to the axis.
  double inscribed_share(int fragments) const override {
    return std::cos(std::numbers::pi / fragments);
  }
  std::optional<RadialPlace> radial_place(const Primitive& primitive,
                                          const Vec3& point) const override {
    const auto& p = primitive.as<FrustumShape>();
    const double height = (point.z - p.z_min) / (p.z_max - p.z_min);
    return RadialPlace{Vec3(point.x, point.y, 0), p.r_bottom + height * (p.r_top - p.r_bottom),
                       larger_radius(p), height};
  }
};

constexpr FrustumTraits kFrustumTraits;

}  // namespace

constinit const PrimitiveTraits& Frustum_traits = kFrustumTraits;

}  // namespace frontend
