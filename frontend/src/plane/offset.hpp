// Offsets of plane figures, and Minkowski sums.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "plane/figure.hpp"
#include "plane/outlines.hpp"

namespace frontend {

struct OffsetSettings {
  double distance = 1;  // negative: inwards
  CornerStyle corners = CornerStyle::kRound;
  /// The chords of a whole circle where round corners are to be OpenSCAD's; else they are arcs if
  /// the offset goes outwards, and chords that no picture shows if it goes inwards.
  std::optional<int> fragments{};
  bool has_chord_for_rest = false;  // GeometryDialect's
};

/// Returns figures whose union is the offset of the union of `figures`; nothing if edges cross too
/// often (kMostCrossings).
std::optional<std::vector<Figure>> offset(std::span<const Figure> figures,
                                          const OffsetSettings& settings);

/// Returns what a pen draws along the open path, which has a point, with round corners and ends as
/// arcs; nothing is united, so that it takes as long as the path is.
Figure pen_trace(Polygon path, const StrokeSettings& settings);

/// Returns figures whose union is the Minkowski sum of both unions; nothing if edges cross too
/// often.
std::optional<std::vector<Figure>> minkowski_sum(std::span<const Figure> a,
                                                 std::span<const Figure> b);

}  // namespace frontend
