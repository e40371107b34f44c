// The meshes that OpenSCAD makes of primitives, with the edges that it draws.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "csgcore/facets.hpp"

namespace csgcore {
class Polyhedron;
}

namespace frontend {

/// A mesh and its edges, in the local coordinates of the polyhedron that is drawn for it.
struct FacetMesh {
  static constexpr uint32_t kNoVertex = 0xFFFFFFFFu;
  /// An edge between two vertices of the mesh.
  struct Edge {
    uint32_t from, to;
    /// If the edge is the diagonal of a quadrilateral that OpenSCAD cuts into two triangles: the
    /// other two corners. The mesh has the quadrilateral as one face. Otherwise kNoVertex.
    uint32_t left = kNoVertex, right = kNoVertex;
    bool is_diagonal() const { return left != kNoVertex; }
  };
  csgcore::Mesh mesh;
  std::vector<Edge> edges;  // each once
};

/// The meshes of the polyhedra of a design, which have to outlive the table.
using FacetMeshes = std::unordered_map<const csgcore::Polyhedron*, FacetMesh>;

/// Returns the mesh with its edges. `cuts_bands`: OpenSCAD cuts the faces of csgcore's
/// sphere_mesh() or frustum_mesh() that run between two rings, from the upper vertex i to the lower
/// vertex i + 1.
FacetMesh facet_mesh(csgcore::Mesh mesh, bool cuts_bands);

}  // namespace frontend
