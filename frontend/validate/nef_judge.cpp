#include "nef_judge.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "csgcore/polyhedron.hpp"
#include "csgcore/triangle_mesh.hpp"
#include "oracle/exact_rays.hpp"

namespace validation {

using csgcore::Projection;
using csgcore::Ray;
using csgcore::Vec3;
using oracle::Crossing;
using oracle::Place;

namespace {

/// Nothing of the scene is smooth, so that any number of fragments will do.
constexpr int kAnyFragments = 3;

/// Returns the rounding of the box's coordinates after some operations.
double coordinate_rounding(const csgcore::Box& box) {
  double largest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    largest = std::max({largest, std::abs(box.min[axis]), std::abs(box.max[axis])});
  }
  return 0x1p-50 * largest;
}

/// The boundary that a ray sees. Crossings of it that are closer than the tolerance count as one,
/// as in NUMERICS.md §1. A ray that runs in a face sees the boundary where it enters the face; rays
/// beside it see something else, so that it is undecided.
struct Sight {
  std::vector<Crossing> crossings;  // crossings that count as the one that is seen; empty: a miss
  bool hit() const { return !crossings.empty(); }
};

double parameter(const Crossing& crossing) { return 0.5 * (crossing.s_lower + crossing.s_upper); }

class NefJudge final : public RayJudge {
 public:
  NefJudge(const NefTruth& truth, const Tolerance& tolerance)
      : truth_(truth), tolerance_(tolerance) {}

  Verdict judge(const SeenRay& ray) override {
    const Sight sight = look(ray.ray, ray.projection, truth_.thickness());
    const char* difference = difference_of(ray.ray, ray.seen, sight);
    Verdict verdict;
    if (!difference) {
      if (ray.seen.hit()) verdict.error = error_of(ray.ray, ray.seen, sight);
    } else if (is_undecided(ray, sight)) {
      verdict.outcome = Outcome::kUndecided;
    } else {
      verdict.outcome = Outcome::kDisagreed;
      if (ray.seen.hit() && sight.hit()) verdict.error = error_of(ray.ray, ray.seen, sight);
      verdict.details = {{"differs_in", difference},
                         {"seen", json_of(ray.seen)},
                         {"expected", expected(ray.ray, sight)}};
    }
    return verdict;
  }

 private:
  const Vec3& normal_of(const Crossing& crossing) const {
    return truth_.solid().planes()[crossing.plane].unit_normal;
  }

  /// Returns the distance from a crossing to a parameter of the ray, along the crossing's normal.
  double distance(const Ray& ray, const Crossing& from, double s) const {
    return std::abs((s - parameter(from)) * glm::dot(normal_of(from), ray.direction));
  }

  Sight look(const Ray& ray, Projection projection, double thickness) const {
    Sight sight;
    const std::vector<Crossing> all = truth_.solid().crossings(ray);
    Place at_eye = Place::kOutside;
    auto next = all.begin();
    // In a perspective view, crossings within the tolerance of the eye count as passed.
    if (projection == Projection::kPerspective) {
      for (; next != all.end() && parameter(*next) <= thickness; ++next) at_eye = next->after;
    }
    while (next != all.end()) {
      const auto first = next++;
      while (next != all.end() &&
             std::max(distance(ray, *(next - 1), parameter(*next)),
                      distance(ray, *next, parameter(*(next - 1)))) < thickness) {
        ++next;
      }
      if ((next - 1)->after != at_eye) {
        sight.crossings.assign(first, next);
        break;
      }
    }
    return sight;
  }

