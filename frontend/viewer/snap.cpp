#include "snap.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

namespace window {
namespace {

using csgcore::Projection;
using csgcore::Vec3;
using csgcore::View;
using Kind = Surface::Kind;

/// More faces than these next to a click are a finely faceted surface, of which the click would
/// always meet some vertex.
constexpr std::size_t kMostFaces = 8;
/// An edge may be met so many times further away than it counts, where it runs towards the click.
constexpr double kFar = 3;
/// A ray along a face runs beside it by this share of a pixel: nothing thinner can be clicked.
constexpr double kBeside_px = 1.0 / 64;
/// It runs beside it at least by this share of its coordinates, which is far above their rounding.
constexpr double kLeastOffset = 1e-7;
/// How far rays run beside an edge that ends in something curved, as a share of that distance.
constexpr double kNear = 1.0 / 64;
/// Faces that meet at a smaller angle, in radians, are pieces of one smooth surface.
constexpr double kLeastAngle = 0.02;
/// Directions are parallel if their sine is smaller: far above the rounding of doubles.
constexpr double kParallel = 1e-7;
constexpr double kEndless = std::numeric_limits<double>::infinity();

/// A face that is seen next to the click, at a point of it.
struct Face {
  RayHit hit;
  double beside = 0;  // how far rays run beside it
};

/// A straight edge of two faces, or a circle.
struct Edge {
  Vec3 point{0.0};              // of the edge
  std::array<Vec3, 2> normals;  // of a straight one's faces
  Surface surface;              // kEdge or kCircle
  Face face;                    // one of its faces
};

double distance_px(const View& view, const Vec3& point, const PicturePoint& place) {
  const std::optional<PicturePoint> seen = project(view, point);
  return seen ? std::hypot(seen->x_px - place.x_px, seen->y_px - place.y_px) : kEndless;
}

/// Returns the point of a line that is nearest to a ray.
Vec3 nearest_on_line(const Vec3& origin, const Vec3& direction, const csgcore::Ray& ray) {
  const Vec3 between = origin - ray.origin;
  const double cosine = glm::dot(direction, ray.direction);
  const double sine2 = 1 - cosine * cosine;
  // A line is seen end-on if it deviates from the ray by less than a millionth: all of its points
  // are as near, and the quotient below would be rounding.
  constexpr double kEndOnSine2 = 1e-12;
  if (sine2 < kEndOnSine2) return origin;
  const double along = cosine * glm::dot(between, ray.direction) - glm::dot(between, direction);
  return origin + (along / sine2) * direction;
}

Vec3 nearest_on_circle(const View& view, const Surface& circle, const PicturePoint& click) {
  constexpr int kStepsOfCircle = 64;
  constexpr double kGolden = 0.6180339887498949;
  // In radians: far below a pixel, and above what the distance's own rounding can tell apart.
  constexpr double kAngleAccuracy = 1e-9;
  const auto point_at = [&](double angle) {
    return circle.origin + circle.radius * direction_across(circle.direction, angle);
  };
  const auto distance = [&](double angle) { return distance_px(view, point_at(angle), click); };
  const double step = 2 * M_PI / kStepsOfCircle;
  int best = 0;
  for (int i = 1; i < kStepsOfCircle; ++i) {
    if (distance(i * step) < distance(best * step)) best = i;
  }
  double low = (best - 1) * step, high = (best + 1) * step;
  while (high - low > kAngleAccuracy) {
    const double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
    (distance(a) < distance(b) ? high : low) = distance(a) < distance(b) ? b : a;
  }
  return point_at((low + high) / 2);
}

class FeatureSearch {
 public:
  FeatureSearch(const ModelRays& rays, const View& view, const PicturePoint& click, double reach_px)
      : rays_(rays), view_(view), click_(click), reach_px_(reach_px) {}

  std::optional<RayHit> find() {
    find_faces();
    for (const Face& face : faces_) {
      if (face.hit.surface.kind == Kind::kPlane) follow_plane(face);
      if (face.hit.surface.kind == Kind::kAxis) follow_axis(face);
    }
    for (Edge& edge : edges_) {
      edge.surface.kind == Kind::kEdge ? offer_straight(edge) : offer_circle(edge);
    }
    if (vertex_) return vertex_;
    if (auto center = center_of_circle(rays_, view_, click_, reach_px_)) return center;
    return on_edge_;
  }

 private:
  Face face_of(const RayHit& hit) const {
    const double reach = glm::length(hit.position) + glm::distance(hit.position, view_.eye);
    return {hit, std::max(kBeside_px * pixel_size(view_, hit.position), kLeastOffset * reach)};
  }

