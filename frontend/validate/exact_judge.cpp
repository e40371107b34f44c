#include "exact_judge.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace validation {
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
