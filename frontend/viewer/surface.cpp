#include "surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>

#include "csgcore/profile.hpp"

namespace window {
namespace {

using csgcore::Affine;
using csgcore::Primitive;
using csgcore::ProfileEdge;
using csgcore::Shape;
using csgcore::Vec2;
using csgcore::Vec3;

/// The relative rounding of a hit and of a matrix that a design has multiplied: far above that of
/// doubles, and below what anyone measures.
constexpr double kRounding = 1e-7;

bool are_parallel(const Vec3& a, const Vec3& b) {
  return glm::length(glm::cross(a, b)) <= kRounding * glm::length(a) * glm::length(b);
}

bool are_perpendicular(const Vec3& a, const Vec3& b) {
  return std::abs(glm::dot(a, b)) <= kRounding * glm::length(a) * glm::length(b);
}

bool are_equal(double a, double b) {
  return std::abs(a - b) <= kRounding * std::max(std::abs(a), std::abs(b));
}

/// The factor by which a map scales circles about the local z axis, which stay circles about its
/// image; nothing if they do not.
std::optional<double> scale_about_axis(const Affine& map) {
  const Vec3 &x = map.linear[0], &y = map.linear[1], &z = map.linear[2];
  const bool is_round = are_equal(glm::length(x), glm::length(y)) && are_perpendicular(x, y) &&
                        are_perpendicular(x, z) && are_perpendicular(y, z);
  return is_round ? std::optional(glm::length(x)) : std::nullopt;
}

/// A point of a primitive's surface.
struct SurfacePoint {
  const Primitive& primitive;
  Vec3 world, normal, local;

  const Affine& map() const { return primitive.local_to_world; }
  Surface plane() const { return {Surface::Kind::kPlane, world, normal, 0}; }
  /// Of the map's image of a circle about a local axis that is parallel to z.
  Surface about_axis(const Vec2& axis, double radius_local) const {
    const std::optional<double> scale = scale_about_axis(map());
    if (!scale) return {};
    return {Surface::Kind::kAxis, map().point({axis.x, axis.y, local.z}),
            glm::normalize(map().linear[2]), *scale * radius_local};
  }
  Surface about_center(const Vec3& center, double radius_local) const {
    const std::optional<double> scale = scale_about_axis(map());
    if (!scale || !are_equal(*scale, glm::length(map().linear[2]))) return {};
    return {Surface::Kind::kCenter, map().point(center), {}, *scale * radius_local};
  }
  /// Whether the point is on a face across the local z axis.
  bool is_on_end() const {
    return are_parallel(normal, glm::cross(map().linear[0], map().linear[1]));
  }
};

/// Returns a surface of which nothing is known, for a kind that has no answer of its own.
template <class AnyShape>
Surface surface_of(const AnyShape&, const SurfacePoint&) {
  return {};
}

Surface surface_of(const csgcore::SphereShape& sphere, const SurfacePoint& point) {
  return point.about_center(Vec3(0.0), sphere.radius);
}

Surface surface_of(const csgcore::PolyhedronShape&, const SurfacePoint& point) {
  return point.plane();
}

Surface surface_of(const csgcore::MeshShape&, const SurfacePoint& point) { return point.plane(); }

Surface surface_of(const csgcore::FrustumShape& frustum, const SurfacePoint& point) {
  const double share = (point.local.z - frustum.z_min) / (frustum.z_max - frustum.z_min);
  const double radius = frustum.r_bottom + share * (frustum.r_top - frustum.r_bottom);
  Surface round = point.about_axis({0, 0}, radius);
  if (!point.is_on_end()) return round;
  Surface end = point.plane();
  if (round.kind == Surface::Kind::kAxis) {
    end.origin = round.origin;
    end.radius = round.radius;
  }
  return end;
}

/// The circle of an arc of the profile that the point lies on.
struct Circle {
  Vec2 center;
  double radius;
};
std::optional<Circle> arc_through(const csgcore::Profile& profile, const Vec2& point) {
  for (const csgcore::ProfileLoop& loop : profile.loops()) {
    for (const ProfileEdge& edge : loop) {
      if (edge.kind != ProfileEdge::Kind::kArc) continue;
      const double radius = glm::length(edge.end - edge.control);
      if (are_equal(glm::length(point - edge.control), radius)) return Circle{edge.control, radius};
    }
  }
  return std::nullopt;
}

bool has_beziers(const csgcore::Profile& profile) {
  const auto is_bezier = [](const ProfileEdge& edge) {
    return edge.kind == ProfileEdge::Kind::kBezier;
  };
  return std::any_of(profile.loops().begin(), profile.loops().end(),
                     [&](const csgcore::ProfileLoop& loop) {
                       return std::any_of(loop.begin(), loop.end(), is_bezier);
                     });
}

Surface surface_of(const csgcore::ExtrusionShape& extrusion, const SurfacePoint& point) {
  if (point.is_on_end()) return point.plane();
  const double share = (point.local.z - extrusion.z_min) / (extrusion.z_max - extrusion.z_min);
  const double scale =
      extrusion.scale_bottom + share * (extrusion.scale_top - extrusion.scale_bottom);
  const Vec2 in_profile = Vec2(point.local) / scale;
  if (const std::optional<Circle> arc = arc_through(*extrusion.profile, in_profile)) {
    const bool is_cylinder = extrusion.scale_bottom == extrusion.scale_top;
    const bool is_about_axis = arc->center == Vec2(0.0);
    if (!is_cylinder && !is_about_axis) return {};  // an oblique cone
    return point.about_axis(scale * arc->center, scale * arc->radius);
  }
  return has_beziers(*extrusion.profile) ? Surface{} : point.plane();
}

Surface surface_of(const csgcore::RevolutionShape& revolution, const SurfacePoint& point) {
  if (point.is_on_end()) return point.plane();
  const double distance = std::hypot(point.local.x, point.local.y);
  const std::optional<Circle> arc = arc_through(*revolution.profile, {distance, point.local.z});
  if (arc && arc->center.x == 0) return point.about_center({0, 0, arc->center.y}, arc->radius);
  return point.about_axis({0, 0}, distance);
}

std::string number(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.6g", value == 0 ? 0.0 : value);  // no -0
  return buffer;
}

/// Without the rounding of numbers that are 0 beside others.
Vec3 cleaned(Vec3 v) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(v[axis]) <= 1e-12 * largest) v[axis] = 0;
  }
  return v;
}

