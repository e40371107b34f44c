// The parts of the scenes of growth_scenes.cpp.
#pragma once

#include <cstdint>
#include <random>

#include "csgcore/scene.hpp"

namespace frame_benchmark {

using csgcore::Vec3;

/// The radius, and half of the height, of the body, a cylinder about the origin.
constexpr double kBody = 10;

/// A ball that contains a part.
struct Place {
  Vec3 center;
  double reach;
};

/// The distance from growth_view()'s eye to the middle of the body.
double distance_to_body();
/// The world units of a pixel at that distance.
double pixel_at_body();
/// The picture's width divided by its height.
double aspect();
/// Returns a point. `across` and `upwards` count in half heights of the picture from its middle,
/// `depth` along the view axis.
Vec3 on_screen(double across, double upwards, double depth);

/// Returns whether the ball is inside what the holes leave of the body.
bool is_in_core(const Place& place);
bool is_off_body(const Place& place);
/// Returns whether all rays to the ball pass through the core first.
bool is_in_shadow(const Place& place);

/// Builds one scene, which is random, but always the same.
class Composer {
 public:
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  /// Returns true or false with equal chances.
  bool toss() { return uniform(0, 1) < 0.5; }
  Vec3 direction();

  void open(csgcore::Op op) { tree_.open(op); }
  void close() { tree_.close(); }
  void add(csgcore::Primitive primitive);
  void add_ball(const Place& place);
  /// Adds a sphere, a cylinder or a cone that fills the ball.
  void add_part(const Place& place);

  /// Opens a difference and leaves it open: the body minus holes that face the eye.
  void open_body();
  /// Opens a difference with a plate that fills the picture, at right angles to the view.
  void open_plate(double radius);
  void add_body() {
    open_body();
    close();
  }

  /// Returns a radius, for a part 1 to 8 pixels across.
  double part_reach() { return uniform(0.05, 0.3); }
  /// `nearest` and `furthest` are depths in units of distance_to_body().
  Place anywhere_on_screen(double nearest, double furthest);
  Place anywhere_in_body();
  Place anywhere_in(const Place& ball);
  /// A point of the body's surface.
  struct SurfacePoint {
    Vec3 position, normal;
  };
  SurfacePoint anywhere_on_body();
  /// Returns the first result of `place` that `fits` accepts.
  template <typename MakePlace, typename Fits>
  Place find(MakePlace&& place, Fits&& fits) {
    for (;;) {
      const Place found = place();
      if (fits(found)) return found;
    }
  }

  csgcore::Scene finish();

 private:
  std::mt19937 random_{1};
  csgcore::Scene scene_;
  csgcore::CsgTreeBuilder tree_;
};

/// The radius of the plate's holes, half of its thickness, and the depth of its face.
constexpr double kPlateHole = 0.6;
constexpr double kHalfPlate = 0.5;
double plate_depth();

}  // namespace frame_benchmark