  /// Finds the faces that are seen around the click.
  void find_faces() {
    const auto side_px = static_cast<uint32_t>(2 * std::ceil(reach_px_) + 1);
    std::vector<RayHit> hits = rays_.seen_around(view_, click_, side_px);
    const auto near = [this](const RayHit& hit) {
      return distance_px(view_, hit.position, click_);
    };
    std::stable_sort(hits.begin(), hits.end(),
                     [&](const RayHit& a, const RayHit& b) { return near(a) < near(b); });
    for (const RayHit& hit : hits) {
      const auto is_known = [&](const Face& face) {
        if (face.hit.surface.kind != hit.surface.kind) return false;
        if (hit.surface.kind != Kind::kPlane) return face.hit.primitive == hit.primitive;
        return are_same_plane(face.hit.surface, hit.surface);
      };
      if (std::none_of(faces_.begin(), faces_.end(), is_known)) faces_.push_back(face_of(hit));
      if (faces_.size() > kMostFaces) return faces_.clear();
    }
  }

  /// Looks along a plane face, just below and just above it, for the faces that it meets.
  void follow_plane(const Face& face) {
    for (const double side : kBothSides) {
      for (const RayHit& other : rays_.across(beside(face, side), face.hit.normal)) {
        meet(face, other);
      }
    }
  }

  /// Looks along the straight lines of what is round about an axis.
  void follow_axis(const Face& face) {
    const Vec3& normal = face.hit.normal;
    Vec3 along = face.hit.surface.direction;
    along -= glm::dot(along, normal) * normal;
    if (glm::length(along) < kLeastAngle) return;  // it is nearly flat
    along = glm::normalize(along);
    for (const double side : kBothSides) {
      for (const double way : kBothSides) {
        const auto other = rays_.along(beside(face, side), way * along, kEndless);
        if (other) meet(face, *other);
      }
    }
  }

  static constexpr double kBothSides[] = {-1, 1};
  static Vec3 beside(const Face& face, double side) {
    return face.hit.position + side * face.beside * face.hit.normal;
  }

  /// Notes the edge in which a face meets another one.
  void meet(const Face& face, const RayHit& other) {
    if (distance_px(view_, other.position, click_) > kFar * reach_px_) return;
    const Surface &a = face.hit.surface, &b = other.surface;
    if (a.kind == Kind::kPlane && b.kind == Kind::kPlane) {
      meet_in_line(face, other);
    } else if (a.kind == Kind::kPlane) {
      meet_in_circle(face, face.hit, other);
    } else if (b.kind == Kind::kPlane) {
      meet_in_circle(face, other, face.hit);
    }
  }

  void meet_in_line(const Face& face, const RayHit& other) {
    const Vec3 &a = face.hit.normal, &b = other.normal;
    const Vec3 across = glm::cross(a, b);
    if (glm::length(across) < kLeastAngle) return;
    const Vec3 in_face = b - glm::dot(a, b) * a;
    const Vec3& at = face.hit.position;
    Edge edge;
    // The other face's point is near the edge, this one's is in the plane exactly.
    const Vec3 on_line = at + (glm::dot(other.position - at, b) / glm::dot(in_face, b)) * in_face;
    const Vec3 direction = glm::normalize(across);
    edge.point = on_line + glm::dot(other.position - on_line, direction) * direction;
    edge.normals = {a, b};
    edge.surface = {Kind::kEdge, edge.point, direction};
    edge.face = face;
    const auto is_known = [&](const Edge& known) {
      return known.surface.kind == Kind::kEdge &&
             glm::length(glm::cross(known.surface.direction, direction)) < kLeastAngle &&
             glm::length(glm::cross(known.point - edge.point, direction)) < 2 * face.beside;
    };
    if (std::none_of(edges_.begin(), edges_.end(), is_known)) edges_.push_back(edge);
  }

  /// Notes the circle in which a plane meets what is round about an axis across it, or a ball.
  void meet_in_circle(const Face& face, const RayHit& plane, const RayHit& round) {
    const std::optional<Surface> circle = circle_in(plane, round);
    if (!circle) return;
    const auto is_known = [&](const Edge& known) {
      return known.surface.kind == Kind::kCircle &&
             glm::distance(known.surface.origin, circle->origin) < 2 * face.beside &&
             std::abs(known.surface.radius - circle->radius) < 2 * face.beside;
    };
    if (std::any_of(edges_.begin(), edges_.end(), is_known)) return;
    edges_.push_back({circle->origin, {plane.normal, plane.normal}, *circle, face});
  }