/// The angle of two lines, from 0 to 90 degrees.
double angle_deg(const Vec3& a, const Vec3& b) {
  const double angle = std::atan2(glm::length(glm::cross(a, b)), std::abs(glm::dot(a, b)));
  return angle * 180 / M_PI;
}

double distance_to_line(const Vec3& point, const Surface& axis) {
  return glm::length(glm::cross(point - axis.origin, axis.direction));
}

double distance_to_plane(const Vec3& point, const Surface& plane) {
  return std::abs(glm::dot(point - plane.origin, plane.direction));
}

/// What two surfaces are compared by.
enum class Form : uint8_t { kNone, kPlane, kLine, kPoint };

/// How a kind of surface is compared, and how that is called.
struct Term {
  Form form;
  std::string one, many;
};
Term term_of(Surface::Kind kind) {
  switch (kind) {
    case Surface::Kind::kOther:
      break;
    case Surface::Kind::kPlane:
      return {Form::kPlane, "face", "faces"};
    case Surface::Kind::kAxis:
    case Surface::Kind::kCircle:
      return {Form::kLine, "axis", "axes"};
    case Surface::Kind::kEdge:
      return {Form::kLine, "edge", "edges"};
    case Surface::Kind::kCenter:
      return {Form::kPoint, "centre", "centres"};
    case Surface::Kind::kVertex:
      return {Form::kPoint, "vertex", "vertices"};
  }
  return {Form::kNone, "", ""};
}

/// Returns "axes", or "axis and edge".
std::string both(const Term& a, const Term& b) {
  return a.one == b.one ? a.many : a.one + " and " + b.one;
}

std::string relation_of_lines(const Surface& a, const Surface& b, const std::string& lines) {
  if (are_parallel(a.direction, b.direction)) {
    const double distance = distance_to_line(a.origin, b);
    const double size = std::max({a.radius, b.radius, glm::length(a.origin - b.origin)});
    if (distance <= kRounding * size) return lines == "axes" ? "the same axis" : "the same line";
    return lines + " " + number(distance) + " apart";
  }
  const Vec3 across = glm::normalize(glm::cross(a.direction, b.direction));
  return lines + " at " + number(angle_deg(a.direction, b.direction)) + "°, " +
         number(std::abs(glm::dot(across, cleaned(b.origin - a.origin)))) + " apart";
}

std::string relation_of_planes(const Surface& a, const Surface& b) {
  if (are_same_plane(a, b)) return "the same plane";
  if (are_parallel(a.direction, b.direction)) {
    return "parallel faces, " + number(distance_to_plane(b.origin, a)) + " apart";
  }
  return "faces at " + number(angle_deg(a.direction, b.direction)) + "°";
}

std::string relation_of_plane_and_line(const Surface& plane, const Surface& line,
                                       const std::string& name) {
  if (are_perpendicular(plane.direction, line.direction)) {
    return name + " " + number(distance_to_plane(line.origin, plane)) + " from the face";
  }
  return name + " at " + number(90 - angle_deg(plane.direction, line.direction)) + "° to the face";
}

/// Adds a wall between two ends, each of a height, a radius and a distance of its centre from the
/// local axis.
struct WallEnd {
  Vec3 center_local;
  double radius_local;
};
void add_wall(const Affine& map, const WallEnd& a, const WallEnd& b,
              std::vector<RoundWall>& walls) {
  const std::optional<double> scale = scale_about_axis(map);
  if (!scale || a.center_local == b.center_local) return;
  walls.push_back({{map.point(a.center_local), map.point(b.center_local)},
                   {*scale * a.radius_local, *scale * b.radius_local}});
}

