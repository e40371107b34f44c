#include "csgcore/light_tracer.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

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
double own_face(const Box& bounds) {
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

/// Returns an orthographic view along −to_light of the points' rectangle, with about one pixel a
/// point.
View light_view(const SurfacePoints& points, std::span<const uint32_t> facing,
                const Vec3& to_light) {
  View view;
  view.projection = Projection::kOrthographic;
  view.forward = -to_light;
  set_axes(view);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Vec3 low(kInfinity), high(-kInfinity);
  for (const uint32_t point : facing) {
    const Vec3& p = points.position[point];
    const Vec3 seen(glm::dot(p, view.right), glm::dot(p, view.up), glm::dot(p, view.forward));
    low = glm::min(low, seen);
    high = glm::max(high, seen);
  }
  const Vec3 center = 0.5 * (low + high);
  view.eye = center.x * view.right + center.y * view.up + center.z * view.forward;
  // Where the points lie in a line, or are one, the rectangle has some width all the same.
  const double width = high.x - low.x, height = high.y - low.y;
  const double least = std::max({kLeastWidth * (width + height), kLeastSize * glm::length(center),
                                 std::numeric_limits<double>::min()});
  set_pixels(width, height, least, facing.size(), view);
  return view;
}

}  // namespace

struct LightTracer::Memory {
  std::shared_ptr<TileTracer::Workspaces> tiles = std::make_shared<TileTracer::Workspaces>();
};

LightTracer::LightTracer(const Solid& solid) : solid_(solid), memory_(std::make_unique<Memory>()) {}
LightTracer::~LightTracer() = default;

/// The rays of one direction, sorted by the pixels of its view that they go through.
class LightTracer::Rays final : public TileVisitor {
 public:
  Rays(const FrameRays& frame, const SurfacePoints& points, std::span<const uint32_t> facing,
       double tolerance, std::span<uint8_t> lit)
      : frame_(frame), lit_(lit), first_(size_t{frame.view.width_px} * frame.view.height_px + 1) {
    const View& view = frame.view;
    std::vector<Ray> rays;
    std::vector<uint32_t> pixel_of;
    rays.reserve(facing.size());
    pixel_of.reserve(facing.size());
    for (const uint32_t point : facing) {
      const Vec3& position = points.position[point];
      const Vec3 from_eye = position - view.eye;
      double u = glm::dot(from_eye, view.right), v = glm::dot(from_eye, view.up);
      Vec3 direction = view.forward;
      if (view.projection == Projection::kPerspective) {
        const double s = glm::dot(from_eye, view.forward);
        u /= s;
        v /= s;
        direction += u * view.right + v * view.up;
      }
      const double cosine = -glm::dot(points.normal[point], direction);
      const Ray ray{u, v, glm::dot(position - frame.pivot, view.forward) - tolerance / cosine,
                    point};
      rays.push_back(ray);
      pixel_of.push_back(pixel_at(ray.u, ray.v));
      ++first_[pixel_of.back() + 1];
    }
    for (size_t pixel = 1; pixel < first_.size(); ++pixel) first_[pixel] += first_[pixel - 1];
    sorted_.resize(rays.size());
    std::vector<uint32_t> next(first_.begin(), first_.end() - 1);
    for (size_t i = 0; i < rays.size(); ++i) sorted_[next[pixel_of[i]]++] = rays[i];
  }

  bool wants(const Tile& tile) const override {
    for (uint32_t y = tile.y; y < tile.y + tile.height; ++y) {
      if (first_of(tile.x, y) < first_of(tile.x + tile.width, y)) return true;
    }
    return false;
  }

  void visit_empty(const Tile& tile) override {
    for_each_ray(tile, [&](const Ray& ray) { lit_[ray.point] = 1; });
  }

  void visit(const Tile& tile, TileRays& rays) override {
    Ray packet[kPacketRays];
    uint32_t count = 0;
    for_each_ray(tile, [&](const Ray& ray) {
      packet[count++] = ray;
      if (count < kPacketRays) return;
      trace({packet, count}, rays);
      count = 0;
    });
    if (count > 0) trace({packet, count}, rays);
  }

 private:
  struct Ray {
    double u, v;         // where it goes through the view's plane, from the middle
    double least_depth;  // along it, from the pivot on: what lies before is the point's own face,
                         // or shades the point
    uint32_t point;
  };

