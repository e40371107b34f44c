#include "frontend/facet_mesh.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace frontend {
/// A face between rings has corners at two heights in pairs, in the order of csgcore's bands: lower
/// i, lower i + 1, upper i + 1, upper i. The caps have all corners at one height.
bool RevolvedFaces::is_cut(const std::vector<uint32_t>& face) const {
  return cuts_bands && face.size() == 4 && mesh.vertices[face[0]].z != mesh.vertices[face[3]].z;
}

FacetMesh facet_mesh(RevolvedFaces faces) {
  FacetMesh result;
  std::vector<std::array<uint32_t, 2>> pairs;
  for (const std::vector<uint32_t>& face : faces.mesh.faces) {
    uint32_t last = face.back();
    for (const uint32_t vertex : face) {
      pairs.push_back({std::min(last, vertex), std::max(last, vertex)});
      last = vertex;
    }
    if (faces.is_cut(face)) result.edges.push_back({face[3], face[1]});
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  for (const auto& [from, to] : pairs) result.edges.push_back({from, to});
  result.mesh = std::move(faces.mesh);
  return result;
}

}  // namespace frontend
