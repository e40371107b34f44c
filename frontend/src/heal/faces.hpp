// The plane faces of primitives, for healing: caps of frusta, and the faces of polyhedra.
#pragma once

#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "csgcore/primitive.hpp"

namespace frontend {

/// Polyhedra of more faces are curved in the design: no face of theirs is compared with others.
constexpr uint32_t kMostComparedFaces = 32;

/// A plane face in the world.
struct Face {
  csgcore::Vec3 center;  // on the plane, amid the corners
  csgcore::Vec3 normal;  // unit; a cap's points to z_max, a polyhedron's outwards, but for mirrors
};

/// Answers from a primitive's present matrix. Faces are numbered from 0: a frustum's caps are 0 at
/// z_min and 1 at z_max, those of a polyhedron are its half-spaces. Keeps what it has found out of
/// polyhedra, by address: they must outlive it.
class Faces {
 public:
  /// 0 for spheres, and for polyhedra of more than kMostComparedFaces.
  uint32_t count(const csgcore::Primitive& primitive);
  Face at(const csgcore::Primitive& primitive, uint32_t face);
  /// What spans the face in the world, three points or more on its plane: a polyhedron's vertices,
  /// or points of a cap's rim.
  std::vector<csgcore::Vec3> corners(const csgcore::Primitive& primitive, uint32_t face);
  /// The face that is parallel to the other one, in every affine image.
  std::optional<uint32_t> opposite(const csgcore::Primitive& primitive, uint32_t face);
  /// It is a polyhedron with three pairs of parallel faces.
  bool is_parallelepiped(const csgcore::Primitive& primitive);

 private:
  struct LocalFace {
    csgcore::Vec3 center, normal;
    std::vector<csgcore::Vec3> corners;
    std::optional<uint32_t> opposite;
  };
  struct LocalFaces {
    std::vector<LocalFace> faces;
    bool is_parallelepiped = false;
  };
  static LocalFaces faces_of(const csgcore::Polyhedron& polyhedron);
  const LocalFaces& local(const csgcore::Primitive& primitive);

  std::unordered_map<const csgcore::Polyhedron*, LocalFaces> known_;
  const csgcore::Polyhedron* last_ = nullptr;  // most cubes come after a cube
  const LocalFaces* last_faces_ = nullptr;
};

/// Unit vectors, or planes, are parallel if their cross product is no longer: far above the
/// rounding of doubles, far below what six digits write. What is moved by rounding's 1e-6 stays so
/// near to a plane that it runs along.
constexpr double kParallel = 1e-9;
bool parallel(const csgcore::Vec3& unit_a, const csgcore::Vec3& unit_b);

}  // namespace frontend
