// Single rays through a scene's model, and what is known of the surfaces that they meet.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "csgcore/image.hpp"
#include "csgcore/primitive.hpp"
#include "csgcore/view.hpp"
#include "projection.hpp"
#include "surface.hpp"

namespace window {

struct RayHit {
  csgcore::Vec3 position{0.0};  // world space
  csgcore::Vec3 normal{0.0};    // unit, outward of the solid
  uint32_t primitive = 0;
  Surface surface;
};

/// Returns what each pixel of a view sees of the model.
using Look = std::function<csgcore::Hits(const csgcore::View&)>;

class ModelRays {
 public:
  /// `primitives` are those of the scene. They must outlive this object.
  ModelRays(Look look, std::span<const csgcore::Primitive> primitives);

  /// Returns the first place at which the model begins or ends on the way from a point along a unit
  /// direction, if it is no further than `reach`.
  std::optional<RayHit> along(const csgcore::Vec3& from, const csgcore::Vec3& direction,
                              double reach) const;
  /// Does the same all around a point, in 32 directions across a unit normal.
  std::vector<RayHit> across(const csgcore::Vec3& from, const csgcore::Vec3& normal) const;
  /// Returns what a view shows at a place.
  std::optional<RayHit> seen_at(const csgcore::View& view, const PicturePoint& place) const;
  /// Returns what it shows in a square around the place, one ray a pixel.
  std::vector<RayHit> seen_around(const csgcore::View& view, const PicturePoint& place,
                                  uint32_t side_px) const;

  /// Returns whether nothing of the model hides a point of its surface.
  bool shows(const csgcore::View& view, const csgcore::Vec3& point) const;

  std::span<const csgcore::Primitive> primitives() const { return primitives_; }

 private:
  RayHit hit_of(const csgcore::Hits& hits, std::size_t pixel) const;
  void add_hits(const csgcore::View& view, std::vector<RayHit>& result) const;

  Look look_;
  std::span<const csgcore::Primitive> primitives_;
};

/// Returns the ray through a place of a view; its direction has unit length.
csgcore::Ray ray_through(const csgcore::View& view, const PicturePoint& place);

/// Returns a unit vector across a unit axis, at an angle about it.
csgcore::Vec3 direction_across(const csgcore::Vec3& axis, double angle_rad);

}  // namespace window
