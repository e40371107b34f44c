// Solids made of plane figures: extruded along z, or revolved about it.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "csgcore/polyhedron.hpp"
#include "csgcore/primitive.hpp"
#include "csgcore/profile.hpp"
#include "plane/figure.hpp"

namespace frontend {

/// The layers of an extrusion: at z_min the figure is itself, and at z_max it is scaled about the
/// origin.
struct Layers {
  double z_min = 0;  // < z_max
  double z_max = 0;
  double top_scale = 1;  // ≥ 0
  Vec2 lean{0.0};  // how far x and y are moved for each unit of z; FigureSolids leaves that out
};

/// Makes the solids of a design. Those that have the same local solid share it.
class FigureSolids {
 public:
  using Profile = std::shared_ptr<const csgcore::Profile>;

  /// Returns the extruded figure: a frustum, a convex polyhedron or an extruded profile. Nothing if
  /// the figure is empty. `made` is its profile, where that is made already.
  std::optional<csgcore::Primitive> extruded(const Figure& figure, const Layers& layers,
                                             const Profile& made = {});

  /// Returns the figure revolved by a full turn about z: x becomes the radius, and y becomes z. No
  /// point has x < 0. It is a sphere, a frustum or a revolved profile. Nothing if the figure is
  /// empty.
  std::optional<csgcore::Primitive> revolved(const Figure& figure);

  /// Returns the part of space around z between the azimuths 0 and `angle` (from above 0 to 180),
  /// within the radius and from z_min to z_max at least.
  csgcore::Primitive wedge(double angle, double radius, double z_min, double z_max);

 private:
  using Polyhedron = std::shared_ptr<const csgcore::Polyhedron>;

  csgcore::Primitive prism(const Polygon& corners, const Layers& layers);
  Profile profile(const Outline& outline);

  std::map<std::vector<double>, Polyhedron> prisms_;
  std::map<std::vector<double>, Profile> profiles_;
};

}  // namespace frontend