/// Adds the round walls of a kind's solids; most kinds have none.
template <class AnyShape>
void add_walls(const AnyShape&, const Affine&, std::vector<RoundWall>&) {}

void add_walls(const csgcore::FrustumShape& frustum, const Affine& map,
               std::vector<RoundWall>& walls) {
  add_wall(map, {{0, 0, frustum.z_min}, frustum.r_bottom}, {{0, 0, frustum.z_max}, frustum.r_top},
           walls);
}

void add_walls(const csgcore::ExtrusionShape& extrusion, const Affine& map,
               std::vector<RoundWall>& walls) {
  const bool is_straight = extrusion.scale_bottom == extrusion.scale_top;
  for (const csgcore::ProfileLoop& loop : extrusion.profile->loops()) {
    for (const ProfileEdge& edge : loop) {
      if (edge.kind != ProfileEdge::Kind::kArc) continue;
      if (!is_straight && edge.control != Vec2(0.0)) continue;  // an oblique cone
      const double radius = glm::length(edge.end - edge.control);
      const auto end = [&](double z, double scale) {
        return WallEnd{{scale * edge.control, z}, scale * radius};
      };
      add_wall(map, end(extrusion.z_min, extrusion.scale_bottom),
               end(extrusion.z_max, extrusion.scale_top), walls);
    }
  }
}

void add_walls(const csgcore::RevolutionShape& revolution, const Affine& map,
               std::vector<RoundWall>& walls) {
  for (const csgcore::ProfileLoop& loop : revolution.profile->loops()) {
    Vec2 start = loop.empty() ? Vec2(0.0) : loop.back().end;
    for (const ProfileEdge& edge : loop) {
      if (edge.kind == ProfileEdge::Kind::kLine) {
        add_wall(map, {{0, 0, start.y}, start.x}, {{0, 0, edge.end.y}, edge.end.x}, walls);
      }
      start = edge.end;
    }
  }
}

}  // namespace

Surface surface_at(const Primitive& primitive, const Vec3& position, const Vec3& normal) {
  const Affine& map = primitive.local_to_world;
  const SurfacePoint point{primitive, position, normal,
                           csgcore::inverse(map.linear) * (position - map.translation)};
  return std::visit([&](const auto& shape) { return surface_of(shape, point); }, primitive.solid);
}

std::vector<RoundWall> round_walls(const Primitive& primitive) {
  std::vector<RoundWall> walls;
  std::visit([&](const auto& shape) { add_walls(shape, primitive.local_to_world, walls); },
             primitive.solid);
  return walls;
}

bool are_same_plane(const Surface& a, const Surface& b) {
  const double size = std::max(glm::length(a.origin), glm::length(b.origin));
  return are_parallel(a.direction, b.direction) &&
         distance_to_plane(b.origin, a) <= kRounding * size;
}

std::string coordinates(const Vec3& v) {
  const Vec3 c = cleaned(v);
  return "[" + number(c.x) + ", " + number(c.y) + ", " + number(c.z) + "]";
}

std::vector<std::string> words_of(const Surface& surface) {
  const std::string at = coordinates(surface.origin);
  switch (surface.kind) {
    case Surface::Kind::kOther:
      break;
    case Surface::Kind::kPlane:
      if (surface.radius > 0)
        return {"round face, radius " + number(surface.radius), "centre " + at};
      return {"flat, normal " + coordinates(surface.direction)};
    case Surface::Kind::kAxis:
      return {"radius " + number(surface.radius), "axis " + coordinates(surface.direction),
              "centre " + at};
    case Surface::Kind::kCenter:
      return {"radius " + number(surface.radius), "centre " + at};
    case Surface::Kind::kVertex:
      return {"vertex"};
    case Surface::Kind::kEdge:
      return {"edge, length " + number(surface.length),
              "direction " + coordinates(surface.direction)};
    case Surface::Kind::kCircle:
      return {"circle, radius " + number(surface.radius), "axis " + coordinates(surface.direction),
              "centre " + at};
  }
  return {};
}

std::optional<std::string> relation_of(const Surface& a, const Surface& b) {
  const Term first = term_of(a.kind), second = term_of(b.kind);
  if (first.form > second.form) return relation_of(b, a);
  if (first.form == Form::kNone) return std::nullopt;
  if (second.form == Form::kPlane) return relation_of_planes(a, b);
  if (second.form == Form::kLine) {
    return first.form == Form::kLine ? relation_of_lines(a, b, both(first, second))
                                     : relation_of_plane_and_line(a, b, second.one);
  }
  if (first.form == Form::kPoint) {
    return both(first, second) + " " + number(glm::length(a.origin - b.origin)) + " apart";
  }
  const double distance =
      first.form == Form::kPlane ? distance_to_plane(b.origin, a) : distance_to_line(b.origin, a);
  return second.one + " " + number(distance) + " from the " + first.one;
}

}  // namespace window
