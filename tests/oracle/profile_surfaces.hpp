// How far points are from the surface of a profile's solid, in extended precision.
#pragma once

#include "csgcore/primitive.hpp"
#include "ray_oracle.hpp"
#include "support/kinds/profile_figure.hpp"

namespace oracle {

/// The faces of an extrusion or a revolution, relative to a pivot.
class ProfileSurfaces {
 public:
  /// The primitive must outlive this object.
  ProfileSurfaces(const csgcore::Primitive& primitive, const csgcore::Vec3& pivot);

  /// Returns the distance of a point from the nearest face, to first order, in world units. It is
  /// right next to the surface.
  csgcore::Real distance(const csgcore::LongVec3& point) const;
  /// Returns a bound from above of the solid's least extent across the figure's axes or the plane,
  /// in world units.
  csgcore::Real thickness() const;

 private:
  using LongVec2 = csgcore::reference::LongVec2;
  struct Gap {
    csgcore::Real outside;
    LongVec2 outwards;  // of length 1
  };
  static Gap gap(const csgcore::reference::FigureEdge& edge, const LongVec2& place);
  csgcore::Real in_world(csgcore::Real outside, const csgcore::LongVec3& gradient) const;
  csgcore::Real from_revolution(const csgcore::LongVec3& local) const;
  csgcore::Real from_extrusion(const csgcore::LongVec3& local) const;

  const csgcore::Primitive& primitive_;
  const csgcore::reference::Figure figure_;
  const csgcore::checks::LongMat3 world_to_local_;
  const csgcore::LongVec3 pivot_;  // relative to the local origin
};

}  // namespace oracle
