// From the solids of a subtree, and from what openscad has rendered, to primitives.
#pragma once

#include <cstdint>
#include <optional>
#include <stop_token>
#include <string_view>
#include <vector>

#include "csgcore/geometry.hpp"
#include "meshes/face_set.hpp"
#include "plane/figure.hpp"
#include "rendered/rendering.hpp"
#include "solids/hull_pool.hpp"
#include "solids/import_polyhedra.hpp"
#include "solids/solid_value.hpp"
#include "subtrees/lowered_subtree.hpp"

namespace frontend {

/// `frame`, which leads to the world by `to_world`, is where the root stands. The primitives have
/// that id.
LoweredSubtree lower_solid(const SolidValue& value, const csgcore::Affine& to_world, uint32_t frame,
                           uint32_t id, HullPool& hulls);

/// What openscad is asked for.
struct PendingRendering {
  RenderRequest request;
  bool is_plane;         // it is a plane figure
  std::string_view why;  // nothing else makes it
};

/// The solid of a node, and where its primitives belong.
struct PendingSolid {
  uint32_t node;
  uint32_t frame;
  csgcore::Affine to_world;  // of the frame
  uint32_t id;               // of its primitives
  size_t primitives_before;  // of the design
  SolidValue value;
  std::optional<PendingRendering> rendering{};  // in place of the value
};

/// Returns lower_solid() of each that has a value. Throws if it is stopped (throw_if_stopped).
std::vector<LoweredSubtree> lower_all(const std::vector<PendingSolid>& pending, HullPool& hulls,
                                      const std::stop_token& stop);

/// Returns the solid of a request for one (render_text.hpp), which stands in the frame. It has no
/// parts if it is empty.
LoweredSubtree lower_rendered_solid(const RingedFaces& faces, const csgcore::Affine& to_world,
                                    uint32_t frame, uint32_t id, PolyhedronPool& polyhedra);

/// Returns the figure of a request for one; nothing if it is empty.
std::optional<Figure> rendered_figure(const RingedFaces& faces);

}  // namespace frontend
