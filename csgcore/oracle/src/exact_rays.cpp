#include "oracle/exact_rays.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <mutex>
#include <numbers>
#include <thread>

#include "exact_walk.hpp"

namespace oracle {

using csgcore::Projection;
using csgcore::Ray;
using csgcore::Scene;
using csgcore::Vec3;
using csgcore::View;

void ExactCounts::add(const ExactCounts& other) {
  rays += other.rays;
  segments += other.segments;
  exact_segments += other.exact_segments;
  comparisons += other.comparisons;
  exact_comparisons += other.exact_comparisons;
  thicknesses += other.thicknesses;
  unsettled_thicknesses += other.unsettled_thicknesses;
}

class ExactScene::Impl : public PreparedScene {
 public:
  using PreparedScene::PreparedScene;
};

ExactScene::ExactScene(const Scene& scene) : impl_(std::make_unique<Impl>(scene)) {}
ExactScene::~ExactScene() = default;
double ExactScene::size() const { return impl_->size; }
double ExactScene::thickness() const { return impl_->thickness; }
double ExactScene::displacement() const { return impl_->displacement; }

class ExactRays::Impl {
 public:
  explicit Impl(const PreparedScene& scene) : scene_(scene), walk_(scene) {}

  const ExactCounts& counts() const { return walk_.counts(); }

  ExactHit first_hit(const Ray& ray, Projection projection) {
    const RoundingUp rounding_up;
    return walk_.see({ray, projection, scene_.thickness}).hit;
  }

  Doubt doubt(const Ray& ray, Projection projection) {
    const RoundingUp rounding_up;
    const SeenRay own{ray, projection, scene_.thickness};
    const ExactWalk::Shown seen = walk_.see(own);
    if (walk_.unsettled()) return Doubt::kThickness;
    const auto differs = [&](const SeenRay& other) { return !same(seen, walk_.see(other)); };
    const auto moved_differs = [&](const Vec3& towards) {
      SeenRay moved = own;
      moved.shift = scene_.displacement * towards;
      return differs(moved);
    };
    const Vec3 forward = glm::normalize(ray.direction);
    const Vec3 right = glm::normalize(glm::cross(forward, axis_across(forward)));
    const Vec3 up = glm::cross(right, forward);
    constexpr int kDirections = 8;
    for (int i = 0; i < kDirections; ++i) {
      const double angle = 2 * std::numbers::pi * i / kDirections;
      if (moved_differs(std::cos(angle) * right + std::sin(angle) * up)) return Doubt::kSilhouette;
    }
    if (projection == Projection::kPerspective &&
        (moved_differs(forward) || moved_differs(-forward))) {
      return Doubt::kEye;
    }
    // Each of two surfaces may be displaced.
    for (const double sign : {-1, 1}) {
      SeenRay other = own;
      other.thickness = std::max(0.0, own.thickness + sign * 2 * scene_.displacement);
      if (differs(other)) return Doubt::kThickness;
    }
    return Doubt::kNone;
  }

 private:
  /// Returns a coordinate axis that is not parallel to the direction.
  static Vec3 axis_across(const Vec3& direction) {
    return std::abs(direction.x) < 0.5 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  }

  bool same(const ExactWalk::Shown& a, const ExactWalk::Shown& b) const {
    if (a.hit.primitive != b.hit.primitive) return false;
    return glm::length(a.from_pivot - b.from_pivot) <= kExactPositionError * scene_.size &&
           glm::length(a.hit.normal - b.hit.normal) <= kExactNormalError;
  }

  const PreparedScene& scene_;
  ExactWalk walk_;
};

ExactRays::ExactRays(const ExactScene& scene) : impl_(std::make_unique<Impl>(*scene.impl_)) {}
ExactRays::~ExactRays() = default;
const ExactCounts& ExactRays::counts() const { return impl_->counts(); }

ExactHit ExactRays::first_hit(const Ray& ray, Projection projection) {
  return impl_->first_hit(ray, projection);
}

Doubt ExactRays::doubt(const Ray& ray, Projection projection) {
  return impl_->doubt(ray, projection);
}

std::vector<ExactHit> exact_picture(const ExactScene& scene, const View& view,
                                    ExactCounts* counts) {
  std::vector<ExactHit> picture(size_t{view.width_px} * view.height_px);
  std::atomic<uint32_t> next_row{0};
  std::mutex counting;
  const auto draw_rows = [&] {
    ExactRays rays(scene);
    for (uint32_t y; (y = next_row++) < view.height_px;) {
      for (uint32_t x = 0; x < view.width_px; ++x) {
        picture[size_t{y} * view.width_px + x] =
            rays.first_hit(csgcore::pixel_ray(view, x, y), view.projection);
      }
    }
    const std::lock_guard lock(counting);
    if (counts) counts->add(rays.counts());
  };
  std::vector<std::thread> threads(std::max(1u, std::thread::hardware_concurrency()));
  for (std::thread& thread : threads) thread = std::thread(draw_rows);
  for (std::thread& thread : threads) thread.join();
  return picture;
}

}  // namespace oracle
