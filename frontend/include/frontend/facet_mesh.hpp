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
  /// An edge between two vertices of the mesh, or the diagonal of a quadrilateral that OpenSCAD
  /// cuts into two triangles: the mesh has the quadrilateral as one face.
  struct Edge {
    uint32_t from, to;
  };
  csgcore::Mesh mesh;
  std::vector<Edge> edges;  // each once
};

/// The meshes of the polyhedra of a design, which have to outlive the table.
using FacetMeshes = std::unordered_map<const csgcore::Polyhedron*, FacetMesh>;

/// The faces of a solid of revolution, as csgcore's sphere_mesh() and frustum_mesh() make them.
struct RevolvedFaces {
  csgcore::Mesh mesh;
  /// OpenSCAD cuts the faces that run between two rings, from the upper vertex i to the lower
  /// vertex i + 1.
  bool cuts_bands = false;

  bool is_cut(const std::vector<uint32_t>& face) const;
};

/// Returns the mesh with its edges.
FacetMesh facet_mesh(RevolvedFaces faces);

}  // namespace frontend
