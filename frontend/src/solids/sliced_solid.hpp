// The solid between the layers of an extrusion that is cut into slices, and how it is cut.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "csgcore/facets.hpp"
#include "csgcore/primitive.hpp"
#include "plane/figure.hpp"
#include "plane/outlines.hpp"

namespace frontend {

/// Where a layer of an extrusion has the points of the figure.
struct TwistedLayer {
  double cosine, sine;
  Vec2 scale;

  Vec2 image(const Vec2& point) const {
    return scale * Vec2(cosine * point.x - sine * point.y, sine * point.x + cosine * point.y);
  }
};

/// Layers of a figure from z_min to z_max. At the share t of the way up, the figure is turned by
/// −t·twist about the origin, and then scaled by 1 − t·(1 − top_scale), by coordinate.
struct TwistedLayers {
  double z_min = 0;  // < z_max
  double z_max = 0;
  double twist = 0;     // degrees, finite
  Vec2 top_scale{1.0};  // ≥ 0

  double height() const { return z_max - z_min; }
  double turn() const;           // radians, ≥ 0
  double largest_scale() const;  // ≥ 1
  bool is_twisted() const { return twist != 0 || top_scale.x != top_scale.y; }
  Vec2 scale_at(double share) const { return 1.0 - share * (1.0 - top_scale); }
  TwistedLayer at(double share) const;
};

/// Returns OpenSCAD's number of slices, where the design gives none. With r the largest distance of
/// a corner from the origin, m = ⌈|twist|/120⌉, and $fa and $fs without a lower bound, it is the
/// first of these that applies:
/// - r < 2^-20, or $fn is inf or nan: m
/// - twist, $fn > 0: the larger of m and ⌈|twist|·$fn/360⌉
/// - twist: the larger of m and the smaller of ⌈|twist|/$fa⌉ and ⌈L/$fs⌉, where L is the length of
///   the helix, or conical spiral, of the farthest corner; scales that differ do not count
/// - no twist, $fn > 0: $fn without its fraction
/// - no twist: ⌈L/$fs⌉, where L is the longest way of a corner, from the bottom to the top
/// With `counts_scale`, which OpenSCAD 2021.01 does not know, scales that differ ask for no fewer
/// slices with a twist than without.
double slice_count(const TwistedLayers& layers, const SimplePolygons& outline,
                   const csgcore::FacetSettings& facets, bool counts_scale = false);

/// Returns the largest distance of the outline from the origin.
double reach_of(const SimplePolygons& outline);
/// Cuts each edge into as many pieces of equal length as `count` has for it.
Polygon cut(const Polygon& polygon, const std::vector<int>& count);

/// Slices, and an outline whose edges are cut, between which triangles are to be spanned.
struct Slicing {
  int slices = 1;
  SimplePolygons outline;
  /// By polygon: how many corners further the sides of a slice go on at its upper end. Edge i at
  /// the lower end faces edge (i + offset) modulo the number of corners.
  std::vector<size_t> offsets;
};

/// The most triangles of the sides of an extrusion.
constexpr double kMostSideTriangles = 1 << 20;
/// Returns the slices without their fraction, or as many as kMostSideTriangles allows.
int affordable_slices(double slices, size_t edges);

/// Returns OpenSCAD's slices, with edges that are cut to get `segments` of them for each polygon,
/// if that is given. There are fewer slices if the triangles would be more than kMostSideTriangles.
Slicing openscad_slicing(double slices, const std::optional<double>& segments,
                         SimplePolygons outline);

/// Returns the slices of OpenSCAD's development snapshots, with edges cut into ⌈L/$fs⌉ pieces,
/// where L is the length of the longest image that the edge has in a layer; or for $fn > 0, where
/// `segments` are given, or where a polygon gets fewer by ⌈360/$fa⌉ segments, as many of them as
/// openscad_slicing() has, by these lengths.
Slicing cut_slicing(const TwistedLayers& layers, double slices,
                    const std::optional<double>& segments, const csgcore::FacetSettings& facets,
                    SimplePolygons outline);

/// Returns the closed mesh. Of the two diagonals of a quadrilateral of the sides it takes the one
/// that OpenSCAD takes. The polygons of the outline do not cross.
csgcore::Primitive sliced_mesh(const TwistedLayers& layers, const Slicing& slicing);

/// Returns the sides that a slice folds flat, each as two open meshes, its triangles: where a slice
/// turns by exactly half a turn, and both its ends are scaled alike, each side lies in one plane
/// and crosses itself, so that it encloses nothing, while OpenSCAD shows its two triangles.
std::vector<csgcore::Primitive> folded_sides(const TwistedLayers& layers, const Slicing& slicing);

/// Returns the box of the corners of all layers.
csgcore::Box sliced_box(const TwistedLayers& layers, int slices, const SimplePolygons& outline);

}  // namespace frontend
