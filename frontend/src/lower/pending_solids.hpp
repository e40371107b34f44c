// Solids whose hulls are made after the last node of a design, all of them in parallel.
#pragma once

#include <cstdint>
#include <optional>
#include <stop_token>
#include <string_view>
#include <vector>

#include "csgcore/geometry.hpp"
#include "lower/hull_pool.hpp"
#include "lower/lowered_subtree.hpp"
#include "lower/solid_value.hpp"
#include "rendered/rendering.hpp"

namespace frontend {

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

}  // namespace frontend
