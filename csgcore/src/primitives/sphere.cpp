// The sphere, which is an ellipsoid under an affine map, and the unit ball in canonical space.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "csgcore/polyhedron.hpp"
#include "primitives/primitive_kind.hpp"

namespace csgcore {
namespace {

/// If LᵀL deviates relatively by less than this from a multiple of the identity, the image of a
/// sphere is treated as a ball. The deviation is far below kCanonicalSlack, which absorbs it.
constexpr double kSimilarityTolerance = 1e-14;

bool is_similarity(const Mat3& linear) {
  const Mat3 gram = glm::transpose(linear) * linear;
  const double scale = (gram[0][0] + gram[1][1] + gram[2][2]) / 3;
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) {
      const double expected = row == column ? scale : 0.0;
      if (!(std::abs(gram[column][row] - expected) <= kSimilarityTolerance * scale)) return false;
    }
  }
  return true;
}

/// Returns the world direction that the map stretches most, which is along the ellipsoid's shortest
/// axis.
Vec3 most_stretched(const Mat3& world_to_canonical) {
  // Powers of the map's square converge to it; ten squarings make the 1,024th power.
  Mat3 power = glm::transpose(world_to_canonical) * world_to_canonical;
  for (int i = 0; i < 10; ++i) {
    double largest = 0;
    for (int k = 0; k < 3; ++k) largest = std::max(largest, glm::length(power[k]));
    power *= 1 / largest;
    power = power * power;
  }
  return *std::max_element(&power[0], &power[0] + 3, [](const Vec3& a, const Vec3& b) {
    return glm::length(a) < glm::length(b);
  });
}

class SphereKind final : public PrimitiveKind {
 public:
  bool has_valid_shape(const Primitive& primitive) const override {
    const double radius = primitive.as<SphereShape>().radius;
    return std::isfinite(radius) && radius > 0;
  }
  Mesh faceted_mesh(const Primitive& primitive, int fragments) const override {
    return sphere_mesh(primitive.as<SphereShape>().radius, fragments);
  }
  std::shared_ptr<const Polyhedron> faceted_polyhedron(const Primitive& primitive,
                                                       int fragments) const override {
    return Polyhedron::sphere(primitive.as<SphereShape>().radius, fragments);
  }
  CanonicalPrimitive canonicalize(const Primitive& primitive) const override {
    CanonicalPrimitive result;
    result.center = primitive.local_to_world.translation;
    result.canonical_to_world =
        primitive.local_to_world.linear * primitive.as<SphereShape>().radius;
    result.world_to_canonical = inverse(result.canonical_to_world);
    if (is_similarity(result.canonical_to_world)) {
      result.ball_radius = glm::length(result.canonical_to_world[0]);
    }
    // The support of the ellipsoid along a world axis is the norm of that row of the map.
    const Mat3 rows = glm::transpose(result.canonical_to_world);
    const Vec3 extent{glm::length(rows[0]), glm::length(rows[1]), glm::length(rows[2])};
    result.bounds = {result.center - extent, result.center + extent};
    return result;
  }

  bool contains(const CanonicalPrimitive&, const Vec3& p) const override {
    return glm::dot(p, p) <= 1.0;
  }

  Vec3 support(const CanonicalPrimitive&, const Vec3& direction) const override {
    const double length = glm::length(direction);
    return length > 0 ? direction / length : Vec3{1, 0, 0};
  }

  bool holds_ball(const CanonicalPrimitive&, const Vec3& center, double radius) const override {
    return glm::length(center) < 1 - radius;
  }

  Classification classify(const CanonicalPrimitive& primitive,
                          const Box& cell_world) const override {
    const CanonicalCell cell = to_canonical(primitive, cell_world);
    // By convexity, a cell whose 8 corners lie inside lies inside.
    const double inner = 1.0 - cell.slack;
    if (contains(primitive, cell.center)) {
      for (int corner = 0; corner < 8; ++corner) {
        const Vec3 point = cell.corner(corner);
        if (!(inner > 0 && glm::dot(point, point) < inner * inner)) return Classification::kCrosses;
      }
      return Classification::kInside;
    }
    // Finds the cell's point nearest to the ball's centre, by cyclic coordinate descent in the
    // three edge parameters. The problem is convex, and one sweep solves it if the edges are
    // orthogonal. After each sweep, the plane through the point proves that the cell lies outside,
    // if it separates the two.
    constexpr int kSweeps = 6;
    Vec3 parameter{0.0};
    Vec3 nearest = cell.center;
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      for (int i = 0; i < 3; ++i) {
        const double length2 = glm::dot(cell.half[i], cell.half[i]);
        const double moved = parameter[i] - glm::dot(cell.half[i], nearest) / length2;
        const double clamped = glm::clamp(moved, -1.0, 1.0);
        nearest += (clamped - parameter[i]) * cell.half[i];
        parameter[i] = clamped;
      }
      const double distance2 = glm::dot(nearest, nearest);
      if (distance2 <= 1.0) return Classification::kCrosses;
      const double low =
          glm::dot(nearest, cell.center) - std::abs(glm::dot(nearest, cell.half[0])) -
          std::abs(glm::dot(nearest, cell.half[1])) - std::abs(glm::dot(nearest, cell.half[2]));
      if (low > std::sqrt(distance2) * (1.0 + cell.slack)) return Classification::kOutside;
    }
    return Classification::kCrosses;
  }

  Vec3 outwards(const CanonicalPrimitive&, const Vec3& point) const override { return point; }

  bool is_thinner(const CanonicalPrimitive& primitive, double thickness) const override {
    // In canonical space the ball is 2 thick in every direction.
    if (primitive.canonical_stretch * thickness <= 2) return false;
    return width(primitive, most_stretched(primitive.world_to_canonical)) < thickness;
  }
};

constexpr SphereKind kSphereKind;

}  // namespace

constinit const PrimitiveKind& Sphere_kind = kSphereKind;

}  // namespace csgcore
