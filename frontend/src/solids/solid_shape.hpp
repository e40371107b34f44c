// The solids of nodes without children.
#pragma once

#include <optional>
#include <string>

#include "arguments/node_data.hpp"
#include "csgcore/facets.hpp"
#include "csgcore/primitive.hpp"
#include "solids/figure_solids.hpp"
#include "solids/import_files.hpp"
#include "solids/solid_pool.hpp"

namespace frontend {

/// What makes and reads the solids of a design.
struct SolidSources {
  PolyhedronPool& polyhedra;
  FileImports& files;
  FigureSolids& figures;
  SolidPool& pool;
};

/// A solid in its own coordinates, without colour and id.
struct SolidShape {
  csgcore::Primitive primitive;
  csgcore::FacetSettings facets{};        // of what is round
  const SolidOfFaces* faces = nullptr;    // that it is made of, where it is
  std::string file{};                     // that the faces are from, as the design names it
  std::optional<csgcore::Color> color{};  // that the file gives to all of it
};

/// Returns the solid of a node whose row has Role::kSolid; nothing if it is empty. Tells what is
/// wrong with its file.
std::optional<SolidShape> solid_shape(const NodeData& data, const Node& node,
                                      const SolidSources& sources, NodeProblems& problems);

}  // namespace frontend
