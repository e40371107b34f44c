// The convex polyhedron under affine maps. polyhedron.hpp describes its canonical space.
#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <utility>

#include "csgcore/polyhedron.hpp"
#include "primitives/primitive_kind.hpp"

namespace csgcore {
namespace {

/// Returns whether the cell's 8 corners lie inside. By convexity, all of the cell then does.
bool holds_corners(const Polyhedron& polyhedron, const CanonicalCell& cell) {
  for (int corner = 0; corner < 8; ++corner) {
    if (!polyhedron.contains(cell.corner(corner), cell.slack)) return false;
  }
  return true;
}

/// A polyhedron with more entries than this is not tested for holding another primitive.
constexpr size_t kMostFaces = 64;

class PolyhedronKind final : public PrimitiveKind {
 public:
  bool has_valid_shape(const Primitive& primitive) const override {
    return primitive.polyhedron() != nullptr;
  }

  std::shared_ptr<const Polyhedron> faceted_polyhedron(const Primitive& primitive,
                                                       int) const override {
    return primitive.as<PolyhedronShape>().polyhedron;
  }
  bool has_same_solid(const Primitive& a, const Primitive& b) const override {
    return same_polyhedron(a.polyhedron(), b.polyhedron());
  }
  bool has_same_form(const CanonicalPrimitive& a, const CanonicalPrimitive& b) const override {
    return same_polyhedron(a.polyhedron.get(), b.polyhedron.get());
  }

  CanonicalPrimitive canonicalize(const Primitive& primitive) const override {
    const Polyhedron& polyhedron = *primitive.polyhedron();
    const Polyhedron::Canonical& canonical = polyhedron.canonical();
    CanonicalPrimitive result;
    result.enclosure = canonical.in_frustum ? Shape::kFrustum : Shape::kSphere;
    result.radius_mid = canonical.radius_mid;
    result.radius_slope = canonical.radius_slope;
    result.polyhedron = primitive.as<PolyhedronShape>().polyhedron;
    const Mat3& linear = primitive.local_to_world.linear;
    result.center = primitive.local_to_world.point(canonical.center);
    for (int i = 0; i < 3; ++i) result.canonical_to_world[i] = linear[i] * canonical.scale[i];
    result.world_to_canonical = inverse(result.canonical_to_world);
    return result;
  }

  Classification classify(const CanonicalPrimitive& primitive,
                          const Box& cell_world) const override {
    const Polyhedron& polyhedron = *primitive.polyhedron;
    const CanonicalCell cell = to_canonical(primitive, cell_world);
    if (polyhedron.contains(cell.center)) {
      return holds_corners(polyhedron, cell) ? Classification::kInside : Classification::kCrosses;
    }
    // Most cells outside of the solid lie outside of its enclosure.
    const Classification enclosure = kind_of(primitive.enclosure).classify(primitive, cell_world);
    if (enclosure == Classification::kOutside) return enclosure;
    // Search for a separating direction as FrustumKind::classify does, starting from the normal of
    // the face towards the cell.
    constexpr int kSteps = 8;
    Vec3 direction = glm::normalize(polyhedron.face_towards(cell.center));
    for (int step = 0; step < kSteps; ++step) {
      const Vec3 near = cell.lowest(direction);
      if (polyhedron.contains(near)) return Classification::kCrosses;
      const Vec3 gap = near - polyhedron.support(direction);
      const double along = glm::dot(gap, direction);
      if (along > cell.slack) return Classification::kOutside;
      direction -= (2.0 * along / glm::dot(gap, gap)) * gap;
    }
    return Classification::kCrosses;
  }

  bool contains(const CanonicalPrimitive& primitive, const Vec3& point) const override {
    return primitive.polyhedron->contains(point);
  }

  Vec3 support(const CanonicalPrimitive& primitive, const Vec3& direction) const override {
    return primitive.polyhedron->support(direction);
  }

  bool holds_ball(const CanonicalPrimitive& primitive, const Vec3& center,
                  double radius) const override {
    return primitive.polyhedron->contains(center, radius);
  }

  bool holds(const CanonicalPrimitive& outer, const CanonicalPrimitive& inner,
             double limit) const override {
    const std::vector<Polyhedron::Entry>& entries = outer.polyhedron->entries();
    if (entries.size() > kMostFaces) return false;
    return std::ranges::all_of(entries, [&](const Polyhedron::Entry& entry) {
      if (entry.skip > 0) return true;
      const Vec3 normal = glm::transpose(outer.world_to_canonical) * entry.normal;
      const Vec3 furthest = furthest_point(inner, normal) - outer.center;
      return glm::dot(normal, furthest) - 1 <= limit * glm::length(normal);
    });
  }

  Vec3 outwards(const CanonicalPrimitive& primitive, const Vec3& point) const override {
    return point == Vec3(0.0) ? point : primitive.polyhedron->face_towards(point);
  }

  bool is_thinner(const CanonicalPrimitive& primitive, double thickness) const override {
    for (const Polyhedron::Entry& face : primitive.polyhedron->entries()) {
      if (face.skip > 0) continue;
      const Vec3 normal = face.normal * primitive.world_to_canonical;
      // The face lies further than `thickness` from the canonical origin, which lies inside.
      if (glm::dot(normal, normal) * thickness * thickness <= 1) continue;
      if (width(primitive, normal) < thickness) return true;
    }
    return false;
  }
};

constexpr PolyhedronKind kPolyhedronKind;

}  // namespace

constinit const PrimitiveKind& Polyhedron_kind = kPolyhedronKind;

}  // namespace csgcore
