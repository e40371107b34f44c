#include "meshes/ring_cap.hpp"

namespace frontend {

void close_ring(std::vector<uint32_t> ring,
                std::vector<csgcore::TriangleMesh::Triangle>& triangles) {
  while (ring.size() > 3) {
    // Cuts every second vertex off. The last one stays if their number is odd.
    std::vector<uint32_t> rest;
    for (size_t i = 0; i + 1 < ring.size(); i += 2) {
      rest.push_back(ring[i]);
      triangles.push_back({ring[i], ring[i + 1], ring[(i + 2) % ring.size()]});
    }
    if (ring.size() % 2 != 0) rest.push_back(ring.back());
    ring = std::move(rest);
  }
  if (ring.size() == 3) triangles.push_back({ring[0], ring[1], ring[2]});
}

}  // namespace frontend
