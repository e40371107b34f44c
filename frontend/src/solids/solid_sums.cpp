#include "solids/solid_sums.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <optional>
#include <span>

#include "csgcore/profile.hpp"
#include "csgcore/stop_scope.hpp"
#include "csgcore/triangle_mesh.hpp"
#include "hulls/orthonormal.hpp"
#include "solids/convex_pieces.hpp"
#include "solids/solid_union.hpp"
#include "solids/surface_edges.hpp"
#include "solids/triangles_of.hpp"

namespace frontend {
namespace {

using csgcore::Affine;
using csgcore::Box;
using csgcore::Primitive;
using csgcore::Vec3;

constexpr std::string_view kBecauseManyFaces =
    "its operands have more than 200000 faces or parts to be added one by one";
constexpr std::string_view kBecauseManyPieces =
    "two of its operands are not convex, and would be cut into too many convex pieces";
constexpr std::string_view kBecauseManyCorners = "its operands have too many corners";
constexpr std::string_view kBecauseOpenOperand = "one of its operands is an open mesh";
/// More parts take seconds to make and to draw.
constexpr size_t kMostSums = 200000;
/// So many corners take two seconds and 600 MB.
constexpr size_t kMostWork = size_t{1} << 22;

/// So many triangles are cut in about two seconds, where there is no other way, or at once.
constexpr size_t kMostCutTriangles = size_t{1} << 18, kFewCutTriangles = size_t{1} << 15;

Box sum(const Box& a, const Box& b) { return {a.min + b.min, a.max + b.max}; }

/// The work that the hull of the generators makes, in corners: a ball and a disc have several
/// pieces with each neighbour, as measured.
size_t work_of(const Generators& generators) {
  constexpr size_t kOfBall = 32, kOfDisc = 128;
  size_t work = 0;
  for (const Generator& generator : generators) {
    work += generator.has_disc() ? kOfDisc : generator.has_ball() ? kOfBall : 1;
  }
  return work;
}

SupportSet support_of(const SolidPart& part) {
  SupportSet support;
  part.add_support(support);
  return support;
}

/// The hull of points of the part.
SupportSet support_of_points(std::span<const Vec3> points, const SolidPart& part) {
  SupportSet support;
  support.is_faceted = part.is_faceted;
  for (const Vec3& point : points) support.generators.emplace_back().center = point;
  return support;
}

bool is_straight_extrusion(const Primitive& primitive) {
  const auto* const extrusion = std::get_if<csgcore::ExtrusionShape>(&primitive.solid);
  return extrusion && extrusion->scale_bottom == extrusion->scale_top;
}

SolidPart moved(SolidPart part, const Vec3& offset, const Box& box) {
  part.primitive->local_to_world.translation += offset;
  part.box = box;
  return part;
}

/// A point of the generator that is furthest up, or down if `sign` is −1.
Vec3 end_of(const Generator& g, double sign) {
  Vec3 result = g.center;
  const double slope = std::hypot(g.disc_a.z, g.disc_b.z);
  if (slope > 0) result += sign / slope * (g.disc_a.z * g.disc_a + g.disc_b.z * g.disc_b);
  const Vec3 along(g.ball[0].z, g.ball[1].z, g.ball[2].z);
  const double length = glm::length(along);
  if (length > 0) result += g.ball * (sign / length * along);
  return result;
}

/// A point of the body that is furthest up, or down. There is at least one generator.
Vec3 end_of(const Generators& generators, double sign) {
  Vec3 best = end_of(generators.front(), sign);
  for (const Generator& generator : generators) {
    const Vec3 end = end_of(generator, sign);
    if (sign * end.z > sign * best.z) best = end;
  }
  return best;
}

/// The extrusion between the places of its ends where it is moved to these points, by its lower and
/// its upper end: its layers are moved along the line between them.
void stretch(const Vec3& lower, const Vec3& upper, Primitive& primitive) {
  auto& extrusion = primitive.as<csgcore::ExtrusionShape>();
  extrusion.z_min += lower.z;
  extrusion.z_max += upper.z;
  Affine leaning;
  leaning.linear[2] = (upper - lower) / (extrusion.z_max - extrusion.z_min);
  leaning.linear[2].z = 1;
  leaning.translation = lower - extrusion.z_min * leaning.linear[2];
  leaning.translation.z = 0;
  primitive.local_to_world = compose(primitive.local_to_world, leaning);
}

}  // namespace

void SolidSums::fail(std::string_view why) {
  if (failure_.empty()) failure_ = why;
}

/// Returns the part with facets for what is round and not convex.
SolidPart SolidSums::as_mesh(SolidPart part) const {
  if (part.is_convex() || part.primitive->mesh()) return part;
  const Box box = part.box;
  csgcore::TriangleSet surface = triangles_of(*part.primitive, chords_);
  SolidPart result = part_of(std::move(surface), true);
  result.box = box;
  return result;
}

void SolidSums::add(std::vector<SolidPart> a, std::vector<SolidPart> b) {
  const auto are_convex = [](const std::vector<SolidPart>& parts) {
    return std::ranges::all_of(parts, &SolidPart::is_convex);
  };
  if (!are_convex(a) && !are_convex(b)) {
    for (std::vector<SolidPart>* const parts : {&a, &b}) {
      for (SolidPart& part : *parts) part = as_mesh(std::move(part));
    }
    if (reflex_edges(a) < reflex_edges(b)) {
      a = in_convex_parts(a);
    } else {
      b = in_convex_parts(b);
    }
  }
  for (const SolidPart& part : a) {
    for (const SolidPart& other : b) {
      if (failure_.empty()) add_pair(part, other);
    }
  }
}

/// Returns the boundary of a closed mesh, which turns outwards and does not cross itself.
csgcore::TriangleSet SolidSums::surface_of(const SolidPart& mesh) const {
  const csgcore::TriangleSet triangles = triangles_of(*mesh.primitive);
  csgcore::CsgTreeBuilder builder;
  builder.primitive(0);
  csgcore::TriangleSet result = pool_.boundary(std::span(&triangles, 1), builder.finish());
  join_vertices(result);
  return result;
}

size_t SolidSums::reflex_edges(const std::vector<SolidPart>& parts) const {
  size_t count = 0;
  for (const SolidPart& part : parts) {
    if (!part.is_convex()) count += count_of_reflex_edges(surface_of(part));
  }
  return count;
}

/// Returns convex parts with the same union. Those that are not convex are meshes.
std::vector<SolidPart> SolidSums::in_convex_parts(const std::vector<SolidPart>& parts) {
  std::vector<SolidPart> result;
  for (const SolidPart& part : parts) {
    if (part.is_convex()) {
      result.push_back(part);
      continue;
    }
    const std::optional<std::vector<PiecePoints>> pieces =
        convex_pieces(surface_of(part), pool_, kMostCutTriangles);
    if (!pieces) fail(kBecauseManyPieces);
    if (!pieces) return {};
    for (const PiecePoints& points : *pieces) {
      result.push_back(part_of(support_of_points(points, part)));
    }
  }
  return result;
}

void SolidSums::add_pair(const SolidPart& a, const SolidPart& b) {
  const Box box = sum(a.box, b.box);
  if (a.is_convex() && b.is_convex()) {
    add_convex(support_of(a), support_of(b), box);
    return;
  }
  const SolidPart& convex = a.is_convex() ? a : b;
  const SolidPart& other = a.is_convex() ? b : a;
  if (is_straight_extrusion(*other.primitive)) {
    add_extrusion(other, convex, box);
    return;
  }
  const SolidPart mesh = as_mesh(other);
  if (mesh.is_convex()) {
    add_convex(support_of(mesh), support_of(convex), box);
  } else {
    add_mesh(mesh, convex, box);
  }
}

void SolidSums::add_convex(const SupportSet& a, const SupportSet& b, const Box& box) {
  csgcore::stop_point();
  if (a.generators.empty() || b.generators.empty()) return;
  work_ += a.generators.size() * b.generators.size();
  if (sums_.size() >= kMostSums) fail(kBecauseManyFaces);
  if (work_ > kMostWork) fail(kBecauseManyCorners);
  if (!failure_.empty()) return;
  std::optional<GeneratorSum> sum = minkowski_sum(a.generators, b.generators);
  if (!sum) fail(kBecauseManyCorners);
  if (!failure_.empty()) return;
  work_ += work_of(sum->generators);
  if (sum->is_flat) return;
  sums_.push_back(part_of(
      SupportSet{std::move(sum->generators), sum->is_faceted || a.is_faceted || b.is_faceted},
      box));
}

void SolidSums::add_mesh(const SolidPart& part, const SolidPart& convex, const Box& box) {
  if (!part.primitive->mesh()->is_closed()) return fail(kBecauseOpenOperand);
  const SupportSet support = support_of(convex);
  if (support.generators.empty()) return;
  const Generator& first = support.generators.front();
  const bool is_ball = support.generators.size() == 1 && first.has_ball() && !first.has_disc();
  if (is_ball && glm::determinant(first.ball) != 0) {
    add_rounded(part, first, box);
  } else {
    add_faces(part, support, box);
  }
}

/// The sums of the body and the mesh's convex pieces, where those are few. Else the mesh, moved to
/// a point of the convex body, and the sum of the body and each face: whatever of the sum meets no
/// face lies within the mesh as a whole.
void SolidSums::add_faces(const SolidPart& part, const SupportSet& convex, const Box& box) {
  const Primitive& mesh = *part.primitive;
  const size_t triangles = mesh.mesh()->triangles().size();
  if (triangles > kMostSums) return fail(kBecauseManyFaces);
  if (triangles <= kFewCutTriangles) {
    const csgcore::TriangleSet surface = surface_of(part);
    // Sums of faces are more than those of pieces, and overlap more.
    const auto pieces = convex_pieces(surface, pool_, kFewCutTriangles);
    if (pieces && pieces->size() < triangles && fill(*pieces, surface)) {
      for (const auto& points : *pieces) add_convex(support_of_points(points, part), convex, box);
      return;
    }
  }
  if (3 * triangles * convex.generators.size() > kMostWork) return fail(kBecauseManyCorners);
  sums_.push_back(moved(part, convex.generators.front().center, box));
  for (const auto& triangle : mesh.mesh()->triangles()) {
    std::array<Vec3, 3> corners;
    for (size_t i = 0; i < 3; ++i) {
      corners[i] = mesh.local_to_world.point(mesh.mesh()->vertices()[triangle[i]]);
    }
    add_convex(support_of_points(corners, part), convex, box);
  }
}

/// The mesh, moved to the ball's centre; of each face the prism up to where it touches the ball's
/// outermost point; and, where edges turn outwards, frusta along them with balls at their ends.
/// Whatever of the sum lies beyond the mesh is nearest to one of these, as the ball measures.
void SolidSums::add_rounded(const SolidPart& part, const Generator& ball, const Box& box) {
  const csgcore::TriangleSet surface = surface_of(part);
  const double slack = slack_of(surface);
  const std::vector<SurfaceEdge> edges = edges_of(surface);
  if (sums_.size() + surface.triangles.size() + edges.size() > kMostSums) {
    return fail(kBecauseManyFaces);
  }
  sums_.push_back(moved(part, ball.center, box));
  for (const auto& triangle : surface.triangles) {
    std::array<Vec3, 6> points;
    for (size_t i = 0; i < 3; ++i) points[i] = surface.vertices[triangle[i]] + ball.center;
    const Vec3 normal = glm::cross(points[1] - points[0], points[2] - points[0]);
    const Vec3 along = glm::transpose(ball.ball) * normal;
    const double length = glm::length(along);
    if (!(length > 0)) continue;
    const Vec3 reach = ball.ball * (along / length);
    for (size_t i = 0; i < 3; ++i) points[i + 3] = points[i] + reach;
    sums_.push_back(part_of(support_of_points(points, part), box));
  }
  const csgcore::Mat3 to_ball = csgcore::inverse(ball.ball);
  std::vector<bool> has_ball(surface.vertices.size());
  const auto add_round = [&](Primitive primitive, const Vec3& center) {
    primitive.local_to_world = compose({ball.ball, center + ball.center}, primitive.local_to_world);
    SolidPart& sum = sums_.emplace_back();
    sum.primitive = std::move(primitive);
    sum.is_faceted = part.is_faceted;
    sum.box = box;
  };
  for (const SurfaceEdge& edge : edges) {
    if (!edge.is_convex(slack)) continue;
    for (const uint32_t end : {edge.from, edge.to}) {
      if (!has_ball[end]) add_round(csgcore::make_sphere(1, {}), surface.vertices[end]);
      has_ball[end] = true;
    }
    const Vec3& from = surface.vertices[edge.from];
    const Vec3 gap = to_ball * (surface.vertices[edge.to] - from);
    const double length = glm::length(gap);
    if (!(length > 0)) continue;
    add_round(csgcore::make_frustum(0, length, 1, 1, {axes_along(gap / length).matrix(), Vec3(0)}),
              from);
  }
}

/// The extrusion, stretched along a line from the lowest to the highest point of the convex body,
/// and the sum of the body and each wall. Where the body, turned around, meets the extrusion but no
/// wall, all of its sections lie within the profile, and that line has one at each height.
void SolidSums::add_extrusion(const SolidPart& part, const SolidPart& convex, const Box& box) {
  const auto& extrusion = part.primitive->as<csgcore::ExtrusionShape>();
  const Affine& map = part.primitive->local_to_world;
  SupportSet local = support_of(convex);
  if (map.determinant() == 0) return;  // it is flat
  map_all({csgcore::inverse(map.linear), Vec3(0.0)}, local.generators);
  SolidPart core = part;
  stretch(end_of(local.generators, -1), end_of(local.generators, 1), *core.primitive);
  sums_.push_back(moved(std::move(core), Vec3(0.0), box));
  const SupportSet support = support_of(convex);
  const double scale = extrusion.scale_bottom;
  const auto add_wall = [&](const Vec2& a, const Vec2& b) {
    const std::array<Vec3, 4> corners{
        map.point(Vec3(scale * a, extrusion.z_min)), map.point(Vec3(scale * b, extrusion.z_min)),
        map.point(Vec3(scale * b, extrusion.z_max)), map.point(Vec3(scale * a, extrusion.z_max))};
    add_convex(support_of_points(corners, part), support, box);
  };
  for (const Polygon& polygon :
       chords_of(Outline{{extrusion.profile->loops().begin(), extrusion.profile->loops().end()},
                         extrusion.profile->fill_rule()})) {
    for (size_t i = 0; i < polygon.size(); ++i) {
      add_wall(polygon[i], polygon[(i + 1) % polygon.size()]);
    }
  }
}

}  // namespace frontend