  /// Returns the error as a share of the size. It is measured along the normals, as the tolerance
  /// is, so that it does not depend on the angle at which the ray meets the surface.
  double error_of(const Ray& ray, const Seen& seen, const Sight& sight) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Crossing& crossing : sight.crossings) {
      least = std::min(least, distance(ray, crossing, seen.s));
    }
    return least / truth_.size();
  }

  /// Returns the name of the first difference that matters; null if there is none.
  const char* difference_of(const Ray& ray, const Seen& seen, const Sight& sight) const {
    if (seen.hit() != sight.hit()) return "hit or miss";
    if (!seen.hit()) return nullptr;
    // The renderer may show a crossing that the solid does not have, within the tolerance of its
    // crossing.
    const double rounding = tolerance_.coordinate * glm::length(seen.position);
    const double far = tolerance_.position * truth_.size() + truth_.thickness() + rounding;
    if (!(error_of(ray, seen, sight) * truth_.size() <= far)) return "position";
    const auto has_normal = [&](const Crossing& crossing) {
      return glm::length(seen.normal - normal_of(crossing)) <= tolerance_.normal;
    };
    if (std::none_of(sight.crossings.begin(), sight.crossings.end(), has_normal)) return "normal";
    if (!is_of(seen, sight, far)) return "primitive";
    return nullptr;
  }

  bool is_of(const Seen& seen, const Sight& sight, double far) const {
    const auto has_primitive = [&](const Crossing& crossing) {
      const auto& polyhedra = truth_.solid().planes()[crossing.plane].polyhedra;
      return std::binary_search(polyhedra.begin(), polyhedra.end(), seen.primitive);
    };
    return std::any_of(sight.crossings.begin(), sight.crossings.end(), has_primitive) ||
           truth_.has_face_at(seen.primitive, seen.position, seen.normal, far);
  }

  bool same(const Ray& ray, const Sight& a, const Sight& b) const {
    if (a.hit() != b.hit()) return false;
    if (!a.hit()) return true;
    const auto is_near = [&](const Crossing& crossing) {
      return glm::length(normal_of(crossing) - normal_of(b.crossings[0])) <= tolerance_.normal &&
             distance(ray, crossing, parameter(b.crossings[0])) <=
                 tolerance_.position * truth_.size() + truth_.thickness();
    };
    return std::any_of(a.crossings.begin(), a.crossings.end(), is_near);
  }

  /// Returns whether a ray or a tolerance that is displaced by the possible rounding sees something
  /// else.
  bool is_undecided(const SeenRay& ray, const Sight& sight) const {
    const double tau = truth_.thickness(), aside = aside_of(ray.ray);
    const auto differs = [&](const Ray& other, double thickness) {
      return !same(ray.ray, sight, look(other, ray.projection, thickness));
    };
    constexpr int kDirections = 8;
    for (int i = 0; i < kDirections; ++i) {
      const double angle = 2 * std::numbers::pi * i / kDirections;
      if (differs(moved(ray.ray, angle, aside, 0), tau)) return true;
    }
    if (ray.projection == Projection::kPerspective &&
        (differs(moved(ray.ray, 0, 0, aside), tau) || differs(moved(ray.ray, 0, 0, -aside), tau))) {
      return true;
    }
    // Both surfaces of a piece may be displaced.
    return differs(ray.ray, tau + 2 * aside) || differs(ray.ray, std::max(0.0, tau - 2 * aside));
  }

  /// Returns the displacement of rays. It is at least the rounding of the origin, below which
  /// moving the ray would change nothing.
  double aside_of(const Ray& ray) const {
    return std::max({tolerance_.aside * truth_.size(), truth_.displacement(),
                     0x1p-50 * glm::length(ray.origin)});
  }

  Json expected(const Ray& ray, const Sight& sight) const {
    if (!sight.hit()) return {{"hit", false}};
    const Crossing& crossing = sight.crossings[0];
    return {{"hit", true},
            {"primitive", truth_.solid().planes()[crossing.plane].polyhedra.front()},
            {"position", json_of(ray.origin + parameter(crossing) * ray.direction)},
            {"normal", json_of(normal_of(crossing))}};
  }

  const NefTruth& truth_;
  const Tolerance tolerance_;
};

}  // namespace

NefTruth::NefTruth(const csgcore::Scene& scene, double size, double thickness,
                   const oracle::NefLimits& limits)
    : size_(size), thickness_(thickness), displacement_(oracle::kExactDisplacement * size) {
  for (const csgcore::Primitive& primitive : scene.primitives) {
    surfaces_.push_back(surface_of(primitive));
  }
  build_ = oracle::NefSolid::build(scene, kAnyFragments, limits);
  if (build_.solid && !build_.solid->empty()) {
    displacement_ += coordinate_rounding(build_.solid->bounds());
  }
}

