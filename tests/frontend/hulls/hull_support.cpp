#include "hulls/hull_support.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <limits>

#include "csgcore/polyhedron.hpp"
#include "csgcore/profile.hpp"
#include "csgcore/triangle_mesh.hpp"

namespace frontend::hull_test {
namespace {

using csgcore::Primitive;
using csgcore::ProfileEdge;
using csgcore::Shape;
using csgcore::Vec3;
using glm::dvec2;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double cross(const dvec2& a, const dvec2& b) { return a.x * b.y - a.y * b.x; }

/// Calls visit(start, edge) for each edge of the profile.
template <typename Visit>
void visit_edges(const csgcore::Profile& profile, const Visit& visit) {
  for (const csgcore::ProfileLoop& loop : profile.loops()) {
    for (size_t i = 0; i < loop.size(); ++i) {
      visit(loop[i == 0 ? loop.size() - 1 : i - 1].end, loop[i]);
    }
  }
}

double support(const csgcore::Profile& profile, const dvec2& direction) {
  double most = -kInfinity;
  visit_edges(profile, [&](const dvec2& start, const ProfileEdge& edge) {
    most = std::max({most, glm::dot(start, direction), glm::dot(edge.end, direction)});
    if (edge.kind != ProfileEdge::Kind::kArc) return;
    const dvec2 from = start - edge.control, to = edge.end - edge.control;
    if (cross(from, direction) >= 0 && cross(direction, to) >= 0) {
      most = std::max(
          most, glm::dot(edge.control, direction) + glm::length(from) * glm::length(direction));
    }
  });
  return most;
}

/// Of a convex profile, counterclockwise.
bool contains(const csgcore::Profile& profile, const dvec2& point, double tolerance) {
  // Within the chords, or between an arc and its chord.
  bool is_in_chords = true;
  bool is_in_segment = false;
  visit_edges(profile, [&](const dvec2& start, const ProfileEdge& edge) {
    const dvec2 chord = edge.end - start;
    if (chord == dvec2(0.0)) return;
    const bool is_left = cross(chord, point - start) >= -tolerance * glm::length(chord);
    is_in_chords = is_in_chords && is_left;
    if (edge.kind == ProfileEdge::Kind::kArc && !is_left) {
      is_in_segment = is_in_segment || glm::length(point - edge.control) <=
                                           glm::length(start - edge.control) + tolerance;
    }
  });
  return is_in_chords || is_in_segment;
}

double local_support(const Primitive& primitive, const Vec3& u) {
  const double across = std::hypot(u.x, u.y);
  double most = -kInfinity;
  switch (primitive.shape()) {
    case Shape::kSphere:
      return primitive.as<csgcore::SphereShape>().radius * glm::length(u);
    case Shape::kFrustum: {
      const auto& [z_min, z_max, r_bottom, r_top] = primitive.as<csgcore::FrustumShape>();
      return std::max(z_min * u.z + r_bottom * across, z_max * u.z + r_top * across);
    }
    case Shape::kPolyhedron:
      for (const Vec3& v : primitive.polyhedron()->vertices())
        most = std::max(most, glm::dot(v, u));
      return most;
    case Shape::kMesh:
      for (const Vec3& v : primitive.mesh()->vertices()) most = std::max(most, glm::dot(v, u));
      return most;
    case Shape::kRevolution:
      return support(*primitive.profile(), {across, u.z});
    default:  // no test asks for those of other kinds
      break;
  }
  return most;
}

bool local_contains(const Primitive& primitive, const Vec3& p, double tolerance) {
  const double across = std::hypot(p.x, p.y);
  switch (primitive.shape()) {
    case Shape::kSphere:
      return glm::length(p) <= primitive.as<csgcore::SphereShape>().radius + tolerance;
    case Shape::kFrustum: {
      const auto& [z_min, z_max, r_bottom, r_top] = primitive.as<csgcore::FrustumShape>();
      if (p.z < z_min - tolerance || p.z > z_max + tolerance) return false;
      const double share = (p.z - z_min) / (z_max - z_min);
      return across <= (1 - share) * r_bottom + share * r_top + tolerance;
    }
    case Shape::kPolyhedron:
      return std::all_of(
          primitive.polyhedron()->half_spaces().begin(),
          primitive.polyhedron()->half_spaces().end(), [&](const csgcore::HalfSpace& h) {
            return glm::dot(h.normal, p) <= h.offset + tolerance * glm::length(h.normal);
          });
    case Shape::kRevolution:
      return contains(*primitive.profile(), {across, p.z}, tolerance);
    default:  // nor for these
      break;
  }
  return false;
}

}  // namespace

Vec3 furthest(const Generator& g, const Vec3& u) {
  Vec3 result = g.center;
  const dvec2 in_disc(glm::dot(u, g.disc_a), glm::dot(u, g.disc_b));
  if (glm::length(in_disc) > 0) {
    const dvec2 unit = glm::normalize(in_disc);
    result += unit.x * g.disc_a + unit.y * g.disc_b;
  }
  const Vec3 in_ball = glm::transpose(g.ball) * u;
  if (glm::length(in_ball) > 0) result += g.ball * glm::normalize(in_ball);
  return result;
}

double support(const Generators& generators, const Vec3& direction) {
  double most = -kInfinity;
  for (const Generator& generator : generators) {
    most = std::max(most, glm::dot(direction, furthest(generator, direction)));
  }
  return most;
}

double support(const Primitive& primitive, const Vec3& direction) {
  const csgcore::Affine& map = primitive.local_to_world;
  return glm::dot(direction, map.translation) +
         local_support(primitive, glm::transpose(map.linear) * direction);
}

double support(std::span<const Primitive> pieces, const Vec3& direction) {
  double most = -kInfinity;
  for (const Primitive& piece : pieces) most = std::max(most, support(piece, direction));
  return most;
}

bool contains(const Primitive& primitive, const Vec3& point, double tolerance) {
  const csgcore::Affine& map = primitive.local_to_world;
  const Vec3 local = csgcore::inverse(map.linear) * (point - map.translation);
  const double scale = std::cbrt(std::abs(map.determinant()));
  return local_contains(primitive, local, tolerance / scale);
}

double size_of(const Generators& generators) {
  Vec3 size;
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 u(0.0);
    u[axis] = 1;
    size[axis] = support(generators, u) + support(generators, -u);
  }
  return glm::length(size);
}

}  // namespace frontend::hull_test