  uint32_t pixel_at(double u, double v) const {
    const View& view = frame_.view;
    const double per_unit = view.height_px / (2 * view.half_height);
    const auto place = [](double at, uint32_t count) {
      return static_cast<uint32_t>(std::clamp(std::floor(at), 0.0, count - 1.0));
    };
    return place(0.5 * view.height_px - v * per_unit, view.height_px) * view.width_px +
           place(0.5 * view.width_px + u * per_unit, view.width_px);
  }

  /// Returns the place in sorted_ of the first ray of a pixel, or of what follows the row's last.
  uint32_t first_of(uint32_t x, uint32_t y) const {
    return first_[size_t{y} * frame_.view.width_px + x];
  }

  template <typename Visit>
  void for_each_ray(const Tile& tile, const Visit& visit) const {
    for (uint32_t y = tile.y; y < tile.y + tile.height; ++y) {
      const uint32_t end = first_of(tile.x + tile.width, y);
      for (uint32_t i = first_of(tile.x, y); i < end; ++i) visit(sorted_[i]);
    }
  }

  void trace(std::span<const Ray> packet, TileRays& rays) {
    PacketLaterals laterals{};
    for (uint32_t lane = 0; lane < kPacketRays; ++lane) {
      const Ray& ray = packet[lane < packet.size() ? lane : 0];
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
      lit_[packet[lane].point] = !is_hit || hits.t[lane] >= limits.last_t[lane];
    }
  }

  const FrameRays& frame_;
  const std::span<uint8_t> lit_;
  std::vector<uint32_t> first_;  // by pixel: the place of its first ray in sorted_
  std::vector<Ray> sorted_;      // by pixels
};

void LightTracer::find_lit(const SurfacePoints& points, const Vec3& to_light,
                           std::span<uint8_t> lit, const std::stop_token& stop) const {
  std::vector<uint32_t> facing;
  for (uint32_t i = 0; i < points.normal.size(); ++i) {
    lit[i] = 0;
    if (glm::dot(points.normal[i], to_light) > 0) facing.push_back(i);
  }
  if (facing.empty()) return;
  look(light_view(points, facing, to_light), points, facing, lit, stop);
}

void LightTracer::find_lit_from(const SurfacePoints& points, const Vec3& light,
                                std::span<uint8_t> lit, const std::stop_token& stop) const {
  std::vector<uint32_t> facing;
  Vec3 toward(0.0);
  for (uint32_t i = 0; i < points.normal.size(); ++i) {
    lit[i] = 0;
    const Vec3 from_light = points.position[i] - light;
    if (!(glm::dot(points.normal[i], from_light) < 0)) continue;
    facing.push_back(i);
    toward += glm::normalize(from_light);
  }
  if (facing.empty()) return;
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
  for (size_t side = 0; side < std::size(axes); ++side) {
    if (seen[side].empty()) continue;
    view.forward = axes[side];
    set_axes(view);
    double width = 0, height = 0;
    for (const uint32_t point : seen[side]) {
      const Vec3 from_light = points.position[point] - light;
      const double s = glm::dot(from_light, view.forward);
      width = std::max(width, 2 * std::abs(glm::dot(from_light, view.right)) / s);
      height = std::max(height, 2 * std::abs(glm::dot(from_light, view.up)) / s);
    }
    set_pixels(width, height, kLeastSize, seen[side].size(), view);
    look(view, points, seen[side], lit, stop);
  }
}

/// Answers for points that face the view's eye, and that lie within its picture.
void LightTracer::look(const View& view, const SurfacePoints& points,
                       std::span<const uint32_t> facing, std::span<uint8_t> lit,
                       const std::stop_token& stop) const {
  const FrameRays frame = frame_rays(view, solid_.bounds());
  TraceParameters parameters;
  parameters.thickness_tolerance = thickness_tolerance(solid_.bounds());
  parameters.stop = stop;
  TileTracer tracer(solid_, frame, parameters, TileRules{.centers_only = false}, memory_->tiles);
  Rays rays(frame, points, facing, own_face(solid_.bounds()), lit);
  tracer.visit({0, 0, view.width_px, view.height_px}, rays);
}

}  // namespace csgcore
