// Tests that the tracer's pictures depend on the solid and the view alone.
#include "csgcore/tracer.hpp"

#include <gtest/gtest.h>

#include "checks.hpp"
#include "simd_levels.hpp"
#include "trace_scenes.hpp"
#include "whole_list.hpp"

namespace csgcore {
namespace {

using checks::NamedScene;
using checks::NamedView;
using checks::same_bits;

SubdivisionOptions with_leaves(uint32_t primitives) {
  SubdivisionOptions options;
  options.leaf_primitives = primitives;
  return options;
}

/// The paper's rule, with no cell dropped.
SubdivisionOptions paper_without_threshold() {
  SubdivisionOptions options = SubdivisionOptions::paper(1, View{});
  options.threshold_px = 0;
  options.view.reset();
  return options;
}

class PicturesOf : public testing::TestWithParam<std::string> {
 protected:
  PicturesOf()
      : scene_(checks::trace_scene(GetParam()).scene),
        solid_(canonical_primitives(scene_), scene_.model) {}

  std::vector<NamedView> views(uint32_t width_px, uint32_t height_px) const {
    return checks::trace_views(solid_.bounds(), width_px, height_px);
  }

  const Scene scene_;
  const Solid solid_;
};

TEST_P(PicturesOf, TilesAndCellsShowWhatTheWholeListShows) {
  const SubdivisionOptions subdivisions[] = {with_leaves(1), with_leaves(2), with_leaves(8),
                                             with_leaves(64), paper_without_threshold()};
  uint64_t hits = 0;
  for (const NamedView& view : views(61, 45)) {
    SCOPED_TRACE(view.name);
    const Hits expected = checks::WholeList(solid_, view.view).picture();
    hits += checks::count_hits(expected);
    EXPECT_TRUE(same_bits(checks::trace_by_tiles(solid_, view.view), expected));
    for (const SubdivisionOptions& options : subdivisions) {
      const Subdivision subdivision(solid_, options);
      EXPECT_TRUE(same_bits(checks::trace_by_cells(subdivision, view.view), expected))
          << "leaves of " << options.leaf_primitives;
    }
  }
  const bool is_empty = GetParam() == "Empty" || GetParam() == "NothingLeft";
  EXPECT_EQ(hits == 0, is_empty);
}

TEST_P(PicturesOf, BoundariesBehindAreTheWholeListsToo) {
  TraceOptions options;
  options.boundary = Boundary::kBehind;
  for (const NamedView& view : views(37, 29)) {
    SCOPED_TRACE(view.name);
    const Hits expected = checks::WholeList(solid_, view.view, Boundary::kBehind).picture();
    EXPECT_TRUE(same_bits(checks::trace_by_tiles(solid_, view.view, options), expected));
    const Subdivision subdivision(solid_, with_leaves(8));
    EXPECT_TRUE(same_bits(checks::trace_by_cells(subdivision, view.view, options), expected));
  }
}

TEST_P(PicturesOf, OddSizesAreTheSame) {
  const uint32_t sizes[][2] = {{1, 1}, {3, 5}, {4, 4}, {641, 7}, {7, 129}};
  for (const auto& [width, height] : sizes) {
    SCOPED_TRACE(std::to_string(width) + " × " + std::to_string(height));
    for (const NamedView& view : views(width, height)) {
      SCOPED_TRACE(view.name);
      const Hits expected = checks::WholeList(solid_, view.view).picture();
      EXPECT_TRUE(same_bits(checks::trace_by_tiles(solid_, view.view), expected));
      const Subdivision subdivision(solid_, with_leaves(8));
      EXPECT_TRUE(same_bits(checks::trace_by_cells(subdivision, view.view), expected));
    }
  }
}

/// Draws pictures with all channels, antialiased, with both kinds of shading.
std::vector<Image> draw_all(const Solid& solid, const Subdivision& subdivision, const View& view,
                            const TraceOptions& options) {
  std::vector<Image> images;
  for (const Shading shading : {Shading::kOpenScad, Shading::kPhong}) {
    FrameSettings settings;
    settings.shading = shading;
    settings.measured_channels = true;
    settings.background = {0.1f, 0.2f, 0.3f};
    settings.front = {0.9f, 0.8f, 0.1f};
    settings.back = {0.2f, 0.9f, 0.3f};
    TraceStats stats;
    images.resize(images.size() + 2);
    draw(solid, view, settings, options, images.end()[-2], stats);
    draw(subdivision, view, settings, options, images.back(), stats);
  }
  return images;
}

TEST_P(PicturesOf, ThreadsAndInstructionSetsDoNotMatter) {
  const Subdivision subdivision(solid_, with_leaves(8));
  TraceOptions options;
  options.samples = 5;
  for (const NamedView& view : views(100, 66)) {
    if (view.name == "CloseUp" || view.name == "FromFarAway" || view.name == "Sideways") continue;
    SCOPED_TRACE(view.name);
    options.threads = 1;
    const std::vector<Image> expected = draw_all(solid_, subdivision, view.view, options);
    const auto expect_same = [&](const char* what) {
      const std::vector<Image> images = draw_all(solid_, subdivision, view.view, options);
      for (size_t i = 0; i < images.size(); ++i) {
        EXPECT_TRUE(same_bits(images[i], expected[i])) << what << ", picture " << i;
        EXPECT_TRUE(same_bits(images[i], images[i / 2 * 2])) << what << ", cells, not tiles";
      }
    };
    for (const unsigned threads : {2u, 4u, 0u}) {
      options.threads = threads;
      expect_same("threads");
    }
    options.threads = 1;
    checks::for_each_simd_level([&](SimdLevel level) { expect_same(checks::name_of(level)); });
  }
}

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const NamedScene& scene : checks::trace_scenes()) names.push_back(scene.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Tracer, PicturesOf, testing::ValuesIn(scene_names()),
                         [](const auto& name) { return name.param; });

}  // namespace
}  // namespace csgcore
