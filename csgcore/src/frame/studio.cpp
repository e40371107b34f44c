// Each point that is seen asks a part of the directions; the 16 pixels of any square of 4 × 4 have
// all of them (interleaved sampling: Keller and Heidrich, Rendering Techniques 2001). So a point's
// light is that of the square around it, as far as the same face goes on there.
#include "csgcore/studio.hpp"

#include <tbb/parallel_for.h>

#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "base/worker_threads.hpp"
#include "csgcore/light_tracer.hpp"
#include "csgcore/studio_light.hpp"

namespace csgcore {
namespace {

constexpr uint32_t kSquare_px = 4;
constexpr uint32_t kGroups = kSquare_px * kSquare_px;
/// One direction goes to the key light for so many of the whole sky.
constexpr uint32_t kPerKeyDirection = 4;
/// The tangent of the angle between the middle of the key light, which is a disc, and its rim:
/// shadows are soft away from what casts them.
constexpr double kKeyRadius = 0.06;

constexpr uint32_t kNoPoint = std::numeric_limits<uint32_t>::max();

/// The cosine of the largest angle between normals of the same smooth face in pixels side by side.
const double kSmoothCosine = std::cos(20 * std::numbers::pi / 180);
/// The same between faces of different primitives, which may touch in a line that is to be seen.
const double kMeetingCosine = std::cos(6 * std::numbers::pi / 180);
/// The sine of the largest angle of the line between two such pixels' points to both faces.
constexpr double kLargestRise = 0.3;
/// What a line leaves of the colour below it.
constexpr double kLineShade = 0.3;

/// Returns direction i of n that are spread evenly over the sphere: a Fibonacci lattice.
Vec3 sky_direction(uint32_t i, uint32_t n) {
  const double z = 1 - (2.0 * i + 1) / n;
  const double turn = 2 * std::numbers::pi * (std::numbers::phi - 1) * i;
  const double radius = std::sqrt(1 - z * z);
  return {radius * std::cos(turn), radius * std::sin(turn), z};
}

/// Returns direction i of n towards the key light's disc.
Vec3 key_direction(const View& view, const Vec3& key, uint32_t i, uint32_t n) {
  const Vec3 across = glm::normalize(glm::cross(key, view.up));
  const double turn = 2 * std::numbers::pi * (std::numbers::phi - 1) * i;
  const double radius = kKeyRadius * std::sqrt((i + 0.5) / n);
  return glm::normalize(
      key + radius * (std::cos(turn) * across + std::sin(turn) * glm::cross(key, across)));
}

/// Sums over the directions that a point has asked, weighted by its normal's cosine.
struct Light {
  float sky = 0, open_sky = 0;
  float key = 0, open_key = 0;
  Light& operator+=(const Light& other) {
    sky += other.sky;
    open_sky += other.open_sky;
    key += other.key;
    open_key += other.open_key;
    return *this;
  }
};

float share(float part, float all) { return all > 0 ? part / all : 1; }

class Studio {
 public:
  Studio(const Solid& solid, const View& view, const StudioSettings& settings,
         const TraceOptions& options, Image& image)
      : solid_(solid),
        view_(view),
        light_(studio_light(view)),
        settings_(settings),
        options_(options),
        image_(image) {}

  void finish(TraceStats& stats) {
    TraceStats of_hits;
    trace(solid_, view_, options_, hits_, of_hits);
    stats.rays += of_hits.rays;
    stats.intersections += of_hits.intersections;
    collect_points();
    const bool has_light = settings_.occlusion > 0 || settings_.shadows > 0;
    if (has_light) ask_for_light();
    if (options_.stop.stop_requested()) return;
    tbb::parallel_for(uint32_t{0}, view_.height_px, [&](uint32_t y) {
      for (uint32_t x = 0; x < view_.width_px; ++x) {
        double factor = has_light ? light_at(x, y) : 1;
        if (settings_.edges > 0 && is_edge(x, y)) {
          factor *= 1 - settings_.edges * (1 - kLineShade);
        }
        for (uint8_t& channel : image_.rgb[index(x, y)]) {
          channel = static_cast<uint8_t>(channel * factor + 0.5);
        }
      }
    });
  }

 private:
  size_t index(uint32_t x, uint32_t y) const { return size_t{y} * view_.width_px + x; }

  Vec3 towards_viewer(const Vec3& position) const {
    return view_.projection == Projection::kPerspective ? view_.eye - position : -view_.forward;
  }

  bool is_translucent(uint32_t primitive) const {
    const std::optional<Color>& color = solid_.primitives()[primitive].color;
    return color && color->a < 1;
  }

  /// Faces that are seen from within the solid have no light of their own to lose, and what is seen
  /// through translucent ones has another.
  void collect_points() {
    point_of_.assign(hits_.s.size(), kNoPoint);
    for (uint32_t y = 0; y < view_.height_px; ++y) {
      for (uint32_t x = 0; x < view_.width_px; ++x) {
        const size_t pixel = index(x, y);
        if (hits_.primitive[pixel] == Hits::kMiss || is_translucent(hits_.primitive[pixel]))
          continue;
        const Vec3& position = hits_.position[pixel];
        if (!(glm::dot(hits_.normal[pixel], towards_viewer(position)) > 0)) continue;
        const auto point = static_cast<uint32_t>(positions_.size());
        point_of_[pixel] = point;
        positions_.push_back(position);
        normals_.push_back(hits_.normal[pixel]);
        groups_[y % kSquare_px * kSquare_px + x % kSquare_px].push_back(point);
      }
    }
    sums_.resize(positions_.size());
  }

