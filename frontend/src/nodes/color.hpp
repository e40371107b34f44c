// The colour that a color node sets.
#pragma once

#include <optional>

#include "csgcore/primitive.hpp"
#include "nodes/node_reader.hpp"

namespace frontend {

/// Nothing if it says nothing.
using NodeColor = std::optional<csgcore::Color>;

/// Returns none if the colour is invalid (in a .csg: -1,-1,-1,±1), which for a name that is no
/// colour is a problem. Channels above 1 count as 1.
NodeColor read_color(NodeReader& reader);

}  // namespace frontend