NefTruth::Surface NefTruth::surface_of(const csgcore::Primitive& primitive) {
  const csgcore::Affine& map = primitive.local_to_world;
  Surface surface;
  if (!primitive.mesh()) {
    const csgcore::Mat3 world_to_local = csgcore::inverse(map.linear);
    for (const csgcore::HalfSpace& half_space : primitive.polyhedron()->half_spaces()) {
      const Vec3 normal = glm::transpose(world_to_local) * half_space.normal;
      const double length = glm::length(normal);
      surface.planes.push_back({normal / length, half_space.offset / length +
                                                     glm::dot(normal / length, map.translation)});
    }
    return surface;
  }
  for (const csgcore::TriangleMesh::Triangle& triangle : primitive.mesh()->triangles()) {
    const auto corner = [&](std::size_t k) {
      return map.point(primitive.mesh()->vertices()[triangle[k]]);
    };
    const Vec3 normal = glm::cross(corner(1) - corner(0), corner(2) - corner(0));
    const double length = glm::length(normal);
    if (!(length > 0)) continue;
    surface.planes.push_back({normal / length, glm::dot(normal / length, corner(0))});
    surface.triangles.push_back({corner(0), corner(1), corner(2)});
  }
  return surface;
}

double NefTruth::Surface::distance(const Vec3& point) const {
  const auto height = [&](const WorldPlane& plane) {
    return glm::dot(plane.unit_normal, point) - plane.offset;
  };
  if (triangles.empty()) {
    double most = -std::numeric_limits<double>::infinity();
    for (const WorldPlane& plane : planes) most = std::max(most, height(plane));
    return std::abs(most);
  }
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto& [a, b, c] = triangles[i];
    const Vec3& normal = planes[i].unit_normal;
    const auto is_left = [&](const Vec3& from, const Vec3& to) {
      return glm::dot(glm::cross(to - from, point - from), normal) >= 0;
    };
    const bool is_above = is_left(a, b) && is_left(b, c) && is_left(c, a);
    const double to_corner =
        std::min({glm::distance(point, a), glm::distance(point, b), glm::distance(point, c)});
    least = std::min(least, is_above ? std::abs(height(planes[i])) : to_corner);
  }
  return least;
}

NefTruth::NearSurface NefTruth::nearest_surface(const Vec3& point) const {
  NearSurface nearest{0, std::numeric_limits<double>::infinity()};
  for (uint32_t primitive = 0; primitive < surfaces_.size(); ++primitive) {
    const double distance = surfaces_[primitive].distance(point);
    if (distance < nearest.distance) nearest = {primitive, distance};
  }
  return nearest;
}

bool NefTruth::has_face_at(uint32_t primitive, const Vec3& point, const Vec3& normal,
                           double distance) const {
  const std::vector<WorldPlane>& planes = surfaces_[primitive].planes;
  return std::any_of(planes.begin(), planes.end(), [&](const WorldPlane& plane) {
    return std::abs(glm::dot(plane.unit_normal, point) - plane.offset) <= distance &&
           1 - std::abs(glm::dot(plane.unit_normal, normal)) <= kDoubleTolerance.normal;
  });
}

std::unique_ptr<RayJudge> make_nef_judge(const NefTruth& truth, const Tolerance& tolerance) {
  return std::make_unique<NefJudge>(truth, tolerance);
}

Verdict judge_point(const NefTruth& truth, const Vec3& point, bool claimed_inside) {
  Verdict verdict;
  const Place place = truth.solid().locate(point);
  if (place == Place::kBoundary) {
    verdict.outcome = Outcome::kUndecided;
  } else if (claimed_inside != (place == Place::kInside)) {
    const auto [primitive, distance] = truth.nearest_surface(point);
    verdict.error = distance / truth.size();
    if (distance <= truth.displacement()) {
      verdict.outcome = Outcome::kUndecided;
    } else {
      verdict.outcome = Outcome::kDisagreed;
      verdict.details = {{"differs_in", "membership"},
                         {"nearest", {{"primitive", primitive}}},
                         {"seen", {{"inside", claimed_inside}}},
                         {"expected", {{"inside", !claimed_inside}}}};
    }
  }
  return verdict;
}

}  // namespace validation
