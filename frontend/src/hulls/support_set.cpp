#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "base/angles.hpp"
#include "csgcore/polyhedron.hpp"
#include "csgcore/profile.hpp"
#include "csgcore/triangle_mesh.hpp"
#include "hulls/generator.hpp"

namespace frontend {
namespace {

using csgcore::Affine;
using csgcore::Mat3;
using csgcore::Primitive;
using csgcore::ProfileEdge;
using csgcore::ProfileLoop;
using csgcore::Vec3;

using Kind = ProfileEdge::Kind;

/// Directions and lengths in a figure differ by so much through rounding.
constexpr double kSupportRounding = 1e-12;

/// An edge of a loop with its start.
struct Edge {
  Vec2 start;
  ProfileEdge edge;

  bool is_arc() const { return edge.kind == Kind::kArc; }
  double radius() const { return glm::length(start - edge.control); }
  /// Directions of travel, not of unit length.
  Vec2 leaves() const { return is_arc() ? tangent(start) : edge.end - start; }
  Vec2 arrives() const { return is_arc() ? tangent(edge.end) : edge.end - start; }
  double sweep() const {
    const Vec2 from = start - edge.control, to = edge.end - edge.control;
    const double angle = std::atan2(cross(from, to), glm::dot(from, to));
    return angle < 0 || (angle == 0 && start != edge.end) ? angle + kTurn : angle;
  }

