// Operations on plane figures that yield polygons, by the Clipper library.
//
// The library works in whole numbers. Its grid is 2^-29 of the size of what is computed, and 2^-20
// or finer up to sizes of 2^40, where OpenSCAD's is 2^-16. A coordinate of the result that lies on
// the same line of the grid as one of an operand is that operand's, to the last bit.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "csgcore/csg_tree.hpp"
#include "plane/figure.hpp"

namespace frontend {

/// Polygons that do not cross themselves or each other. The filled ones run counterclockwise, their
/// holes clockwise.
using SimplePolygons = Polygons;

/// The most crossings between edges of the operands that are computed. To find so many takes about
/// a second; OpenSCAD takes its time for any number.
constexpr uint64_t kMostCrossings = 1 << 19;

/// Returns the union of the figures; nothing if their edges cross too often (kMostCrossings).
std::optional<SimplePolygons> united(std::span<const Figure> figures, const Chords& chords = {});

/// Returns what the operation makes of the operands. Nothing if their edges cross too often.
std::optional<SimplePolygons> combined(csgcore::Op op, std::span<const SimplePolygons> operands);

/// What becomes of the corners where an outline is moved.
enum class Corners : uint8_t {
  kRound,   // arcs, as chords
  kSharp,   // the edges run on until they meet
  kSquare,  // cut at the distance
};

/// Moves the outline outwards by a distance, or inwards if it is negative. `fragments` is the
/// number of chords of a whole circle for kRound.
SimplePolygons moved_outline(const SimplePolygons& polygons, double distance, Corners corners,
                             int fragments);

}  // namespace frontend