  std::optional<Surface> circle_in(const RayHit& plane, const RayHit& round) const {
    const Vec3& normal = plane.normal;
    const double above = glm::dot(round.position - plane.position, normal);
    if (round.surface.kind == Kind::kCenter) {
      const double height = glm::dot(round.surface.origin - plane.position, normal);
      const double rest = (round.surface.radius - height) * (round.surface.radius + height);
      if (!(rest > 0)) return std::nullopt;
      return Surface{Kind::kCircle, round.surface.origin - height * normal, normal,
                     std::sqrt(rest)};
    }
    if (round.surface.kind != Kind::kAxis) return std::nullopt;
    const Vec3& axis = round.surface.direction;
    if (glm::length(glm::cross(axis, normal)) > kParallel) return std::nullopt;
    // The point of the same straight line of the surface that lies in the plane.
    const Vec3 along = axis - glm::dot(axis, round.normal) * round.normal;
    const double rise = glm::dot(along, normal);
    if (std::abs(rise) < kLeastAngle * kLeastAngle) return std::nullopt;
    const Vec3 in_plane = round.position - (above / rise) * along;
    Surface circle = surface_at(rays_.primitives()[round.primitive], in_plane, round.normal);
    if (circle.kind != Kind::kAxis) return std::nullopt;
    circle.kind = Kind::kCircle;
    return circle;
  }

  /// The sides of an edge: whether they are above each of its faces.
  static constexpr int kSides[][2] = {{-1, -1}, {-1, 1}, {1, -1}, {1, 1}};

  /// Returns how far the edge goes on, one way: until one of the four rays beside it, of which each
  /// is between other sides of its faces, meets something.
  double length_along(const Edge& edge, const Vec3& direction) const {
    const double cosine = glm::dot(edge.normals[0], edge.normals[1]);
    const auto beside = [&](const int(&side)[2], double share) {
      const double a = share * edge.face.beside * side[0], b = share * edge.face.beside * side[1];
      const double whole = 1 - cosine * cosine;
      return ((a - cosine * b) / whole) * edge.normals[0] +
             ((b - cosine * a) / whole) * edge.normals[1];
    };
    std::optional<RayHit> nearest;
    const int(*nearest_side)[2] = nullptr;
    const auto length_to = [&](const RayHit& hit) {
      return glm::dot(hit.position - edge.point, direction);
    };
    for (const auto& side : kSides) {
      const auto hit = rays_.along(edge.point + beside(side, 1), direction, kEndless);
      if (!hit || (nearest && length_to(*nearest) <= length_to(*hit))) continue;
      nearest = hit;
      nearest_side = &side;
    }
    if (!nearest) return 0;
    const double length = length_to(*nearest);
    const double facing = glm::dot(nearest->normal, direction);
    if (nearest->surface.kind == Kind::kPlane && std::abs(facing) > kLeastAngle) {
      return std::max(0.0, glm::dot(nearest->position - edge.point, nearest->normal) / facing);
    }
    // What is curved there is looked at twice more, nearer: the error is nearly in proportion to
    // the distance of the rays from the edge.
    const auto near = rays_.along(edge.point + beside(*nearest_side, kNear), direction, kEndless);
    const auto nearer =
        rays_.along(edge.point + beside(*nearest_side, kNear / 2), direction, kEndless);
    return std::max(0.0, near && nearer ? 2 * length_to(*nearer) - length_to(*near) : length);
  }

  void offer_straight(Edge& edge) {
    const Vec3& direction = edge.surface.direction;
    const csgcore::Ray ray = ray_through(view_, click_);
    Vec3 nearest = nearest_on_line(edge.point, direction, ray);
    if (distance_px(view_, nearest, click_) > reach_px_) return;
    const double after = length_along(edge, direction), before = length_along(edge, -direction);
    const double place = glm::dot(nearest - edge.point, direction);
    nearest = edge.point + std::clamp(place, -before, after) * direction;
    edge.surface.length = after + before;
    edge.surface.ends = {edge.point + after * direction, edge.point - before * direction};
    edge.surface.origin = nearest;
    offer(on_edge_, nearest, edge);
    Edge end = edge;
    end.surface.kind = Kind::kVertex;
    for (const double length : {after, -before}) {
      end.surface.origin = edge.point + length * direction;
      offer(vertex_, end.surface.origin, end);
    }
  }

  void offer_circle(const Edge& edge) {
    offer(on_edge_, nearest_on_circle(view_, edge.surface, click_), edge);
  }

  /// Takes a feature that is seen, and nearer to the click than the one before.
  void offer(std::optional<RayHit>& best, const Vec3& position, const Edge& edge) const {
    const double distance = distance_px(view_, position, click_);
    if (distance > reach_px_ || (best && distance_px(view_, best->position, click_) <= distance)) {
      return;
    }
    if (!rays_.shows(view_, position)) return;
    best = RayHit{position, edge.face.hit.normal, edge.face.hit.primitive, edge.surface};
  }

  const ModelRays& rays_;
  const View& view_;
  const PicturePoint click_;
  const double reach_px_;
  std::vector<Face> faces_;
  std::vector<Edge> edges_;
  std::optional<RayHit> vertex_, on_edge_;
};

}  // namespace

std::optional<RayHit> snap(const ModelRays& rays, const View& view, const PicturePoint& click,
                           double reach_px) {
  return FeatureSearch(rays, view, click, reach_px).find();
}

}  // namespace window
