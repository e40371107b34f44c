// Which points of a solid's surface see along a direction: shadows and occlusion without maps.
//
// A direction of light is an orthographic view (paper §5, "from the light source point of view").
// Where a picture's rays go through the centres of pixels, the rays of this view go through the
// points that are asked about, and the solid's lists are restricted to its tiles as for a picture.
// A light at a place is a perspective view, or up to six of them.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <stop_token>

#include "csgcore/geometry.hpp"
#include "csgcore/solid.hpp"
#include "csgcore/view.hpp"

namespace csgcore {

struct FrameRays;

/// Points on a solid's surface, for example those that a picture shows.
struct SurfacePoints {
  std::span<const Vec3> position;  // world space
  std::span<const Vec3> normal;    // by point: unit, world space, outward of the solid
};

/// What a point gets of the light from directions: each counts by its cosine with the point's
/// normal, if that is above 0.
struct LightSum {
  float all = 0;   // of all directions that were asked
  float open = 0;  // of those along which the point sees infinitely far
};

/// Answers for the points of one solid.
class LightTracer {
 public:
  /// Keeps a reference to the solid.
  explicit LightTracer(const Solid& solid);
  ~LightTracer();

  /// Adds a direction, `to_light` (unit, world space), to the points' sums. Crossings of the
  /// solid's boundary that lie less than two thickness tolerances above the point, along its
  /// normal, or less than the rounding of its coordinates, are taken for the face that the point
  /// lies on: beyond that the answer is exact. May be called by several threads at once. A stop
  /// request ends it early, with undefined answers.
  void add_light(const SurfacePoints& points, const Vec3& to_light, std::span<LightSum> sums,
                 const std::stop_token& stop = {}) const;

  /// Sets lit[i] to 1 if point i faces the light and sees infinitely far along `to_light`, or else
  /// to 0.
  void find_lit(const SurfacePoints& points, const Vec3& to_light, std::span<uint8_t> lit,
                const std::stop_token& stop = {}) const;

  /// Does the same for a light at a place (world space): whether the point sees it.
  void find_lit_from(const SurfacePoints& points, const Vec3& light, std::span<uint8_t> lit,
                     const std::stop_token& stop = {}) const;

 private:
  struct Rays;
  struct Memory;
  class Visitor;
  std::unique_ptr<Rays> take_rays() const;
  void look(const FrameRays& frame, std::unique_ptr<Rays> rays, std::span<LightSum> sums,
            const std::stop_token& stop) const;
  const Solid& solid_;
  const std::unique_ptr<Memory> memory_;
};

}  // namespace csgcore
