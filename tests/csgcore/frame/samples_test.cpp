// Tests antialiasing: edge pixels are the means of their samples, and all others stay as they are.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "csgcore/tracer.hpp"
#include "csgcore/view.hpp"
#include "frame/edge_samples.hpp"
#include "packets/shading.hpp"
#include "rays/frame_rays.hpp"
#include "trace_scenes.hpp"
#include "whole_list.hpp"

namespace csgcore {
namespace {

using Rgb = std::array<uint8_t, 3>;

FrameSettings settings_with(Shading shading) {
  FrameSettings settings;
  settings.shading = shading;
  settings.background = {1.0f, 0.5f, 0.0f};
  settings.front = {0.2f, 0.6f, 1.0f};
  settings.back = {0.0f, 1.0f, 0.5f};
  return settings;
}

struct Drawn {
  Image image;
  TraceStats stats;
};
Drawn draw_with(const Solid& solid, const View& view, const FrameSettings& settings,
                uint32_t samples) {
  TraceOptions options;
  options.samples = samples;
  Drawn drawn;
  draw(solid, view, settings, options, drawn.image, drawn.stats);
  return drawn;
}

/// Returns the largest difference in a channel between the pixel and those beside, above and below
/// it.
int contrast(const Image& image, uint32_t x, uint32_t y) {
  const auto at = [&](uint32_t column, uint32_t row) {
    return image.rgb[size_t{row} * image.width_px + column];
  };
  int result = 0;
  const auto look_at = [&](bool exists, uint32_t column, uint32_t row) {
    for (size_t i = 0; exists && i < 3; ++i) {
      result = std::max(result, std::abs(at(x, y)[i] - at(column, row)[i]));
    }
  };
  look_at(x > 0, x - 1, y);
  look_at(y > 0, x, y - 1);
  look_at(x + 1 < image.width_px, x + 1, y);
  look_at(y + 1 < image.height_px, x, y + 1);
  return result;
}

/// Computes a pixel by the definition of the samples, traced with the whole list.
class SampleOracle {
 public:
  SampleOracle(const Solid& solid, const View& view, const FrameSettings& settings)
      : list_(solid, view),
        shade_(shade_settings(settings, view, solid.bounds())),
        height_px_(view.height_px),
        above_(settings.background),
        below_(settings.background_below.value_or(settings.background)) {}

  Rgb mean(uint32_t x, uint32_t y, uint32_t samples) {
    const double share = (y + 0.5) / height_px_;
    for (int i = 0; i < 3; ++i) {
      background_[i] = std::round(255.0 * (above_[i] * (1 - share) + below_[i] * share));
    }
    Vec3 sum{0.0};
    for (uint32_t first = 0; first < samples; first += kPacketRays) {
      const uint32_t count = std::min(kPacketRays, samples - first);
      PacketLaterals laterals;
      for (uint32_t lane = 0; lane < kPacketRays; ++lane) {
        const auto offset = sample_offset(first + std::min(lane, count - 1), samples);
        laterals.u[lane] = list_.frame().u(x + offset[0]);
        laterals.v[lane] = list_.frame().v(y + offset[1]);
      }
      add(laterals, count, sum);
    }
    Rgb rgb;
    for (size_t i = 0; i < 3; ++i) {
      const double value = sum[static_cast<int>(i)] / samples;
      rgb[i] = static_cast<uint8_t>(std::floor(value + 0.5));
    }
    return rgb;
  }

 private:
  void add(const PacketLaterals& laterals, uint32_t count, Vec3& sum) {
    RayPacket rays;
    make_rays(list_.frame(), laterals, rays);
    const PacketHits hits = list_.trace(rays, kAllLanes >> (kPacketRays - count));
    PacketColors colors;
    shade_packet(shade_, list_.frame(), rays, list_.list(), hits, colors);
    for (uint32_t lane = 0; lane < count; ++lane) {
      const bool hit = (hits.hits >> lane & 1) != 0;
      for (int i = 0; i < 3; ++i) sum[i] += hit ? colors.rgb[i][lane] : background_[i];
    }
  }

