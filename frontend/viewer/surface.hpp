// What is known of the surface at a point: that it is flat, or round about an axis or a centre, or
// that faces meet there.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "csgcore/primitive.hpp"

namespace window {

/// Everything is in world space.
struct Surface {
  enum class Kind : uint8_t {
    kOther,
    kPlane,
    kAxis,    // round about an axis
    kCenter,  // round about a centre
    kVertex,  // a corner of faces
    kEdge,    // a straight edge of two faces
    kCircle,  // the edge of a face and of what is round about an axis across it
  };
  Kind kind = Kind::kOther;
  csgcore::Vec3 origin{0.0};     // a point of the plane, of the axis or of the edge; the centre or
                                 // vertex
  csgcore::Vec3 direction{0.0};  // unit: the plane's outward normal; along the axis or the edge
  /// Of what is round: the radius there. Of a plane: that of the round end whose centre `origin`
  /// is; 0: it is no round end.
  double radius = 0;
  double length = 0;                                                          // of a straight edge
  std::array<csgcore::Vec3, 2> ends{csgcore::Vec3(0.0), csgcore::Vec3(0.0)};  // of the same
};

/// Returns what the surface is at a point of it, where the outward unit normal of the solid, or of
/// what is cut out of it, is `normal`. What is round and was stretched or sheared is kOther.
Surface surface_at(const csgcore::Primitive& primitive, const csgcore::Vec3& position,
                   const csgcore::Vec3& normal);

/// A wall that is round about an axis: the centres and radii of its two ends.
struct RoundWall {
  std::array<csgcore::Vec3, 2> centers;
  std::array<double, 2> radii;
};

/// Returns the walls of a primitive that are round in world space: cylinders and cones.
std::vector<RoundWall> round_walls(const csgcore::Primitive& primitive);

/// Returns whether two planes are the same, up to rounding.
bool are_same_plane(const Surface& a, const Surface& b);

/// Returns lines that describe it: radius, centre, axis, normal; none of kOther.
std::vector<std::string> words_of(const Surface& surface);

/// Returns how two of them lie to each other: the distance of parallel faces, of axes, of centres
/// and so on, or the angle. Nothing if one of them is kOther.
std::optional<std::string> relation_of(const Surface& a, const Surface& b);

/// Returns "[1, 2, 3]", with six digits.
std::string coordinates(const csgcore::Vec3& v);

}  // namespace window
