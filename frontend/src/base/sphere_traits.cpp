// The sphere's traits.
#include <cmath>
#include <numbers>

#include "base/primitive_traits.hpp"

namespace frontend {
namespace {

using csgcore::Box;
using csgcore::Primitive;
using csgcore::Vec3;

double radius_of(const Primitive& sphere) { return sphere.as<csgcore::SphereShape>().radius; }

/// Returns the box of the unit sphere's rings (frontend/OPENSCAD.md, "Facets"), from the polygon's.
Box box_of_rings(int fragments) {
  const Box& polygon = unit_polygon_box(fragments);
  const double rings = csgcore::ring_count(fragments);
  const double nearest_equator = std::floor(rings / 2) + 0.5;
  const double widest = std::sin(std::numbers::pi * nearest_equator / rings);
  const double height = std::cos(std::numbers::pi * 0.5 / rings);
  return {{polygon.min.x * widest, polygon.min.y * widest, -height},
          {polygon.max.x * widest, polygon.max.y * widest, height}};
}

/// A call with the same number as the thread's last one computes nothing.
const Box& unit_sphere_box(int fragments) {
  struct Last {
    int fragments = 0;
    Box box;
  };
  thread_local Last last;
  if (last.fragments != fragments) last = {fragments, box_of_rings(fragments)};
  return last.box;
}

class SphereTraits final : public PrimitiveTraits {
 public:
  double extent(const Primitive& primitive) const override { return radius_of(primitive); }

  int fragments(const Primitive& primitive, const csgcore::FacetSettings& settings) const override {
    // Facets are chords in two directions (inscribed_share()), and c² ≥ 1 − 2·(1 − c).
    csgcore::FacetSettings of_chords = settings;
    of_chords.tolerance = settings.tolerance / 2;
    return csgcore::fragment_count(radius_of(primitive), of_chords);
  }
  Box faceted_box(const Primitive& primitive,
                  const csgcore::FacetSettings& settings) const override {
    const Box& unit = unit_sphere_box(fragments(primitive, settings));
    return {radius_of(primitive) * unit.min, radius_of(primitive) * unit.max};
  }
  Faceting faceting(const Primitive& primitive, int fragments) const override {
    const auto bands = static_cast<uint64_t>(csgcore::ring_count(fragments) - 1);
    return {csgcore::make_sphere(1), Vec3(0.0), Vec3(radius_of(primitive)),
            bands * static_cast<uint64_t>(fragments) + 2};
  }
  RevolvedFaces revolved_faces(const Primitive& primitive, int fragments) const override {
    return {csgcore::sphere_mesh(radius_of(primitive), fragments), true};
  }

  Roundness roundness(const Primitive& primitive) const override {
    return {Roundness::About::kCenter, {radius_of(primitive), 0}, {}};
  }

  /// The facets are chords of the rings, and of the meridians, along which rings are 180°/rings
  /// apart. The middle of a chord is nearest to the centre.
  double inscribed_share(int fragments) const override {
    return std::cos(std::numbers::pi / fragments) *
           std::cos(std::numbers::pi / (2 * csgcore::ring_count(fragments)));
  }
  std::optional<RadialPlace> radial_place(const Primitive& primitive,
                                          const Vec3& point) const override {
    return RadialPlace{point, radius_of(primitive), radius_of(primitive), 0.5};
  }
};

constexpr SphereTraits kSphereTraits;

}  // namespace

constinit const PrimitiveTraits& Sphere_traits = kSphereTraits;

}  // namespace frontend
