#include "embree_frame.hpp"

#include <embree3/rtcore.h>
#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <vector>

#include "samples.hpp"

namespace measure {
namespace {

using csgcore::View;
using Rgb = std::array<uint8_t, 3>;

/// The rays of a packet are those of a block of pixels.
constexpr uint32_t kBlockWidth = 4;
struct Packet8 {
  static constexpr uint32_t kRays = 8;
  RTCRayHit8 rays;
  void intersect(const int* valid, RTCScene scene, RTCIntersectContext& context) {
    rtcIntersect8(valid, scene, &context, &rays);
  }
};
struct Packet16 {
  static constexpr uint32_t kRays = 16;
  RTCRayHit16 rays;
  void intersect(const int* valid, RTCScene scene, RTCIntersectContext& context) {
    rtcIntersect16(valid, scene, &context, &rays);
  }
};
/// The pixels per side of a task's tile.
constexpr uint32_t kTile = 16;

struct Eye {
  glm::vec3 origin, forward, right, up;  // a pixel's ray: forward + u·right + v·up
  float u0, v0, step;
  glm::vec3 to_light;
};

Eye eye_of(const View& view) {
  const double step = 2 * view.half_height / view.height_px;
  return {view.eye,
          view.forward,
          view.right,
          view.up,
          static_cast<float>(0.5 * step * (1 - double(view.width_px))),
          static_cast<float>(0.5 * step * (double(view.height_px) - 1)),
          static_cast<float>(step),
          glm::normalize(view.up - view.right - view.forward)};
}

template <typename Packet>
void aim(const Eye& eye, uint32_t x, uint32_t y, Packet& packet) {
  auto& [ray, hit] = packet.rays;
  for (uint32_t i = 0; i < Packet::kRays; ++i) {
    const float u = eye.u0 + eye.step * float(x + i % kBlockWidth);
    const float v = eye.v0 - eye.step * float(y + i / kBlockWidth);
    ray.org_x[i] = eye.origin.x;
    ray.org_y[i] = eye.origin.y;
    ray.org_z[i] = eye.origin.z;
    ray.dir_x[i] = eye.forward.x + u * eye.right.x + v * eye.up.x;
    ray.dir_y[i] = eye.forward.y + u * eye.right.y + v * eye.up.y;
    ray.dir_z[i] = eye.forward.z + u * eye.right.z + v * eye.up.z;
    ray.tnear[i] = 0;
    ray.tfar[i] = std::numeric_limits<float>::infinity();
    ray.time[i] = 0;
    ray.mask[i] = ~0u;
    ray.id[i] = i;
    ray.flags[i] = 0;
    hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
}

/// Shades with OpenSCAD's light and colours.
Rgb shade(const glm::vec3& color, const glm::vec3& normal, const glm::vec3& to_light) {
  const float light =
      0.2f + std::abs(glm::dot(normal, to_light)) / std::sqrt(glm::dot(normal, normal));
  const glm::vec3 lit = glm::min(255.0f * light * color, 255.0f) + 0.5f;
  return {uint8_t(lit.x), uint8_t(lit.y), uint8_t(lit.z)};
}

}  // namespace

class EmbreeFrame::Impl {
 public:
  Impl(std::span<const CutTriangle> triangles, std::span<const char> is_cut, unsigned threads)
      : device_(rtcNewDevice(("threads=" + std::to_string(threads)).c_str())),
        arena_(static_cast<int>(threads)) {
    if (!device_) throw std::runtime_error("Embree does not start");
    scene_ = rtcNewScene(device_);
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* const vertices = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                3 * sizeof(float), 3 * triangles.size()));
    auto* const indices = static_cast<uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(uint32_t), triangles.size()));
    for (size_t i = 0; i < 3 * triangles.size(); ++i) {
      const glm::vec3 corner = triangles[i / 3].corners[i % 3];
      std::memcpy(vertices + 3 * i, &corner, sizeof corner);
      indices[i] = static_cast<uint32_t>(i);
    }
    for (const CutTriangle& triangle : triangles) is_cut_.push_back(is_cut[triangle.primitive]);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_HIGH);
    build_ms_ = timed([&] { rtcCommitScene(scene_); })();
    if (rtcGetDeviceError(device_) != RTC_ERROR_NONE) {
      throw std::runtime_error("Embree cannot build the mesh's tree");
    }
  }
  ~Impl() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  double build_ms() const { return build_ms_; }

  void draw(const View& view, const csgcore::FrameSettings& settings, csgcore::Image& image) {
    if (rtcGetDeviceProperty(device_, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0) {
      draw<Packet16>(view, settings, image);
    } else {
      draw<Packet8>(view, settings, image);
    }
  }

 private:
  template <typename Packet>
  void draw(const View& view, const csgcore::FrameSettings& settings, csgcore::Image& image) {
    const Eye eye = eye_of(view);
    using Range = tbb::blocked_range2d<uint32_t>;
    const uint32_t columns = view.width_px / kTile, rows = view.height_px / kTile;
    arena_.execute([&] {
      tbb::parallel_for(Range(0, rows, 0, columns), [&](const Range& range) {
        for (uint32_t row = range.rows().begin(); row < range.rows().end(); ++row) {
          for (uint32_t column = range.cols().begin(); column < range.cols().end(); ++column) {
            draw_tile<Packet>(column * kTile, row * kTile, eye, settings, image);
          }
        }
      });
    });
  }

  template <typename Packet>
  void draw_tile(uint32_t left, uint32_t top, const Eye& eye,
                 const csgcore::FrameSettings& settings, csgcore::Image& image) const {
    constexpr uint32_t kBlockHeight = Packet::kRays / kBlockWidth;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    alignas(64) int all[Packet::kRays];
    std::fill(std::begin(all), std::end(all), -1);
    const Rgb background = {uint8_t(std::lround(255 * settings.background.x)),
                            uint8_t(std::lround(255 * settings.background.y)),
                            uint8_t(std::lround(255 * settings.background.z))};
    Packet packet;
    const auto& [ray, hit] = packet.rays;
    for (uint32_t y = top; y < top + kTile; y += kBlockHeight) {
      for (uint32_t x = left; x < left + kTile; x += kBlockWidth) {
        aim(eye, x, y, packet);
        packet.intersect(all, scene_, context);
        for (uint32_t i = 0; i < Packet::kRays; ++i) {
          const size_t pixel = size_t{y + i / kBlockWidth} * image.width_px + x + i % kBlockWidth;
          if (settings.measured_channels) image.z[pixel] = ray.tfar[i];
          image.rgb[pixel] = hit.geomID[i] == RTC_INVALID_GEOMETRY_ID
                                 ? background
                                 : shade(is_cut_[hit.primID[i]] ? settings.back : settings.front,
                                         {hit.Ng_x[i], hit.Ng_y[i], hit.Ng_z[i]}, eye.to_light);
        }
      }
    }
  }

  RTCDevice device_;
  RTCScene scene_ = nullptr;
  tbb::task_arena arena_;
  std::vector<char> is_cut_;  // by triangle
  double build_ms_ = 0;
};

EmbreeFrame::EmbreeFrame(std::span<const CutTriangle> triangles, std::span<const char> is_cut,
                         unsigned threads)
    : impl_(std::make_unique<Impl>(triangles, is_cut, threads)) {}
EmbreeFrame::~EmbreeFrame() = default;

double EmbreeFrame::build_ms() const { return impl_->build_ms(); }

void EmbreeFrame::draw(const View& view, const csgcore::FrameSettings& settings,
                       csgcore::Image& image) const {
  image.width_px = view.width_px;
  image.height_px = view.height_px;
  const size_t pixels = size_t{view.width_px} * view.height_px;
  image.rgb.resize(pixels);
  image.z.resize(settings.measured_channels ? pixels : 0);
  impl_->draw(view, settings, image);
}

}  // namespace measure
