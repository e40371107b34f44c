// Faces that may have holes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "csgcore/geometry.hpp"
#include "meshes/face_set.hpp"

namespace frontend {

/// Faces that are each bounded by rings of points: those around it run counterclockwise as seen
/// from outside, those around its holes clockwise.
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

}  // namespace frontend
