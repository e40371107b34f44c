// The faces of a solid, from the pieces that it keeps.
#pragma once

#include <cstdint>
#include <vector>

#include "arrangement/pieces.hpp"

namespace csgcore {

/// A triangle of the solid's boundary: points of Pieces, counterclockwise seen from outside.
struct FaceTriangle {
  std::array<uint32_t, 3> points;
  uint32_t operand;  // whose face it shows
};

struct KeptPiece {
  uint32_t piece;
  FaceTriangle triangle;
};

/// Returns the triangles of kept pieces. Compared ones near sheets that lie in one plane and show
/// one operand become one face, which has no points along its edges but where other faces end.
std::vector<FaceTriangle> merged_faces(const Pieces& pieces, const std::vector<KeptPiece>& kept);

}  // namespace csgcore