  void ask_for_light() {
    const LightTracer tracer(solid_);
    tbb::parallel_for(uint32_t{0}, kGroups, [&](uint32_t group) {
      const std::vector<uint32_t>& asked = groups_[group];
      std::vector<uint8_t> lit(asked.size());
      const auto ask = [&](const Vec3& direction, float Light::*all, float Light::*open) {
        if (options_.stop.stop_requested()) return;
        tracer.find_lit({positions_, normals_}, asked, direction, lit, options_.stop);
        for (size_t i = 0; i < asked.size(); ++i) {
          const double cosine = glm::dot(normals_[asked[i]], direction);
          if (cosine <= 0) continue;
          Light& light = sums_[asked[i]];
          light.*all += static_cast<float>(cosine);
          if (lit[i] != 0) light.*open += static_cast<float>(cosine);
        }
      };
      if (settings_.occlusion > 0) {
        const uint32_t count = settings_.directions;
        for (uint32_t i = group; i < count; i += kGroups) {
          ask(sky_direction(i, count), &Light::sky, &Light::open_sky);
        }
      }
      if (settings_.shadows > 0) {
        const uint32_t count = settings_.directions / kPerKeyDirection;
        for (uint32_t i = group; i < count; i += kGroups) {
          ask(key_direction(view_, light_.key, i, count), &Light::key, &Light::open_key);
        }
      }
    });
  }

  /// Whether two pixels side by side, or nearly so, show the same smooth face.
  bool are_of_one_face(size_t a, size_t b) const {
    if (hits_.primitive[a] == Hits::kMiss || hits_.primitive[b] == Hits::kMiss) return false;
    const double least = hits_.primitive[a] == hits_.primitive[b] ? kSmoothCosine : kMeetingCosine;
    if (glm::dot(hits_.normal[a], hits_.normal[b]) < least) return false;
    return !is_step(a, b);
  }

  /// Whether one of two faces ends before the other.
  bool is_step(size_t a, size_t b) const {
    const Vec3 line = hits_.position[b] - hits_.position[a];
    const double rise = std::min(std::abs(glm::dot(hits_.normal[a], line)),
                                 std::abs(glm::dot(hits_.normal[b], line)));
    return rise > kLargestRise * glm::length(line);
  }

  /// Returns by how much the colour of a pixel gets darker.
  double light_at(uint32_t x, uint32_t y) const {
    const size_t pixel = index(x, y);
    if (point_of_[pixel] == kNoPoint) return 1;
    Light sum;
    for_each_near(x, y, [&](size_t other) {
      if (point_of_[other] == kNoPoint || !are_of_one_face(pixel, other)) return;
      sum += sums_[point_of_[other]];
    });
    const double open = 1 - settings_.occlusion * (1 - share(sum.open_sky, sum.sky));
    const double key = 1 - settings_.shadows * (1 - share(sum.open_key, sum.key));
    const Vec3& normal = hits_.normal[pixel];
    return studio_shade(light_, normal, open, key) / studio_shade(light_, normal, 1, 1);
  }

  template <typename Visit>
  void for_each_near(uint32_t x, uint32_t y, const Visit& visit) const {
    constexpr uint32_t kBefore = kSquare_px / 2 - 1, kAfter = kSquare_px / 2;
    for (uint32_t row = y - std::min(y, kBefore); row <= std::min(y + kAfter, view_.height_px - 1);
         ++row) {
      for (uint32_t column = x - std::min(x, kBefore);
           column <= std::min(x + kAfter, view_.width_px - 1); ++column) {
        visit(index(column, row));
      }
    }
  }

  /// Whether the face that the pixel shows ends beside it, before another one or in a crease.
  bool is_edge(uint32_t x, uint32_t y) const {
    const size_t pixel = index(x, y);
    if (hits_.primitive[pixel] == Hits::kMiss) return false;
    const auto ends_at = [&](size_t other) {
      if (are_of_one_face(pixel, other)) return false;
      return hits_.primitive[other] == Hits::kMiss || !is_step(pixel, other) ||
             hits_.s[pixel] < hits_.s[other];
    };
    return (x > 0 && ends_at(pixel - 1)) || (x + 1 < view_.width_px && ends_at(pixel + 1)) ||
           (y > 0 && ends_at(pixel - view_.width_px)) ||
           (y + 1 < view_.height_px && ends_at(pixel + view_.width_px));
  }

  const Solid& solid_;
  const View& view_;
  const StudioLight light_;
  const StudioSettings& settings_;
  const TraceOptions& options_;
  Image& image_;
  Hits hits_;
  std::vector<uint32_t> point_of_;  // by pixel; kNoPoint: it shows none that light falls on
  std::vector<Vec3> positions_, normals_;
  std::vector<Light> sums_;  // by point
  std::array<std::vector<uint32_t>, kGroups> groups_;
};

}  // namespace

void finish_studio(const Solid& solid, const View& view, const StudioSettings& settings,
                   const TraceOptions& options, Image& image, TraceStats& stats) {
  const auto start = std::chrono::steady_clock::now();
  with_threads(options.threads,
               [&] { Studio(solid, view, settings, options, image).finish(stats); });
  stats.trace_ms +=
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace csgcore
