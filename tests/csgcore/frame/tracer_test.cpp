// Tests that the tracer's pictures depend on the solid and the view alone.
#include "csgcore/tracer.hpp"

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "checks.hpp"
#include "csgcore/csg_tree.hpp"
#include "csgcore/facets.hpp"
#include "csgcore/triangle_mesh.hpp"
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

/// Draws a box from −1 to 1 from above or below; all but the sides' faces have that colour above.
std::array<uint8_t, 3> seen_of_box(const std::optional<Color>& own, bool from_below,
                                   bool is_subtracted = false) {
  const Mesh faces = box_mesh({Vec3(-1.0), Vec3(1.0)});
  std::vector<TriangleMesh::Triangle> triangles;
  std::vector<std::optional<Color>> colors;
  for (const std::vector<uint32_t>& face : faces.faces) {
    bool is_top = true;
    for (const uint32_t vertex : face) is_top = is_top && faces.vertices[vertex].z > 0;
    for (size_t i = 2; i < face.size(); ++i) {
      triangles.push_back({face[0], face[i - 1], face[i]});
      colors.push_back(is_top ? std::optional(Color{1, 0, 0.5f, 1}) : std::nullopt);
    }
  }
  Scene scene;
  Primitive box = make_mesh(std::make_shared<const TriangleMesh>(faces.vertices, triangles, colors),
                            {Mat3(2.0), {5, 6, 7}});
  box.color = own;
  CsgTreeBuilder builder;
  if (is_subtracted) {
    scene.primitives.push_back(make_sphere(30, {Mat3(1.0), {5, 6, 7}}));
    builder.open(Op::kDifference);
    builder.primitive(0);
  }
  scene.primitives.push_back(box);
  builder.primitive(is_subtracted ? 1 : 0);
  if (is_subtracted) builder.close();
  scene.model = builder.finish();
  View view;
  view.projection = is_subtracted ? Projection::kPerspective : Projection::kOrthographic;
  // Within the hole the far side is seen, whose face is that above if the eye looks up.
  view.eye = {5.2, 6.3, is_subtracted ? 7 : from_below ? -20 : 20};
  view.forward = {0, 0, from_below ? 1 : -1};
  view.right = {from_below ? -1.0 : 1.0, 0, 0};
  view.width_px = view.height_px = 1;
  view.half_height = 0.1;
  FrameSettings settings;
  settings.front = {0, 0, 1};
  settings.back = {0, 1, 0};
  Image image;
  TraceStats stats;
  draw(Solid(canonical_primitives(scene), scene.model), view, settings, {}, image, stats);
  return image.rgb.at(0);
}

TEST(FaceColors, ShowWhereThePrimitiveHasNone) {
  const auto [r, g, b] = seen_of_box({}, false);
  EXPECT_GT(r, 100);
  EXPECT_EQ(g, 0);
  EXPECT_NEAR(b, r / 2.0, 1);
  const auto bottom = seen_of_box({}, true);
  EXPECT_EQ(bottom[0], 0);
  EXPECT_GT(bottom[2], 100) << "the scheme's front colour";
  const auto own = seen_of_box(Color{0, 0.5f, 0, 1}, false);
  EXPECT_EQ(own[0], 0);
  EXPECT_GT(own[1], 50) << "the primitive's own";
  EXPECT_EQ(seen_of_box(Color{-1, -1, -1, 1}, false)[0], 0) << "the scheme's";
}

TEST(FaceColors, ShowOnCutFaces) {
  const auto colored = seen_of_box({}, true, true);
  EXPECT_GT(colored[0], 100);
  EXPECT_EQ(colored[1], 0);
  const auto other = seen_of_box({}, false, true);
  EXPECT_EQ(other[0], 0);
  EXPECT_GT(other[1], 100) << "the scheme's back colour";
}

}  // namespace
}  // namespace csgcore