 private:
  Vec2 tangent(const Vec2& at) const {
    const Vec2 out = at - edge.control;
    return edge.is_counterclockwise ? Vec2(-out.y, out.x) : Vec2(out.y, -out.x);
  }
};

std::vector<Edge> edges_of(const ProfileLoop& loop) {
  std::vector<Edge> edges;
  for (size_t i = 0; i < loop.size(); ++i) {
    const Vec2 start = loop[i == 0 ? loop.size() - 1 : i - 1].end;
    if (loop[i].kind == Kind::kLine && start == loop[i].end) continue;
    edges.push_back({start, loop[i]});
  }
  return edges;
}

/// Whether the disc of an arc lies in the convex figure: no edge cuts into it.
bool holds_disc(const std::vector<Edge>& edges, const Vec2& center, double radius) {
  const double slack = kSupportRounding * radius;
  return std::all_of(edges.begin(), edges.end(), [&](const Edge& edge) {
    if (!edge.is_arc()) {
      const Vec2 side = edge.edge.end - edge.start;
      return cross(side, center - edge.start) >= (radius - slack) * glm::length(side);
    }
    // How far the disc sticks out of the arc's, in the directions of the arc.
    const Vec2 gap = center - edge.edge.control;
    const double own = edge.radius();
    const Vec2 from = (edge.start - edge.edge.control) / own;
    const Vec2 to = (edge.edge.end - edge.edge.control) / own;
    double reach = std::max(glm::dot(gap, from), glm::dot(gap, to));
    if (cross(from, gap) > 0 && cross(gap, to) > 0) reach = std::max(reach, glm::length(gap));
    return reach + radius <= own + slack;
  });
}

/// A point or a disc of a plane figure's hull.
using FlatBodies = std::vector<Disc>;

void add_chords(const Edge& edge, FlatBodies& bodies) {
  const double sweep = edge.edge.is_counterclockwise ? edge.sweep() : edge.sweep() - kTurn;
  const int count =
      std::max(1, static_cast<int>(std::ceil(std::abs(sweep) / kTurn * kChordsOfDisc)));
  const Vec2 out = edge.start - edge.edge.control;
  for (int i = 1; i < count; ++i) {
    const double angle = sweep * i / count;
    const Vec2 turned(out.x * std::cos(angle) - out.y * std::sin(angle),
                      out.x * std::sin(angle) + out.y * std::cos(angle));
    bodies.push_back({edge.edge.control + turned, 0});
  }
}

void add_bezier(const Edge& edge, FlatBodies& bodies) {
  constexpr int kChords = 64;  // as fine on a quarter as those of a disc, nearly
  for (int i = 1; i < kChords; ++i) {
    const double s = static_cast<double>(i) / kChords;
    bodies.push_back({(1 - s) * (1 - s) * edge.start + 2 * s * (1 - s) * edge.edge.control +
                          s * s * edge.edge.end,
                      0});
  }
}

/// Whether the arcs about that centre, with that radius, are all of the circle.
bool is_whole_circle(const std::vector<Edge>& edges, const Vec2& center, double radius) {
  double sum = 0;
  for (const Edge& edge : edges) {
    if (!edge.is_arc() || edge.edge.control != center) continue;
    if (std::abs(edge.radius() - radius) > kSupportRounding * radius) continue;
    sum += edge.edge.is_counterclockwise ? edge.sweep() : kTurn - edge.sweep();
  }
  return sum >= kTurn * (1 - kSupportRounding);
}

/// Returns whether points stand for curves.
bool add_loop(const ProfileLoop& loop, FlatBodies& bodies) {
  bool is_faceted = false;
  const std::vector<Edge> edges = edges_of(loop);
  const bool is_convex = is_convex_loop(loop);
  for (const Edge& edge : edges) {
    bodies.push_back({edge.edge.end, 0});
    if (edge.edge.kind == Kind::kBezier) {
      is_faceted = true;
      add_bezier(edge, bodies);
    } else if (edge.is_arc()) {
      const double radius = edge.radius();
      if ((is_convex && holds_disc(edges, edge.edge.control, radius)) ||
          is_whole_circle(edges, edge.edge.control, radius)) {
        bodies.push_back({edge.edge.control, radius});
      } else {
        is_faceted = true;
        add_chords(edge, bodies);
      }
    }
  }
  return is_faceted;
}

FlatBodies flat_bodies(const csgcore::Profile& profile, bool& is_faceted) {
  FlatBodies bodies;
  for (const ProfileLoop& loop : profile.loops()) {
    if (add_loop(loop, bodies)) is_faceted = true;
  }
  return bodies;
}

Generator point_at(const Vec3& point) {
  Generator generator;
  generator.center = point;
  return generator;
}

Generator upright_disc(const Vec3& center, double radius) {
  Generator generator = point_at(center);
  generator.disc_a = Vec3(radius, 0, 0);
  generator.disc_b = Vec3(0, radius, 0);
  return generator;
}

void add_points(std::span<const Vec3> points, SupportSet& support) {
  for (const Vec3& point : points) support.generators.push_back(point_at(point));
}

/// A kind that says no more has the support of its mesh.
template <class RoundShape>
void add_local_support(const RoundShape& shape, SupportSet& support) {
  add_points(csgcore::faceted_mesh({shape, {}}, kChordsOfCircle).vertices, support);
}

void add_local_support(const csgcore::SphereShape& sphere, SupportSet& support) {
  Generator ball;
  ball.ball = Mat3(sphere.radius);
  support.generators.push_back(ball);
}

void add_local_support(const csgcore::FrustumShape& frustum, SupportSet& support) {
  support.generators.push_back(upright_disc(Vec3(0, 0, frustum.z_min), frustum.r_bottom));
  support.generators.push_back(upright_disc(Vec3(0, 0, frustum.z_max), frustum.r_top));
}

void add_local_support(const csgcore::PolyhedronShape& shape, SupportSet& support) {
  add_points(shape.polyhedron->vertices(), support);
}

void add_local_support(const csgcore::MeshShape& shape, SupportSet& support) {
  add_points(shape.mesh->vertices(), support);
}

void add_local_support(const csgcore::ExtrusionShape& extrusion, SupportSet& support) {
  for (const Disc& body : flat_bodies(*extrusion.profile, support.is_faceted)) {
    for (const auto& [z, scale] : {std::pair(extrusion.z_min, extrusion.scale_bottom),
                                   std::pair(extrusion.z_max, extrusion.scale_top)}) {
      support.generators.push_back(upright_disc(Vec3(scale * body.center, z), scale * body.radius));
    }
  }
}

void add_local_support(const csgcore::RevolutionShape& revolution, SupportSet& support) {
  for (const Disc& body : flat_bodies(*revolution.profile, support.is_faceted)) {
    Generator generator = upright_disc(Vec3(0, 0, body.center.y), std::abs(body.center.x));
    if (body.radius > 0) generator.ball = Mat3(body.radius);
    support.generators.push_back(generator);
  }
}

}  // namespace

void add_support(const Primitive& primitive, SupportSet& support) {
  const size_t first = support.generators.size();
  std::visit([&](const auto& shape) { add_local_support(shape, support); }, primitive.solid);
  for (size_t i = first; i < support.generators.size(); ++i) {
    support.generators[i] = mapped(primitive.local_to_world, support.generators[i]);
  }
}

bool is_convex(const Primitive& primitive) {
  if (const auto* const extrusion = std::get_if<csgcore::ExtrusionShape>(&primitive.solid)) {
    const std::span<const ProfileLoop> loops = extrusion->profile->loops();
    return loops.size() == 1 && is_convex_loop(loops.front());
  }
  return csgcore::is_convex(primitive.shape());
}

bool is_convex_loop(const ProfileLoop& loop) {
  const std::vector<Edge> edges = edges_of(loop);
  double turned = 0;
  for (size_t i = 0; i < edges.size(); ++i) {
    const Edge& edge = edges[i];
    if (edge.edge.kind == Kind::kBezier) return false;
    if (edge.is_arc()) {
      if (!edge.edge.is_counterclockwise) return false;
      turned += edge.sweep();
    }
    const Vec2 before = edge.arrives(), after = edges[(i + 1) % edges.size()].leaves();
    const double turn = std::atan2(cross(before, after), glm::dot(before, after));
    if (turn < -kSupportRounding) return false;
    turned += turn;
  }
  constexpr double kOnce = 1.5;  // the next whole number of turns is 2
  return !edges.empty() && turned < kOnce * kTurn;
}

}  // namespace frontend
