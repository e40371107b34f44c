// Tests that a picture whose changed areas alone are drawn anew equals the whole picture.
#include <gtest/gtest.h>

#include <algorithm>

#include "checks.hpp"
#include "csgcore/changed_areas.hpp"
#include "csgcore/tracer.hpp"
#include "edited_scenes.hpp"
#include "made.hpp"
#include "simd_levels.hpp"
#include "support/full_run.hpp"
#include "trace_scenes.hpp"
#include "whole_list.hpp"

namespace csgcore {
namespace {

using checks::Made;

/// One of many ways to draw a picture, chosen by the seed.
struct Way {
  FrameSettings settings;
  TraceOptions options;

  explicit Way(uint32_t seed) {
    settings.background = {0.1f, 0.2f, 0.3f};
    settings.front = {0.9f, 0.8f, 0.1f};
    settings.back = {0.2f, 0.9f, 0.3f};
    settings.shading = seed % 3 == 0 ? Shading::kPhong : Shading::kOpenScad;
    settings.measured_channels = seed % 2 == 0;
    options.samples = seed % 5 < 2 ? 5 : 1;
    options.threads = seed % 4;
    if (seed % 7 == 0) options.boundary = Boundary::kBehind;
  }

  Image draw(const Solid& solid, const View& view) const {
    Image image;
    TraceStats stats;
    csgcore::draw(solid, view, settings, options, image, stats);
    return image;
  }

  void redraw(const Solid& solid, const View& view, const PixelArea& area, Image& image) const {
    TraceOptions partly = options;
    partly.area = area;
    TraceStats stats;
    csgcore::draw(solid, view, settings, partly, image, stats);
  }
};

struct Redrawn {
  uint64_t pictures = 0, partly = 0;  // pictures of which fewer than all pixels were traced
  uint64_t pixels = 0, traced = 0;
};

/// Fails unless the picture of `before`, with its changed areas drawn anew, equals that of the
/// later scene.
void expect_same_picture(const Made& before, const Made& after, const SceneEdit& edit,
                         const View& view, uint32_t seed, Redrawn& redrawn) {
  const Way way(seed);
  const Image expected = way.draw(after.solid, view);
  Image image = way.draw(before.solid, view);
  const std::vector<PixelArea> areas =
      changed_areas(before.solid, after.solid, edit, edit.model, view, way.settings);
  for (const PixelArea& area : areas) way.redraw(after.solid, view, area, image);
  ASSERT_TRUE(checks::same_bits(image, expected));
  const uint64_t pixels = uint64_t{view.width_px} * view.height_px;
  ++redrawn.pictures;
  redrawn.partly += count_pixels(areas) < pixels;
  redrawn.pixels += pixels;
  redrawn.traced += count_pixels(areas);
}

void expect_same_pictures(const Made& before, const Made& after, const SceneEdit& edit,
                          uint32_t& seed, Redrawn& redrawn) {
  for (const auto& [name, view] : checks::trace_views(after.solid.bounds(), 61, 45)) {
    SCOPED_TRACE(name);
    ASSERT_NO_FATAL_FAILURE(expect_same_picture(before, after, edit, view, ++seed, redrawn));
  }
}

TEST(EditedPictures, RandomEditsDrawWhatIsMadeAnew) {
  const uint32_t rounds = test_support::full_run() ? 300 : 10;
  std::printf("%s run: %u designs\n", test_support::full_run() ? "full" : "sample", rounds);
  std::mt19937 random(1);
  uint32_t seed = 0;
  Redrawn redrawn;
  for (uint32_t round = 0; round < rounds; ++round) {
    SCOPED_TRACE("design " + std::to_string(round));
    const uint32_t primitives = round % 3 == 0 ? 300 : 10 + round % 30;
    checks::Design design(checks::framed_tree(primitives, round));
    auto before = std::make_unique<Made>(design.scene());
    for (int save = 0; save < 12; ++save) {
      SCOPED_TRACE("save " + std::to_string(save));
      for (uint32_t i = 0; i < 1 + random() % 3; ++i) design.edit(random);
      Scene scene = design.scene();
      const SceneEdit edit = compare(before->scene, scene);
      auto after = std::make_unique<Made>(std::move(scene));
      ASSERT_NO_FATAL_FAILURE(expect_same_pictures(*before, *after, edit, seed, redrawn));
      before = std::move(after);
    }
  }
  EXPECT_GT(redrawn.partly, redrawn.pictures / 4);
  EXPECT_LT(redrawn.traced, 3 * redrawn.pixels / 4);
}

TEST(EditedPictures, AreTheSameByEveryInstructionSet) {
  std::mt19937 random(2);
  for (uint32_t round = 0; round < 6; ++round) {
    checks::Design design(checks::framed_tree(40, round));
    const Made before(design.scene());
    design.move(random);
    Scene scene = design.scene();
    const SceneEdit edit = compare(before.scene, scene);
    const Made after(std::move(scene));
    uint32_t seed = round;
    Redrawn redrawn;
    checks::for_each_simd_level([&](SimdLevel level) {
      SCOPED_TRACE(checks::name_of(level));
      expect_same_pictures(before, after, edit, seed, redrawn);
    });
  }
}

}  // namespace
}  // namespace csgcore
