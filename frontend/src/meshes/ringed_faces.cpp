#include "meshes/ringed_faces.hpp"

#include <array>
#include <utility>

#include "meshes/triangulation.hpp"

namespace frontend {

FaceSet face_set_of(RingedFaces faces) {
  FaceSet result;
  result.points = std::move(faces.points);
  std::vector<uint32_t> corners, ends;
  std::vector<std::array<uint32_t, 3>> triangles;
  std::vector<glm::dvec2> places;
  uint32_t ring = 0;
  for (const uint32_t face_end : faces.face_ends) {
    corners.clear();
    ends.clear();
    for (; ring < face_end; ++ring) {
      const std::span<const uint32_t> of_ring = faces.ring(ring);
      corners.insert(corners.end(), of_ring.begin(), of_ring.end());
      ends.push_back(static_cast<uint32_t>(corners.size()));
    }
    if (ends.size() == 1) {
      result.corners.insert(result.corners.end(), corners.begin(), corners.end());
      result.end_face();
      continue;
    }
    if (corners.empty()) continue;
    triangles.clear();
    project(result.points, corners, ends, places);
    triangulate_all(corners, ends, places, triangles);
    for (const auto& triangle : triangles) {
      result.corners.insert(result.corners.end(), triangle.begin(), triangle.end());
      result.end_face();
    }
  }
  return result;
}

}  // namespace frontend
