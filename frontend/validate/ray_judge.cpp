#include "ray_judge.hpp"

#include <tbb/task_arena.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace validation {

using csgcore::Hits;
using csgcore::Vec3;

Seen seen_at(const Hits& hits, std::size_t pixel) {
  return {hits.primitive[pixel], hits.s[pixel], hits.position[pixel], hits.normal[pixel]};
}

Json json_of(const Vec3& v) { return {v.x, v.y, v.z}; }

Json json_of(const csgcore::Ray& ray, csgcore::Projection projection) {
  const bool is_perspective = projection == csgcore::Projection::kPerspective;
  return {{"origin", json_of(ray.origin)},
          {"direction", json_of(ray.direction)},
          {"projection", is_perspective ? "perspective" : "orthographic"}};
}

Json json_of(const Seen& seen) {
  if (!seen.hit()) return {{"hit", false}};
  return {{"hit", true},
          {"primitive", seen.primitive},
          {"position", json_of(seen.position)},
          {"normal", json_of(seen.normal)}};
}

csgcore::Ray moved(const csgcore::Ray& ray, double angle, double aside, double forward) {
  const Vec3 ahead = glm::normalize(ray.direction);
  const Vec3 across = std::abs(ahead.x) < 0.5 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  const Vec3 right = glm::normalize(glm::cross(ahead, across));
  const Vec3 up = glm::cross(right, ahead);
  const Vec3 sideways = std::cos(angle) * right + std::sin(angle) * up;
  return {ray.origin + aside * sideways + forward * ahead, ray.direction};
}

Seen traced_ray(const csgcore::Subdivision& subdivision, const csgcore::View& view) {
  csgcore::Hits hits;
  csgcore::TraceStats stats;
  // Without isolation, a thread that waits for the tracer's tasks might begin with another ray
  // meanwhile, and nest without end.
  tbb::this_task_arena::isolate([&] { csgcore::trace(subdivision, view, {}, hits, stats); });
  return seen_at(hits, 0);
}

namespace {

using oracle::ExactHit;

class ExactJudge final : public RayJudge {
 public:
  ExactJudge(const oracle::ExactScene& scene, const Tolerance& tolerance)
      : scene_(scene), rays_(scene), tolerance_(tolerance) {}

  Verdict judge(const SeenRay& ray) override {
    const ExactHit expected = rays_.first_hit(ray.ray, ray.projection);
    const char* difference = difference_of(ray.seen, expected);
    Verdict verdict;
    if (!difference) {
      if (expected.hit()) verdict.error = error_of(ray.seen, expected);
    } else if (is_undecided(ray)) {
      verdict.outcome = Outcome::kUndecided;
    } else {
      verdict.outcome = Outcome::kDisagreed;
      if (ray.seen.hit() && expected.hit()) verdict.error = error_of(ray.seen, expected);
      const Seen exact{expected.primitive, expected.s.lower, expected.position, expected.normal};
      verdict.details = {
          {"differs_in", difference}, {"seen", json_of(ray.seen)}, {"expected", json_of(exact)}};
    }
    return verdict;
  }

 private:
  double error_of(const Seen& seen, const ExactHit& expected) const {
    return glm::length(seen.position - expected.position) / scene_.size();
  }

  /// Returns the name of the first difference that matters; null if there is none.
  const char* difference_of(const Seen& seen, const ExactHit& expected) const {
    if (seen.hit() != expected.hit()) return "hit or miss";
    if (!seen.hit()) return nullptr;
    if (seen.primitive != expected.primitive) return "primitive";
    const double rounding = tolerance_.coordinate * glm::length(expected.position);
    const double far = tolerance_.position * scene_.size() + rounding + scene_.displacement();
    const double s_rounding = 2 * tolerance_.coordinate * std::abs(expected.s.lower);
    if (!(glm::length(seen.position - expected.position) <= far)) return "position";
    if (!(std::abs(seen.s - expected.s.lower) <= far + s_rounding)) return "distance";
    if (!(glm::length(seen.normal - expected.normal) <= tolerance_.normal)) return "normal";
    return nullptr;
  }

  bool is_undecided(const SeenRay& ray) {
    if (tolerance_.aside == 0) {
      return rays_.doubt(ray.ray, ray.projection) != oracle::Doubt::kNone;
    }
    constexpr int kDirections = 8;
    for (int i = 0; i < kDirections; ++i) {
      const double angle = 2 * std::numbers::pi * i / kDirections;
      const csgcore::Ray other = moved(ray.ray, angle, tolerance_.aside * scene_.size(), 0);
      if (!difference_of(ray.seen, rays_.first_hit(other, ray.projection))) return true;
    }
    return false;
  }

  const oracle::ExactScene& scene_;
  oracle::ExactRays rays_;
  const Tolerance tolerance_;
};

}  // namespace

std::unique_ptr<RayJudge> make_exact_judge(const oracle::ExactScene& scene,
                                           const Tolerance& tolerance) {
  return std::make_unique<ExactJudge>(scene, tolerance);
}

}  // namespace validation