  checks::WholeList list_;
  ShadeSettings shade_;
  double height_px_;
  Vec3 above_, below_;
  Vec3 background_;  // of the pixel's row
};

class SamplesOf : public testing::TestWithParam<const char*> {};

TEST_P(SamplesOf, EdgePixelsAreMeansAndOthersUntouched) {
  const Scene scene = checks::trace_scene(GetParam()).scene;
  const Solid solid(canonical_primitives(scene), scene.model);
  FrameSettings settings = settings_with(Shading::kOpenScad);
  if (GetParam() == std::string("Cones")) settings.background_below = {0.7f, 0.7f, 0.2f};
  for (const auto& [name, view] : checks::trace_views(solid.bounds(), 51, 38)) {
    SCOPED_TRACE(name);
    const Image plain = draw_with(solid, view, settings, 1).image;
    const EdgeMap map(plain, {0, 0, view.width_px, view.height_px});
    SampleOracle oracle(solid, view, settings);
    for (const uint32_t samples : {2u, 5u, 16u, 37u}) {
      const Drawn drawn = draw_with(solid, view, settings, samples);
      uint64_t edges = 0;
      for (uint32_t y = 0; y < view.height_px; ++y) {
        for (uint32_t x = 0; x < view.width_px; ++x) {
          const bool edge = map.is_edge(x, y);
          edges += edge;
          ASSERT_TRUE(edge || contrast(plain, x, y) < 20);
          ASSERT_TRUE(!edge || contrast(plain, x, y) > 4);
          const size_t pixel = size_t{y} * view.width_px + x;
          if (samples == 2) {
            ASSERT_EQ(plain.rgb[pixel], oracle.mean(x, y, 1)) << x << ", " << y;
          }
          ASSERT_EQ(drawn.image.rgb[pixel], edge ? oracle.mean(x, y, samples) : plain.rgb[pixel])
              << samples << " samples, pixel " << x << ", " << y;
        }
      }
      EXPECT_EQ(drawn.stats.edge_pixels, edges);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Tracer, SamplesOf, testing::Values("Flush", "Cones", "Random40"),
                         [](const auto& name) { return std::string(name.param); });

TEST(Samples, OneIsThePlainPicture) {
  const Scene scene = checks::trace_scene("Cones").scene;
  const Solid solid(canonical_primitives(scene), scene.model);
  const FrameSettings settings = settings_with(Shading::kPhong);
  const View view = checks::trace_views(solid.bounds(), 80, 60)[0].view;
  const Drawn one = draw_with(solid, view, settings, 1);
  EXPECT_EQ(one.stats.edge_pixels, 0u);
  const Drawn many = draw_with(solid, view, settings, 9);
  EXPECT_GT(many.stats.edge_pixels, 100u);
  EXPECT_FALSE(checks::same_bits(one.image, many.image));
}

/// The measured channels are those of the pixels' centres, however many samples the colours have.
TEST(Samples, LeaveTheMeasuredChannelsAlone) {
  const Scene scene = checks::trace_scene("Cones").scene;
  const Solid solid(canonical_primitives(scene), scene.model);
  FrameSettings settings = settings_with(Shading::kOpenScad);
  settings.measured_channels = true;
  const View view = checks::trace_views(solid.bounds(), 80, 60)[0].view;
  Image one = draw_with(solid, view, settings, 1).image;
  const Image many = draw_with(solid, view, settings, 9).image;
  EXPECT_NE(one.rgb, many.rgb);
  one.rgb = many.rgb;
  EXPECT_TRUE(checks::same_bits(one, many));
}

/// Looks from above at a black disc so large that its edge is straight. The pixels at its edge have
/// as much of the white background as the disc leaves uncovered.
TEST(Samples, AreAsGrayAsTheEdgeCovers) {
  constexpr double kRadius = 1e6;
  constexpr uint32_t kSamples = 16;
  for (const double covered : {0.0, 0.1, 0.3, 0.5, 0.77, 0.9}) {
    // The disc's edge is at x = covered − ½ from the centre of the pixel in the middle column.
    Scene scene;
    CsgTreeBuilder builder;
    builder.primitive(0);
    scene.primitives = {
        make_frustum(0, 1, kRadius, kRadius, checks::moved({covered - 0.5 - kRadius, 0, 0}))};
    scene.model = builder.finish();
    const Solid solid(canonical_primitives(scene), scene.model);
    View view;
    view.projection = Projection::kOrthographic;
    view.eye = {0, 0, 10};
    view.width_px = view.height_px = 9;
    view.half_height = 4.5;
    FrameSettings settings;
    settings.front = {0.0f, 0.0f, 0.0f};
    const Image image = draw_with(solid, view, settings, kSamples).image;
    for (uint32_t y = 0; y < 9; ++y) {
      EXPECT_EQ(image.rgb[y * 9 + 3][0], 0);
      EXPECT_NEAR(image.rgb[y * 9 + 4][0], 255 * (1 - covered), 255.0 / kSamples);
      EXPECT_EQ(image.rgb[y * 9 + 5][0], 255);
    }
  }
}

}  // namespace
}  // namespace csgcore
