// The pieces of a profile's edges.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "csgcore/profile_edge.hpp"

namespace csgcore {

using LongVec2 = glm::tvec2<long double>;

/// See Profile::Piece. Its coordinates are those of the definition.
struct LongPiece {
  LongVec2 start, control, end;
  long double weight;
};

/// Appends the pieces of an edge that begins at `start`. They end exactly at edge.end.
void append_pieces(const Vec2& start, const ProfileEdge& edge, std::vector<LongPiece>& pieces);

}  // namespace csgcore
