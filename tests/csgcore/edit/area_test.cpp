// Tests a part of a picture that is traced anew: the rest stays as it is, and no seam shows.
#include <gtest/gtest.h>

#include <array>

#include "checks.hpp"
#include "csgcore/tracer.hpp"
#include "trace_scenes.hpp"
#include "whole_list.hpp"

namespace csgcore {
namespace {

using checks::same_bits;

constexpr std::array<uint8_t, 3> kPaint{1, 2, 3};

PixelArea random_area(std::mt19937& random, const View& view) {
  PixelArea area;
  area.x = static_cast<uint32_t>(random() % view.width_px);
  area.y = static_cast<uint32_t>(random() % view.height_px);
  area.width = static_cast<uint32_t>(random() % (view.width_px - area.x + 1));
  area.height = static_cast<uint32_t>(random() % (view.height_px - area.y + 1));
  return area;
}

/// Returns the indices in the picture of the area's pixels.
std::vector<size_t> pixels_of(const PixelArea& area, const View& view) {
  std::vector<size_t> pixels;
  for (uint32_t y = area.y; y < area.y + area.height; ++y) {
    for (uint32_t x = area.x; x < area.x + area.width; ++x) {
      pixels.push_back(size_t{y} * view.width_px + x);
    }
  }
  return pixels;
}

/// Gives a pixel values that no picture has.
void paint(Image& image, size_t pixel) {
  image.rgb[pixel] = kPaint;
  image.z[pixel] = -1;
  image.normal[pixel] = image.position[pixel] = glm::vec3{-1.0f};
  image.id[pixel] = 7777;
}

void paint(Hits& hits, size_t pixel) {
  hits.s[pixel] = -1;
  hits.position[pixel] = hits.normal[pixel] = Vec3{-1.0};
  hits.primitive[pixel] = 7777;
}

struct Method {
  const Solid& solid;
  const Subdivision* subdivision;

  void draw(const View& view, const TraceOptions& options, Image& image) const {
    FrameSettings settings;
    settings.measured_channels = true;
    settings.background = {0.1f, 0.2f, 0.3f};
    settings.front = {0.9f, 0.8f, 0.1f};
    settings.back = {0.2f, 0.9f, 0.3f};
    TraceStats stats;
    if (subdivision) {
      csgcore::draw(*subdivision, view, settings, options, image, stats);
    } else {
      csgcore::draw(solid, view, settings, options, image, stats);
    }
  }

  void trace(const View& view, const TraceOptions& options, Hits& hits) const {
    TraceStats stats;
    if (subdivision) {
      csgcore::trace(*subdivision, view, options, hits, stats);
    } else {
      csgcore::trace(solid, view, options, hits, stats);
    }
  }
};

class AreaOf : public testing::TestWithParam<const char*> {
 protected:
  AreaOf()
      : scene_(checks::trace_scene(GetParam()).scene),
        solid_(canonical_primitives(scene_), scene_.model),
        subdivision_(solid_, {}) {}

  const Scene scene_;
  const Solid solid_;
  const Subdivision subdivision_;
};

TEST_P(AreaOf, PictureIsTracedAndNoMore) {
  std::mt19937 random(1);
  for (const auto& [name, view] : checks::trace_views(solid_.bounds(), 61, 45)) {
    SCOPED_TRACE(name);
    for (const Method& method : {Method{solid_, nullptr}, Method{solid_, &subdivision_}}) {
      TraceOptions options;
      Image whole;
      Hits whole_hits;
      method.draw(view, options, whole);
      method.trace(view, options, whole_hits);
      for (int round = 0; round < 20; ++round) {
        options.area = random_area(random, view);
        options.threads = 1 + round % 2;
        // Only the area is drawn; the paint around it stays.
        Image image = whole, expected = whole;
        Hits hits = whole_hits, expected_hits = whole_hits;
        for (size_t pixel = 0; pixel < whole.rgb.size(); ++pixel) {
          paint(image, pixel), paint(expected, pixel);
          paint(hits, pixel), paint(expected_hits, pixel);
        }
        for (const size_t pixel : pixels_of(*options.area, view)) {
          expected.rgb[pixel] = whole.rgb[pixel];
          expected.z[pixel] = whole.z[pixel];
          expected.normal[pixel] = whole.normal[pixel];
          expected.position[pixel] = whole.position[pixel];
          expected.id[pixel] = whole.id[pixel];
          expected_hits.s[pixel] = whole_hits.s[pixel];
          expected_hits.position[pixel] = whole_hits.position[pixel];
          expected_hits.normal[pixel] = whole_hits.normal[pixel];
          expected_hits.primitive[pixel] = whole_hits.primitive[pixel];
        }
        method.draw(view, options, image);
        method.trace(view, options, hits);
        ASSERT_TRUE(same_bits(image, expected));
        ASSERT_TRUE(same_bits(hits, expected_hits));
      }
    }
  }
}

/// The edges of the pixels beside the area are found in the colours from before they were averaged.
TEST_P(AreaOf, AntialiasedPictureHasNoSeam) {
  std::mt19937 random(2);
  for (const auto& [name, view] : checks::trace_views(solid_.bounds(), 61, 45)) {
    SCOPED_TRACE(name);
    for (const Method& method : {Method{solid_, nullptr}, Method{solid_, &subdivision_}}) {
      TraceOptions options;
      options.samples = 5;
      Image whole;
      method.draw(view, options, whole);
      for (int round = 0; round < 20; ++round) {
        options.area = random_area(random, view);
        Image image = whole;
        for (const size_t pixel : pixels_of(*options.area, view)) paint(image, pixel);
        method.draw(view, options, image);
        ASSERT_TRUE(same_bits(image, whole));
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Tracer, AreaOf,
                         testing::Values("Empty", "Flush", "Cones", "Crowd", "Random40"),
                         [](const auto& name) { return std::string(name.param); });

/// A ball shrinks, and beside it is a wire between the pixels' centres. The wire is seen where its
/// pixels are at an edge, which they are only next to the larger ball.
TEST(Area, PixelsBesideItAreEdgesOrNot) {
  const auto solid_with = [](double radius) {
    const Affine upright{Mat3{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}, {-1.36, 0, 0}};
    const Scene scene =
        checks::scene_of(Op::kUnion, {make_sphere(2, checks::moved({-3, -3, 0})),
                                      make_frustum(-1, 1, 0.02, 0.02, upright), make_sphere(radius),
                                      make_sphere(2, checks::moved({3, 3, 0}))});
    return Solid(canonical_primitives(scene), scene.model);
  };
  View view;
  view.projection = Projection::kOrthographic;
  view.eye = {0, 0, 10};
  view.half_height = 6;
  view.width_px = view.height_px = 60;
  const Solid before = solid_with(1.2), after = solid_with(0.9);
  ASSERT_EQ(before.bounds().min, after.bounds().min);
  ASSERT_EQ(before.bounds().max, after.bounds().max);
  TraceOptions options;
  options.samples = 7;
  Image image, expected;
  Method{before, nullptr}.draw(view, options, image);
  Method{after, nullptr}.draw(view, options, expected);
  // The larger ball, of 6 pixels in radius, and not one pixel more.
  options.area = PixelArea{24, 24, 12, 12};
  Method{after, nullptr}.draw(view, options, image);
  EXPECT_TRUE(same_bits(image, expected));
}

}  // namespace
}  // namespace csgcore
