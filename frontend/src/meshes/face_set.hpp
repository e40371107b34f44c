// The faces of a solid as a file or a polyhedron() lists them, and what is made of them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <vector>

#include "csgcore/color.hpp"
#include "csgcore/facets.hpp"
#include "csgcore/geometry.hpp"
#include "csgcore/triangle_mesh.hpp"

namespace frontend {

/// Faces, each counterclockwise as seen from outside. Large ones have millions, so that all corners
/// are in one list.
struct FaceSet {
  std::vector<csgcore::Vec3> points;
  std::vector<uint32_t> corners;  // points by their indices, face by face
  std::vector<uint32_t> ends;  // by face: one past its last corner. Empty: all have three corners
  /// By face; empty: no face has a colour of its own.
  std::vector<std::optional<csgcore::Color>> colors{};

  size_t face_count() const { return ends.empty() ? corners.size() / 3 : ends.size(); }
  std::span<const uint32_t> face(size_t index) const;
  /// Ends a face with the corners that were added since the last one.
  void end_face() { ends.push_back(static_cast<uint32_t>(corners.size())); }
};

/// Makes equal points one, drops points that no face has, equal neighbours within a face, and then
/// faces with fewer than three corners, or with a point that is not finite. Returns how many faces
/// were not finite.
uint64_t tidy(FaceSet& faces);

/// Makes points one that are at ends of open edges, which faces do not pass as often in one
/// direction as in the other, and lie in the same cell of a grid, or in neighbouring ones.
void weld(FaceSet& faces, double cell);

/// Takes the colours away if they are all the same, and returns that one.
std::optional<csgcore::Color> take_common_color(FaceSet& faces);

/// Projects a face along an axis (frontend/OPENSCAD.md, "Polyhedra"). `places` becomes
/// the places of its corners in that plane, in which it runs counterclockwise. `ends` has one past
/// the last corner of each of its rings.
void project(std::span<const csgcore::Vec3> points, std::span<const uint32_t> corners,
             std::span<const uint32_t> ends, std::vector<glm::dvec2>& places);

/// Returns the volume that the faces enclose, but for rounding. It is negative if they run
/// clockwise.
double enclosed_volume(const FaceSet& faces);

/// Returns the faces as csgcore has them.
csgcore::Mesh to_mesh(const FaceSet& faces);

/// Returns the triangles that OpenSCAD cuts the faces into: it projects a face along an axis
/// (frontend/OPENSCAD.md, "Polyhedra"), and triangulates it there (triangulation.hpp).
std::vector<csgcore::TriangleMesh::Triangle> triangles_of(const FaceSet& faces);
/// Does the same. `colors` becomes the colours of the triangles; empty if the faces have none.
std::vector<csgcore::TriangleMesh::Triangle> triangles_of(
    const FaceSet& faces, std::vector<std::optional<csgcore::Color>>& colors);

/// Faces that may have holes. Each is bounded by rings of points: those around it run
/// counterclockwise as seen from outside, those around its holes clockwise.
struct RingedFaces {
  std::vector<csgcore::Vec3> points;
  std::vector<uint32_t> corners;    // points by their indices, ring by ring
  std::vector<uint32_t> ring_ends;  // by ring: one past its last corner
  std::vector<uint32_t> face_ends;  // by face: one past its last ring

  std::span<const uint32_t> ring(size_t index) const {
    const uint32_t begin = index == 0 ? 0 : ring_ends[index - 1];
    return {corners.data() + begin, ring_ends[index] - begin};
  }
  void end_ring() { ring_ends.push_back(static_cast<uint32_t>(corners.size())); }
  void end_face() { face_ends.push_back(static_cast<uint32_t>(ring_ends.size())); }
};

/// Returns the faces without holes as they are, and the triangles of all others.
FaceSet face_set_of(RingedFaces faces);

/// Returns one side of a closed body that encloses nothing, up to rounding, and of which OpenSCAD
/// shows the faces: it lies in a plane, or each of its triangles runs both ways. Empty for all
/// other bodies.
std::vector<csgcore::TriangleMesh::Triangle> sheet_of(
    std::span<const csgcore::Vec3> points,
    std::span<const csgcore::TriangleMesh::Triangle> triangles);

}  // namespace frontend
