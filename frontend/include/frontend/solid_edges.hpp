// The edges and vertices of a design's solid, as of a mesh (frontend/OPENSCAD.md, "Edges").
#pragma once

#include <cstdint>
#include <vector>

#include "csgcore/geometry.hpp"
#include "frontend/imported_design.hpp"

namespace frontend {

/// All positions are in world space.
struct SolidEdges {
  struct Edge {
    csgcore::Vec3 from, to;
    bool is_cut;  // it has the colours of cut faces
  };
  struct Vertex {
    csgcore::Vec3 position;
    bool is_cut;
  };
  std::vector<Edge> edges;  // an edge that two primitives share may be listed twice
  std::vector<Vertex> vertices;
  bool is_complete = true;  // false: the limit was reached, and edges are missing
};

/// The number of steps, each of which compares a point with a plane or a box with a box, after
/// which the search for edges ends. So many take about ten seconds.
constexpr uint64_t kMostEdgeSteps = uint64_t{1} << 30;

/// Finds the edges of the model, whose primitives must have meshes (ImportOptions::keeps_meshes).
/// A primitive without one has no edges itself, and cuts those of others to a sixteenth.
SolidEdges solid_edges(const ImportedDesign& design, uint64_t most_steps = kMostEdgeSteps);

}  // namespace frontend
