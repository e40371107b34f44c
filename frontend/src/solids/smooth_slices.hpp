// Slices of an extrusion that turns, or that is scaled differently in x and y, which come near the
// smooth solid.
#pragma once

#include "solids/sliced_solid.hpp"

namespace frontend {

/// How far triangles may be from smooth sides, as a share of the size: a quarter of a pixel of what
/// is 1,000 pixels wide.
constexpr double kSmoothTolerance = 0x1p-11;

/// So many chords are no farther from a circle than that share of its radius.
constexpr int kSmoothChords = 120;

/// Returns how far triangles may be from the smooth sides of an extrusion: its size is that of its
/// figure, or half its height.
double smooth_tolerance(const TwistedLayers& layers, double reach);

/// Returns whether an extrusion turns so much for its height that its sides are nearly flat, as
/// those of a thread: a point at the distance `reach` moves by several heights.
bool has_flat_sides(const TwistedLayers& layers, double reach);

/// Returns at least as many slices as given, and edges that are cut, so that the triangles are
/// nowhere farther from the smooth sides than smooth_tolerance(). Sides that need too many
/// triangles for that are coarser.
///
/// Flat sides have OpenSCAD's slices unless the outline is round: with corners, more slices would
/// show steps where a thread is meant.
Slicing smooth_slicing(const TwistedLayers& layers, double slices, SimplePolygons outline);

}  // namespace frontend
