// From a design's trees over leaves to what the picture is composed of: the model, its layers, and
// the box that --viewall looks at.
#pragma once

#include <span>
#include <vector>

#include "csgcore/geometry.hpp"
#include "csgcore/scene.hpp"
#include "frontend/import_options.hpp"
#include "solids/leaves.hpp"

namespace frontend {

/// A tree over leaves that is drawn by itself.
struct DesignPart {
  csgcore::Layer::Kind kind;
  LeafTree tree;
};

struct Design {
  /// The model, which may be empty, then each `%` part and each `#` part, in file order.
  std::vector<DesignPart> parts;
  std::vector<uint32_t> highlighted_leaves;  // that are parts of `#` nodes, ascending

  const LeafTree& model() const { return parts.front().tree; }
  bool is_highlighted(uint32_t leaf) const;
};

/// Returns the smallest box that holds all of them.
csgcore::Box box_around(std::span<const csgcore::Box> boxes);

/// Sets the scene's trees, and the cut faces of its primitives, which are there already: a leaf
/// that is not subtracted has those alone that are marked, if it may have any (`has_marked_faces`).
/// `boxes` holds the boxes of all leaves. Returns whether all translucent parts have the layers
/// that OpenSCAD gives them: a design with too many has fewer (products.hpp).
bool compose(Design design, const Leaves& leaves, std::span<const csgcore::Box> boxes,
             PictureKind picture, bool has_marked_faces, csgcore::Scene& scene);

/// The box that OpenSCAD's --viewall looks at (frontend/OPENSCAD.md, "Camera").
csgcore::Box view_box(const Design& design, std::span<const csgcore::Box> boxes,
                      bool intersects_boxes);

}  // namespace frontend
