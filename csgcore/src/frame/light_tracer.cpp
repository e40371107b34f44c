#include "csgcore/light_tracer.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "base/pool.hpp"
#include "rays/frame_rays.hpp"
#include "tiles/tile_tracer.hpp"

namespace csgcore {
namespace {

/// The most pixels along a side of a light's view. More would cost memory, and divide tiles no
/// further than their lists ask for.
constexpr double kMostPixels = 4096;

/// The least width of the points' rectangle, as a share of its height and width together: points in
/// a line then fill the pixels of a few rows. And as a share of their distance from the origin,
/// where they are one: far above a double's rounding, so that the view has some size.
constexpr double kLeastWidth = 1e-6;
constexpr double kLeastSize = 1e-9;

/// Points far from the origin are rounded by some steps of a double there: this share of their
/// coordinates.
constexpr double kCoordinateSteps = 0x1p-50;

/// Returns how far above a point, along its normal, crossings are of the point's own face.
double own_face_height(const Box& bounds) {
  const Vec3 reach = glm::max(glm::abs(bounds.min), glm::abs(bounds.max));
  return 2 * thickness_tolerance(bounds) + kCoordinateSteps * std::max({reach.x, reach.y, reach.z});
}

/// Aims the view, whose forward is set.
void set_axes(View& view) {
  const Vec3 aside = std::abs(view.forward.z) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0};
  view.right = glm::normalize(glm::cross(view.forward, aside));
  view.up = glm::cross(view.right, view.forward);
}

/// Gives the view about `count` pixels, for what lies within this width and height. At least
/// `least` counts of either.
void set_pixels(double width, double height, double least, size_t count, View& view) {
  const double area = std::max(width, least) * std::max(height, least);
  const double pixel = std::max(
      {std::sqrt(area / static_cast<double>(count)), width / kMostPixels, height / kMostPixels});
  const auto pixels = [pixel](double length) {
    return static_cast<uint32_t>(std::clamp(std::ceil(length / pixel), 0.0, kMostPixels)) + 1;
  };
  // Half a pixel more at each side keeps what lies at the edge within the picture.
  view.width_px = pixels(width);
  view.height_px = pixels(height);
  view.half_height = 0.5 * pixel * view.height_px;
}

/// Returns which points get any light.
void find_open(std::span<const LightSum> sums, std::span<uint8_t> lit) {
  std::ranges::transform(sums, lit.begin(), [](const LightSum& sum) { return sum.open > 0; });
}

/// A ray of one view, from the light to a point.
struct LightRay {
  double u, v;         // where it goes through the view's plane, from the middle
  double least_depth;  // along it, from the pivot on: what lies before is the point's own face, or
                       // shades the point
  uint32_t point;
  float weight;  // what the point's sum gets if the light reaches it
};

}  // namespace

/// The rays of one view, and the memory of sorting them by the pixels that they go through.
struct LightTracer::Rays {
  std::vector<LightRay> unsorted;
  std::vector<uint32_t> pixel_of;  // by ray in `unsorted`
  std::vector<LightRay> sorted;
  std::vector<uint32_t> first;  // by pixel: the place of its first ray in `sorted`; and the end

  void sort_by_pixels(const View& view) {
    const double per_unit = view.height_px / (2 * view.half_height);
    const double last_x = view.width_px - 1.0, last_y = view.height_px - 1.0;
    const auto place = [](double at, double last) {
      return static_cast<uint32_t>(std::min(std::max(at, 0.0), last));
    };
    // The number of a pixel's rays is counted two places behind the pixel's. The sum up to one
    // place behind is then where its first ray goes, and at last where the next pixel's first is.
    first.assign(size_t{view.width_px} * view.height_px + 2, 0);
    pixel_of.resize(unsorted.size());
    for (size_t i = 0; i < unsorted.size(); ++i) {
      const uint32_t y = place(0.5 * view.height_px - unsorted[i].v * per_unit, last_y);
      const uint32_t x = place(0.5 * view.width_px + unsorted[i].u * per_unit, last_x);
      pixel_of[i] = y * view.width_px + x;
      ++first[pixel_of[i] + 2];
    }
    for (size_t i = 2; i < first.size(); ++i) first[i] += first[i - 1];
    sorted.resize(unsorted.size());
    for (size_t i = 0; i < unsorted.size(); ++i) sorted[first[pixel_of[i] + 1]++] = unsorted[i];
  }
};

/// Answers for rays, tile by tile.
class LightTracer::Visitor final : public TileVisitor {
 public:
  Visitor(const FrameRays& frame, const Rays& rays, std::span<LightSum> sums)
      : frame_(frame), rays_(rays), sums_(sums) {}

