#include "csgcore/phong_shadows.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <glm/geometric.hpp>
#include <optional>
#include <vector>

#include "base/worker_threads.hpp"
#include "csgcore/light_tracer.hpp"
#include "csgcore/phong.hpp"
#include "frame/sparse_hits.hpp"

namespace csgcore {
namespace {

/// The pixels on which the light could fall.
struct ShadedPixels {
  std::vector<size_t> pixel;
  std::vector<Vec3> position, normal, ray_direction;
};

ShadedPixels find_shaded(const Solid& solid, const View& view, const PhongLight& light,
                         const SparseHits& hits) {
  const bool is_perspective = view.projection == Projection::kPerspective;
  ShadedPixels result;
  for (size_t pixel = 0; pixel < hits.primitive.size(); ++pixel) {
    if (hits.primitive[pixel] == Hits::kMiss) continue;
    const Vec3& position = hits.position[pixel];
    const Vec3& normal = hits.normal[pixel];
    const Vec3 ray_direction = is_perspective ? position - view.eye : view.forward;
    // What is seen from within the solid is not lit by what reaches its outside.
    if (!(glm::dot(normal, ray_direction) < 0)) continue;
    if (!(glm::dot(normal, light.position_world - position) > 0)) continue;
    const std::optional<Color>& color = solid.primitives()[hits.primitive[pixel]].color;
    if (color && color->a < 1) continue;
    result.pixel.push_back(pixel);
    result.position.push_back(position);
    result.normal.push_back(normal);
    result.ray_direction.push_back(ray_direction);
  }
  return result;
}

}  // namespace

void cast_phong_shadows(const Solid& solid, const View& view, const Box& light_box, double strength,
                        const TraceOptions& options, Image& image, TraceStats& stats) {
  const auto start = std::chrono::steady_clock::now();
  const PhongLight light = phong_light(view, light_box);
  with_threads(options.threads, [&] {
    SparseHits hits;
    TraceStats of_hits;
    trace(solid, view, options, hits, of_hits);
    stats.rays += of_hits.rays;
    stats.intersections += of_hits.intersections;
    const ShadedPixels shaded = find_shaded(solid, view, light, hits);
    std::vector<uint8_t> lit(shaded.pixel.size());
    LightTracer(solid).find_lit_from({shaded.position, shaded.normal}, light.position_world, lit,
                                     options.stop);
    if (options.stop.stop_requested()) return;
    tbb::parallel_for(size_t{0}, lit.size(), [&](size_t i) {
      if (lit[i] != 0) return;
      const Vec3& normal = shaded.normal[i];
      const Vec3 to_light = glm::normalize(light.position_world - shaded.position[i]);
      const double unhindered = kPhongAmbient + kPhongDiffuse * glm::dot(normal, to_light);
      const Vec3 highlight =
          phong_color(Vec3(0.0), shaded.position[i], normal, shaded.ray_direction[i], light);
      for (uint8_t& channel : image.rgb[shaded.pixel[i]]) {
        const double own = std::clamp((channel / 255.0 - highlight.x) / unhindered, 0.0, 1.0);
        const double taken = channel - 255 * kPhongAmbient * own;
        channel = static_cast<uint8_t>(channel - strength * taken + 0.5);
      }
    });
  });
  stats.trace_ms +=
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace csgcore
