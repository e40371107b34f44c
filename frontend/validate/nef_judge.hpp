// Judges rays, by the definition of NUMERICS.md §1, and points by the Nef oracle.
#pragma once

#include <array>
#include <vector>

#include "csgcore/scene.hpp"
#include "oracle/nef_solid.hpp"
#include "ray_judge.hpp"

namespace validation {

/// A scene of polyhedra and meshes, and its solid by CGAL.
class NefTruth {
 public:
  /// Builds the solid of a scene whose primitives are polyhedra or meshes. `size` is the design's
  /// (the diagonal of its box), `thickness` the tolerance of the regularised operations. Throws
  /// std::system_error.
  NefTruth(const csgcore::Scene& scene, double size, double thickness,
           const oracle::NefLimits& limits);

  /// The outcome of the building. If the solid was not built, no other function may be called.
  oracle::NefStatus status() const { return build_.status; }
  const std::string& reason() const { return build_.reason; }

  const oracle::NefSolid& solid() const { return *build_.solid; }
  double size() const { return size_; }
  double thickness() const { return thickness_; }
  /// How far rounding may displace a surface for a renderer in double, in world units.
  double displacement() const { return displacement_; }

  /// The primitive whose surface is nearest, and an upper bound of its distance. For a mesh it is
  /// the distance of a triangle's plane, or of a vertex if the point is beside the triangle.
  struct NearSurface {
    uint32_t primitive;
    double distance;
  };
  NearSurface nearest_surface(const csgcore::Vec3& point) const;
  /// Returns whether the primitive has a face with that normal, or its opposite, whose plane is
  /// within `distance` of the point.
  bool has_face_at(uint32_t primitive, const csgcore::Vec3& point, const csgcore::Vec3& normal,
                   double distance) const;

 private:
  struct WorldPlane {
    csgcore::Vec3 unit_normal;
    double offset;
  };

  /// The surface of a primitive in the world. A polyhedron has no triangles.
  struct Surface {
    std::vector<WorldPlane> planes;
    std::vector<std::array<csgcore::Vec3, 3>> triangles;  // of a mesh, by plane
    double distance(const csgcore::Vec3& point) const;
  };

  static Surface surface_of(const csgcore::Primitive& primitive);

  std::vector<Surface> surfaces_;  // of each primitive
  double size_, thickness_, displacement_;
  oracle::NefBuild build_;
};

/// The truth must outlive the judge.
std::unique_ptr<RayJudge> make_nef_judge(const NefTruth& truth, const Tolerance& tolerance);

/// Judges the claim that the point is in the solid (or not). The error is how far a wrong point is
/// from the nearest surface of a primitive, below or above it, as a share of the size.
Verdict judge_point(const NefTruth& truth, const csgcore::Vec3& point, bool claimed_inside);

}  // namespace validation
