#include "solids/solid_union.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <utility>

#include "base/primitive_traits.hpp"
#include "csgcore/stop_scope.hpp"
#include "csgcore/triangle_mesh.hpp"
#include "solids/leaves.hpp"
#include "solids/surface_edges.hpp"
#include "solids/triangles_of.hpp"

namespace frontend {
namespace {

using csgcore::Box;
using csgcore::TriangleSet;
using csgcore::Vec3;

constexpr std::string_view kBecauseOpenMesh =
    "it needs the outcome of a difference or an intersection with a mesh that is not closed";
constexpr std::string_view kBecauseManyTriangles =
    "it needs the outcome of differences or intersections of more than four million triangles";
/// So many take some seconds and 4 GB.
constexpr size_t kMostTriangles = size_t{1} << 22;

bool is_finite_point(const Vec3& point) {
  return std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z);
}

/// The value without the operands that its parts' boxes tell leave it as it is.
SolidValue without_far_parts(const SolidValue& value) {
  std::vector<Box> boxes;
  for (const SolidPart& part : value.parts) boxes.push_back(part.box);
  SolidValue result;
  result.tree = renamed(pruned(value.tree, boxes), [&](uint32_t part) {
    result.parts.push_back(value.parts[part]);
    return static_cast<uint32_t>(result.parts.size() - 1);
  });
  return result;
}

/// Returns whether the surface is in one piece and turns outwards at all of its edges, but for
/// rounding.
bool bounds_convex(const TriangleSet& surface) {
  const double slack = slack_of(surface);
  const std::vector<SurfaceEdge> edges = edges_of(surface);
  const auto is_reflex = [slack](const SurfaceEdge& edge) { return edge.is_reflex(slack); };
  if (std::ranges::any_of(edges, is_reflex)) return false;
  const std::vector<uint32_t> pieces = pieces_of(surface, edges);
  return std::ranges::all_of(pieces, [](uint32_t piece) { return piece == 0; });
}

SupportSet support_of_points(const std::vector<Vec3>& points, bool is_smooth) {
  SupportSet support;
  support.is_faceted = is_smooth;
  for (const Vec3& point : points) support.generators.emplace_back().center = point;
  return support;
}

}  // namespace

SolidPart part_of(TriangleSet surface, bool is_smooth) {
  join_vertices(surface);
  if (bounds_convex(surface)) return part_of(support_of_points(surface.vertices, is_smooth));
  return faceted_part(csgcore::make_mesh(std::make_shared<csgcore::TriangleMesh>(
                          std::move(surface.vertices), std::move(surface.triangles))),
                      is_smooth);
}

void SolidUnion::fail(std::string_view why) {
  if (failure_.empty()) failure_ = why;
}

std::vector<SolidPart> SolidUnion::parts_of(const SolidValue& value) {
  if (value.is_union()) return value.parts;
  std::vector<SolidPart> result;
  for (const SolidValue& operand : operands_of_union(value)) {
    csgcore::stop_point();
    std::vector<SolidPart> parts = outcome(operand);
    if (!failure_.empty()) return {};
    result.insert(result.end(), std::make_move_iterator(parts.begin()),
                  std::make_move_iterator(parts.end()));
  }
  return result;
}

/// Returns the operand of a union as one part, or as several if it is a union after all; none if it
/// is empty.
std::vector<SolidPart> SolidUnion::outcome(const SolidValue& value) {
  if (value.is_union()) return value.parts;
  SolidValue near = without_far_parts(value);
  if (near.is_empty()) return {};
  if (near.is_union()) return std::move(near.parts);
  std::vector<TriangleSet> operands;
  bool is_smooth = false;
  for (const SolidPart& part : near.parts) {
    operands.push_back(triangles_of(part, is_smooth));
    triangles_ += operands.back().triangles.size();
    if (triangles_ > kMostTriangles) fail(kBecauseManyTriangles);
    if (!failure_.empty()) return {};
  }
  TriangleSet surface = pool_.boundary(operands, near.tree);
  if (surface.triangles.empty()) return {};
  std::vector<SolidPart> result;
  result.push_back(part_of(std::move(surface), is_smooth));
  return result;
}

/// Returns no triangles of what is flat.
csgcore::TriangleSet SolidUnion::triangles_of(const SolidPart& part, bool& is_smooth) {
  // Of what is round by hulls or profiles, whose chords OpenSCAD has chosen before.
  const int unknown = least_chords_ > 0 ? least_chords_ : kChordsOfCutDisc;
  TriangleSet result;
  if (!part.primitive) {
    const Generators& generators = part.body.generators;
    if (!std::ranges::all_of(generators, frontend::is_finite)) return {};
    PointSet points = points_of(generators, unknown);
    result = triangles_of_hull(std::move(points.points));
    is_smooth = is_smooth || points.is_faceted || part.body.is_faceted;
  } else {
    const csgcore::Primitive& primitive = *part.primitive;
    if (!csgcore::is_valid(primitive)) return {};
    if (primitive.mesh() && !primitive.mesh()->is_closed()) fail(kBecauseOpenMesh);
    const bool is_round = !primitive.polyhedron() && !primitive.mesh();
    const int own = traits_of(primitive.shape()).fragments(primitive, part.facets);
    const int chords = own == 0 ? unknown : std::clamp(own, least_chords_, kChordsOfCircle);
    result = frontend::triangles_of(primitive, chords);
    is_smooth = is_smooth || is_round || part.is_faceted;
  }
  return std::ranges::all_of(result.vertices, is_finite_point) ? std::move(result) : TriangleSet{};
}

}  // namespace frontend
