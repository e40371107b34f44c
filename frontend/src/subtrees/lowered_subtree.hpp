// A subtree that OpenSCAD evaluates as a whole, as primitives.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "csgcore/csg_tree.hpp"
#include "csgcore/facets.hpp"
#include "csgcore/geometry.hpp"
#include "csgcore/primitive.hpp"

namespace frontend {

struct LoweredSubtree {
  struct Part {
    csgcore::Primitive primitive;     // under its matrices, in the colour within the subtree
    uint32_t frame;                   // FrameTree
    csgcore::Box box;                 // of the corners that OpenSCAD's facets have, in the world
    csgcore::FacetSettings facets{};  // of what is round
  };
  std::vector<Part> parts;
  csgcore::CsgTree solid;  // over the parts
  bool is_plate = false;
  bool has_operations = false;      // they are those of nodes of solids
  bool is_faceted = false;          // facets, finer than a pixel, stand for something round
  std::optional<csgcore::Box> box;  // of what the operations leave, where that is known
  /// It is a union, of which OpenSCAD takes the corners of the box in the root's coordinates: `box`
  /// is theirs, and may be larger than the boxes of the parts together.
  bool is_union = false;
};

}  // namespace frontend
