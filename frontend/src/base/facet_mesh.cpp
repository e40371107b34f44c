#include "frontend/facet_mesh.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace frontend {
namespace {

/// Returns whether a face has corners at two heights in pairs, in the order of csgcore's bands:
/// lower i, lower i + 1, upper i + 1, upper i. The caps have all corners at one height.
bool is_band_face(const csgcore::Mesh& mesh, const std::vector<uint32_t>& face) {
  return face.size() == 4 && mesh.vertices[face[0]].z != mesh.vertices[face[3]].z;
}

}  // namespace

FacetMesh facet_mesh(csgcore::Mesh mesh, bool cuts_bands) {
  FacetMesh result;
  std::vector<std::array<uint32_t, 2>> pairs;
  for (const std::vector<uint32_t>& face : mesh.faces) {
    uint32_t last = face.back();
    for (const uint32_t vertex : face) {
      pairs.push_back({std::min(last, vertex), std::max(last, vertex)});
      last = vertex;
    }
    if (cuts_bands && is_band_face(mesh, face)) {
      result.edges.push_back({face[3], face[1], face[0], face[2]});
    }
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  for (const auto& [from, to] : pairs) result.edges.push_back({from, to});
  result.mesh = std::move(mesh);
  return result;
}

}  // namespace frontend
