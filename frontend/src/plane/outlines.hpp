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

/// Returns the outline, which has no curves, without what is empty, and with edges that cross cut
/// there as far as that can be afforded; nothing if all is empty.
std::optional<Figure> cleaned(Outline outline);

/// What OpenSCAD takes for rounding.
constexpr double kOpenScadsRounding = 1.415 * 0x1p-16;

/// Returns the polygons without the corners that are within `rounding` of a neighbour or of the
/// line through both neighbours. A polygon of which nothing else is left stays as it is.
SimplePolygons without_slight_corners(SimplePolygons polygons, double rounding);

/// Returns the polygons with fewer corners where they bend smoothly: an edge takes the place of
/// several that turn by no more than one of 24 in a circle does, and whose corners are within
/// `tolerance` of it. A turn that no such edge has stays as it is; so do all polygons if fewer
/// corners would make them cross.
SimplePolygons with_fewer_corners(SimplePolygons polygons, double tolerance);

/// Returns figures whose union is that of `figures` with its holes filled; nothing if their edges
/// cross too often. Curves that bound it on the outside stay what they are.
std::optional<std::vector<Figure>> without_holes(std::span<const Figure> figures);

/// What becomes of the corners where an outline is moved.
enum class CornerStyle : uint8_t {
  kRound,   // arcs, as chords
  kSharp,   // the edges run on until they meet
  kSquare,  // cut at the distance
};

/// Moves the outline outwards by a distance, or inwards if it is negative. `fragments` is the
/// number of chords of a whole circle for kRound.
SimplePolygons moved_outline(const SimplePolygons& polygons, double distance, CornerStyle corners,
                             int fragments);

/// Which chords stand for the round ends and corners of a line.
enum class StrokeChords : uint8_t {
  kFine,    // that no picture shows
  kOf2021,  // OpenSCAD 2021.01's, which computes in multiples of 1e-4
  kOf2026,  // some 50 of a circle
};

/// How a line is drawn that ends.
enum class LineEnds : uint8_t {
  kButt,
  kSquare,  // longer by half the width
  kRound,
};

struct StrokeSettings {
  double width = 1;  // > 0
  LineEnds ends = LineEnds::kSquare;
  CornerStyle corners = CornerStyle::kSharp;  // those of less than 60° are cut square
  StrokeChords chords = StrokeChords::kFine;
};

/// The most crossings of a path that is drawn at all: a ray along it passes thousands of lines, and
/// a picture takes seconds.
constexpr uint64_t kMostCrossingsOfPath = 1 << 23;

/// Returns whether a path that is drawn with a pen of that width crosses itself more often. Boxes
/// that overlap count as crossings.
bool crosses_itself(const Polygon& path, double width, uint64_t most);

/// Returns what a pen draws along the open path, whose points are finite; nothing if it crosses
/// itself too often (kMostCrossings).
std::optional<SimplePolygons> stroked(const Polygon& path, const StrokeSettings& settings);

}  // namespace frontend
