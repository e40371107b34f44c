// What is known of a primitive's surface at one of its points: that it is flat, or round about an
// axis or a centre.
#pragma once

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
  };
  Kind kind = Kind::kOther;
  csgcore::Vec3 origin{0.0};     // a point of the plane or of the axis; the centre
  csgcore::Vec3 direction{0.0};  // unit: the plane's outward normal; along the axis
  /// Of what is round: the radius there. Of a plane: that of the round end whose centre `origin`
  /// is; 0: it is no round end.
  double radius = 0;
};

/// Returns what the surface is at a point of it, where the outward unit normal of the solid, or of
/// what is cut out of it, is `normal`. What is round and was stretched or sheared is kOther.
Surface surface_at(const csgcore::Primitive& primitive, const csgcore::Vec3& position,
                   const csgcore::Vec3& normal);

/// Returns lines that describe it: radius, centre, axis, normal; none of kOther.
std::vector<std::string> words_of(const Surface& surface);

/// Returns how two of them lie to each other: the distance of parallel faces, of axes, of centres,
/// or the angle. Nothing if one of them is kOther.
std::optional<std::string> relation_of(const Surface& a, const Surface& b);

/// Returns "[1, 2, 3]", with six digits.
std::string coordinates(const csgcore::Vec3& v);

}  // namespace window