  bool wants(const Tile& tile) const override {
    for (uint32_t y = tile.y; y < tile.y + tile.height; ++y) {
      if (first_of(tile.x, y) < first_of(tile.x + tile.width, y)) return true;
    }
    return false;
  }

  void visit_empty(const Tile& tile) override {
    for_each_ray(tile, [&](const LightRay& ray) { light(ray); });
  }

  void visit(const Tile& tile, TileRays& rays) override {
    LightRay packet[kPacketRays];
    uint32_t count = 0;
    for_each_ray(tile, [&](const LightRay& ray) {
      packet[count++] = ray;
      if (count < kPacketRays) return;
      trace({packet, count}, rays);
      count = 0;
    });
    if (count > 0) trace({packet, count}, rays);
  }

 private:
  void light(const LightRay& ray) { sums_[ray.point].open += ray.weight; }

  /// Returns the place of the first ray of a pixel, or of what follows the row's last.
  uint32_t first_of(uint32_t x, uint32_t y) const {
    return rays_.first[size_t{y} * frame_.view.width_px + x];
  }

  template <typename Visit>
  void for_each_ray(const Tile& tile, const Visit& visit) const {
    for (uint32_t y = tile.y; y < tile.y + tile.height; ++y) {
      const uint32_t end = first_of(tile.x + tile.width, y);
      for (uint32_t i = first_of(tile.x, y); i < end; ++i) visit(rays_.sorted[i]);
    }
  }

  void trace(std::span<const LightRay> packet, TileRays& rays) {
    PacketLaterals laterals{};
    for (uint32_t lane = 0; lane < kPacketRays; ++lane) {
      const LightRay& ray = packet[lane < packet.size() ? lane : 0];
      laterals.u[lane] = ray.u;
      laterals.v[lane] = ray.v;
    }
    RayPacket ray_packet;
    make_rays(frame_, laterals, ray_packet);
    const LaneMask lanes =
        packet.size() == kPacketRays ? kAllLanes : (LaneMask{1} << packet.size()) - 1;
    // What lies at a point's own face or behind it leaves the point in the light.
    PacketLimits limits;
    for (uint32_t lane = 0; lane < kPacketRays; ++lane) {
      const Vec3 origin{ray_packet.origin[0][lane], ray_packet.origin[1][lane],
                        ray_packet.origin[2][lane]};
      limits.last_t[lane] = packet[lane < packet.size() ? lane : 0].least_depth -
                            glm::dot(origin, frame_.view.forward);
    }
    PacketHits hits;
    rays.trace(ray_packet, lanes, &limits, hits);
    for (uint32_t lane = 0; lane < packet.size(); ++lane) {
      const bool is_hit = (hits.hits >> lane & 1) != 0;
      if (!is_hit || hits.t[lane] >= limits.last_t[lane]) light(packet[lane]);
    }
  }

  const FrameRays& frame_;
  const Rays& rays_;
  const std::span<LightSum> sums_;
};

struct LightTracer::Memory {
  std::shared_ptr<TileTracer::Workspaces> tiles = std::make_shared<TileTracer::Workspaces>();
  Pool<Rays> rays;
};

LightTracer::LightTracer(const Solid& solid) : solid_(solid), memory_(std::make_unique<Memory>()) {}
LightTracer::~LightTracer() = default;

void LightTracer::add_light(const SurfacePoints& points, const Vec3& to_light,
                            std::span<LightSum> sums, const std::stop_token& stop) const {
  if (stop.stop_requested()) return;
  std::unique_ptr<Rays> rays = take_rays();
  View view;
  view.projection = Projection::kOrthographic;
  view.forward = -to_light;
  set_axes(view);
  // What is far from the origin is seen from within its box, so that little is rounded.
  const Box& bounds = solid_.bounds();
  const Vec3 center = bounds.center();
  const double own_face = own_face_height(bounds);
  Vec3 low(std::numeric_limits<double>::infinity());
  Vec3 high = -low;
  for (uint32_t i = 0; i < points.normal.size(); ++i) {
    const double cosine = glm::dot(points.normal[i], to_light);
    if (!(cosine > 0)) continue;
    const Vec3 offset = points.position[i] - center;
    const Vec3 seen(glm::dot(offset, view.right), glm::dot(offset, view.up),
                    glm::dot(offset, view.forward));
    low = glm::min(low, seen);
    high = glm::max(high, seen);
    const auto weight = static_cast<float>(cosine);
    sums[i].all += weight;
    rays->unsorted.push_back({seen.x, seen.y, seen.z - own_face / cosine, i, weight});
  }
  if (rays->unsorted.empty()) return;
  const Vec3 middle = 0.5 * (low + high);
  view.eye = center + middle.x * view.right + middle.y * view.up + middle.z * view.forward;
  // Where the points lie in a line, or are one, the rectangle has some width all the same.
  const double width = high.x - low.x, height = high.y - low.y;
  const double least = std::max({kLeastWidth * (width + height), kLeastSize * glm::length(view.eye),
                                 std::numeric_limits<double>::min()});
  set_pixels(width, height, least, rays->unsorted.size(), view);
  const FrameRays frame = frame_rays(view, bounds);
  const Vec3 from_eye = center - view.eye;
  const double u = glm::dot(from_eye, view.right), v = glm::dot(from_eye, view.up);
  const double depth = glm::dot(center - frame.pivot, view.forward);
  for (LightRay& ray : rays->unsorted) {
    ray.u += u;
    ray.v += v;
    ray.least_depth += depth;
  }
  look(frame, std::move(rays), sums, stop);
}

