#include "solids/solid_sums.hpp"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <optional>
#include <span>

#include "csgcore/profile.hpp"
#include "csgcore/stop_scope.hpp"
#include "csgcore/triangle_mesh.hpp"

namespace frontend {
namespace {

using csgcore::Affine;
using csgcore::Box;
using csgcore::Primitive;
using csgcore::Shape;
using csgcore::Vec3;

constexpr std::string_view kBecauseManyFaces =
    "its operands have more than 20000 faces or parts to be added one by one";
constexpr std::string_view kBecauseTwoAreNotConvex = "two of its operands are not convex";
constexpr std::string_view kBecauseManyCorners = "its operands have too many corners";
/// More parts take seconds to make and to draw.
constexpr size_t kMostSums = 20000;
/// So many corners take a second and 300 MB.
constexpr size_t kMostWork = size_t{1} << 21;

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

/// The hull of points of a face of the part.
SupportSet face_support(std::span<const Vec3> points, const SolidPart& part) {
  SupportSet support;
  support.is_faceted = part.is_faceted;
  for (const Vec3& point : points) {
    Generator& generator = support.generators.emplace_back();
    generator.center = point;
  }
  return support;
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

void SolidSums::add(const SolidPart& a, const SolidPart& b) {
  if (!failure_.empty()) return;
  const Box box = sum(a.box, b.box);
  if (a.is_convex() && b.is_convex()) {
    add_convex(support_of(a), support_of(b), box);
    return;
  }
  const SolidPart& convex = a.is_convex() ? a : b;
  const SolidPart& other = a.is_convex() ? b : a;
  if (!convex.is_convex()) {
    fail(kBecauseTwoAreNotConvex);
  } else if (other.primitive->mesh()) {
    add_mesh(other, convex, box);
  } else if (other.primitive->shape() == Shape::kExtrusion) {
    add_extrusion(other, convex, box);
  } else {
    fail("one of its operands is round and not convex");
  }
}

void SolidSums::add_convex(const SupportSet& a, const SupportSet& b, const Box& box) {
  csgcore::stop_point();
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

/// The mesh, moved to a point of the convex body, and the sum of the body and each face: whatever
/// of the sum meets no face lies within the mesh as a whole.
void SolidSums::add_mesh(const SolidPart& part, const SolidPart& convex, const Box& box) {
  const SupportSet support = support_of(convex);
  const Primitive& mesh = *part.primitive;
  if (mesh.mesh()->triangles().size() > kMostSums) return fail(kBecauseManyFaces);
  if (!mesh.mesh()->is_closed()) return fail("one of its operands is an open mesh");
  sums_.push_back(moved(part, support.generators.front().center, box));
  for (const auto& triangle : mesh.mesh()->triangles()) {
    std::array<Vec3, 3> corners;
    for (size_t i = 0; i < 3; ++i) {
      corners[i] = mesh.local_to_world.point(mesh.mesh()->vertices()[triangle[i]]);
    }
    add_convex(face_support(corners, part), support, box);
  }
}

/// The extrusion, stretched along a line from the lowest to the highest point of the convex body,
/// and the sum of the body and each wall. Where the body, turned around, meets the extrusion but no
/// wall, all of its sections lie within the profile, and that line has one at each height.
void SolidSums::add_extrusion(const SolidPart& part, const SolidPart& convex, const Box& box) {
  const auto& extrusion = part.primitive->as<csgcore::ExtrusionShape>();
  const Affine& map = part.primitive->local_to_world;
  SupportSet local = support_of(convex);
  if (map.determinant() == 0 || extrusion.scale_bottom != extrusion.scale_top) {
    return fail("one of its operands is a tapered or flat extrusion");
  }
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
    add_convex(face_support(corners, part), support, box);
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
