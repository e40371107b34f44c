// What the importer makes of a design's file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "csgcore/geometry.hpp"
#include "csgcore/scene.hpp"
#include "frontend/error.hpp"
#include "frontend/facet_mesh.hpp"
#include "frontend/turned_frames.hpp"

namespace frontend {

struct ImportedDesign {
  csgcore::Scene scene;
  /// What OpenSCAD's --viewall looks at: the union of the positive leaves' boxes, each the box of
  /// the corners of the (faceted) leaf's local box under its matrix, `%` and `#` parts included
  /// (frontend/OPENSCAD.md, "Camera"). Empty for an empty design.
  csgcore::Box view_box;
  /// How far the axes are drawn, in distances of the camera.
  double axes_reach = 1;
  /// Primitive nodes in the file, empty, invalid and `%` ones included.
  uint32_t primitive_nodes = 0;
  /// The leaves of OpenSCAD's preview (frontend/OPENSCAD.md, "Leaves") that are drawn, and those of
  /// them that hold several primitives.
  uint32_t leaves = 0;
  uint32_t compound_leaves = 0;
  /// The hulls and Minkowski sums in which facets, finer than a pixel, stand for what is round and
  /// has no exact form.
  uint32_t faceted_leaves = 0;
  /// The nodes that are left out.
  uint32_t left_out = 0;
  /// By Primitive::id, as many as there are such nodes, where ImportOptions::keeps_places asks for
  /// it: the index of the node that the primitive is made of, which is a primitive node, or the
  /// root of a subtree that is one solid or figure (a hull, an extrusion, an offset).
  std::vector<uint32_t> places;
  /// With `places`: by Primitive::id, the part of the assembly that the node is in, from 0 on.
  std::vector<uint32_t> parts;
  std::vector<Warning> warnings;
  /// The files that its nodes name, and the fonts that it brings along if it has text, whether or
  /// not they are there.
  std::vector<std::string> files;
  /// Whether this is a final render (PictureKind::kRendered) of a plane figure, or another picture
  /// of plane figures alone. The scene has thin plates for them.
  bool is_plane_figure = false;
  /// The edges of the plane figure cross too often for its outlines (kMostCrossings), which are
  /// missing.
  bool is_tangle = false;
  /// The outlines of a final render's plane figure, closed, at z = 0.
  std::vector<std::vector<csgcore::Vec3>> flat_outlines;
  /// OpenSCAD's meshes of the scene's polyhedra, where ImportOptions::keeps_meshes asks for them.
  FacetMeshes meshes;
  /// Where ImportOptions::keeps_frames asks for them.
  TurnedFrames turned_frames;
};

}  // namespace frontend