void LightTracer::find_lit(const SurfacePoints& points, const Vec3& to_light,
                           std::span<uint8_t> lit, const std::stop_token& stop) const {
  std::vector<LightSum> sums(lit.size());
  add_light(points, to_light, sums, stop);
  find_open(sums, lit);
}

void LightTracer::find_lit_from(const SurfacePoints& points, const Vec3& light,
                                std::span<uint8_t> lit, const std::stop_token& stop) const {
  std::vector<uint32_t> facing;
  Vec3 toward(0.0);
  for (uint32_t i = 0; i < points.normal.size(); ++i) {
    const Vec3 from_light = points.position[i] - light;
    if (!(glm::dot(points.normal[i], from_light) < 0)) continue;
    facing.push_back(i);
    toward += glm::normalize(from_light);
  }
  std::vector<LightSum> sums(lit.size());
  View view;
  view.eye = light;
  view.forward = glm::length(toward) > 0 ? glm::normalize(toward) : Vec3{0, 0, 1};
  set_axes(view);
  // The sides of a cube around the light. Mostly all points are seen through the first of them.
  const Vec3 axes[] = {view.forward, view.right, view.up, -view.forward, -view.right, -view.up};
  std::vector<uint32_t> seen[std::size(axes)];
  for (const uint32_t point : facing) {
    const Vec3 from_light = points.position[point] - light;
    const auto side = std::ranges::max_element(
        axes, {}, [&](const Vec3& axis) { return glm::dot(axis, from_light); });
    seen[side - axes].push_back(point);
  }
  const double own_face = own_face_height(solid_.bounds());
  for (size_t side = 0; side < std::size(axes); ++side) {
    if (seen[side].empty()) continue;
    std::unique_ptr<Rays> rays = take_rays();
    view.forward = axes[side];
    set_axes(view);
    double width = 0, height = 0;
    for (const uint32_t point : seen[side]) {
      const Vec3 from_light = points.position[point] - light;
      const double s = glm::dot(from_light, view.forward);
      const double u = glm::dot(from_light, view.right) / s, v = glm::dot(from_light, view.up) / s;
      width = std::max(width, 2 * std::abs(u));
      height = std::max(height, 2 * std::abs(v));
      const Vec3 direction = view.forward + u * view.right + v * view.up;
      rays->unsorted.push_back(
          {u, v, own_face / glm::dot(points.normal[point], direction), point, 1});
    }
    set_pixels(width, height, kLeastSize, seen[side].size(), view);
    const FrameRays frame = frame_rays(view, solid_.bounds());
    for (LightRay& ray : rays->unsorted) {
      ray.least_depth += glm::dot(points.position[ray.point] - frame.pivot, view.forward);
    }
    look(frame, std::move(rays), sums, stop);
  }
  find_open(sums, lit);
}

std::unique_ptr<LightTracer::Rays> LightTracer::take_rays() const {
  std::unique_ptr<Rays> rays = memory_->rays.take();
  if (!rays) return std::make_unique<Rays>();
  rays->unsorted.clear();
  return rays;
}

/// Answers for rays that lie within the view's picture.
void LightTracer::look(const FrameRays& frame, std::unique_ptr<Rays> rays, std::span<LightSum> sums,
                       const std::stop_token& stop) const {
  TraceParameters parameters;
  parameters.thickness_tolerance = thickness_tolerance(solid_.bounds());
  parameters.stop = stop;
  TileTracer tracer(solid_, frame, parameters, TileRules{.centers_only = false}, memory_->tiles);
  rays->sort_by_pixels(frame.view);
  Visitor visitor(frame, *rays, sums);
  tracer.visit({0, 0, frame.view.width_px, frame.view.height_px}, visitor);
  memory_->rays.give_back(std::move(rays));
}

}  // namespace csgcore
