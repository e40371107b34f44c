// Tests drawing the surfaces of many solids in one pass: each is as it is by itself, and what
// cannot be seen of it is not traced.
#include "csgcore/surfaces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "checks.hpp"
#include "csgcore/tracer.hpp"
#include "trace_scenes.hpp"

namespace csgcore {
namespace {

constexpr uint32_t kWidth_px = 75, kHeight_px = 70;  // more than one region, and cut off squares
constexpr float kNothing = std::numeric_limits<float>::infinity();

Image picture_of(const Surface& surface, const View& view) {
  FrameSettings settings = surface.frame;
  settings.measured_channels = settings.depth_and_id_only = true;
  TraceOptions options;
  options.boundary = surface.boundary;
  Image image;
  TraceStats stats;
  if (surface.subdivision) {
    draw(*surface.subdivision, view, settings, options, image, stats);
  } else {
    draw(*surface.solid, view, settings, options, image, stats);
  }
  return image;
}

/// Keeps what each turn draws. `sees_through`: every surface shows; otherwise one that lies nearer
/// than all before it.
class Recorder final : public SurfaceSink {
 public:
  Recorder(const View& view, size_t turns, bool sees_through)
      : view_(view), sees_through_(sees_through) {
    Image none{view.width_px, view.height_px, {}, {}, {}, {}, {}, {}};
    none.rgb.resize(size_t{view.width_px} * view.height_px);
    none.z.assign(none.rgb.size(), kNothing);
    none.id.assign(none.rgb.size(), kNoPrimitive);
    pictures_.assign(turns, none);
    depth_ = none.z;
  }

  bool wants(uint32_t, const PixelArea& area, float nearest_z) const override {
    bool result = false;
    for (uint32_t y = area.y; y < area.y + area.height; ++y) {
      for (uint32_t x = area.x; x < area.x + area.width; ++x) {
        result = result || may_show(y * view_.width_px + x, nearest_z);
      }
    }
    return result;
  }
  uint32_t wanted(uint32_t, const PixelBlock& block, float nearest_z,
                  double (&furthest_z)[PixelBlock::kPixels]) const override {
    return pixels_where(block, [&](uint32_t pixel, size_t index) {
      const double rounding = 1e-6 * (std::abs(depth_[index]) + 1);
      furthest_z[pixel] = sees_through_ ? kNothing : depth_[index] + rounding;
      return may_show(index, nearest_z);
    });
  }
  uint32_t shown(uint32_t, const PixelBlock& block,
                 const float (&z)[PixelBlock::kPixels]) const override {
    return pixels_where(block,
                        [&](uint32_t pixel, size_t index) { return may_show(index, z[pixel]); });
  }
  void draw(uint32_t turn, const PixelBlock& block, const SurfacePixels& pixels) override {
    Image& picture = pictures_[turn];
    pixels_where(block, [&](uint32_t pixel, size_t index) {
      EXPECT_EQ(picture.z[index], kNothing) << "drawn twice";
      picture.rgb[index] = pixels.rgb[pixel];
      picture.z[index] = pixels.z[pixel];
      picture.id[index] = pixels.id[pixel];
      depth_[index] = std::min(depth_[index], pixels.z[pixel]);
      return true;
    });
  }

  /// Fails unless each turn has drawn what shows of its surface by itself.
  void expect_turns(std::span<const Surface> surfaces, std::span<const uint32_t> turns) const {
    std::vector<float> depth(depth_.size(), kNothing);
    for (size_t turn = 0; turn < turns.size(); ++turn) {
      SCOPED_TRACE(turn);
      const Image alone = picture_of(surfaces[turns[turn]], view_);
      for (size_t i = 0; i < depth.size(); ++i) {
        const bool shows = !std::isinf(alone.z[i]) && (sees_through_ || alone.z[i] <= depth[i]);
        ASSERT_EQ(pictures_[turn].z[i], shows ? alone.z[i] : kNothing) << i;
        ASSERT_EQ(pictures_[turn].id[i], shows ? alone.id[i] : kNoPrimitive) << i;
        if (!shows) continue;
        ASSERT_EQ(pictures_[turn].rgb[i], alone.rgb[i]) << i;
        depth[i] = std::min(depth[i], alone.z[i]);
      }
    }
  }

 private:
  bool may_show(size_t index, float z) const { return sees_through_ || !(z > depth_[index]); }

  template <typename Holds>
  uint32_t pixels_where(const PixelBlock& block, const Holds& holds) const {
    uint32_t result = 0;
    for (uint32_t pixel = 0; pixel < PixelBlock::kPixels; ++pixel) {
      if (!(block.pixels >> pixel & 1)) continue;
      const uint32_t x = block.x + pixel % PixelBlock::kWidth_px;
      const uint32_t y = block.y + pixel / PixelBlock::kWidth_px;
      EXPECT_LT(x, view_.width_px);
      EXPECT_LT(y, view_.height_px);
      EXPECT_EQ(x / kSurfaceSquare_px, block.x / kSurfaceSquare_px);
      EXPECT_EQ(y / kSurfaceSquare_px, block.y / kSurfaceSquare_px);
      if (holds(pixel, size_t{y} * view_.width_px + x)) result |= uint32_t{1} << pixel;
    }
    return result;
  }

  const View& view_;
  const bool sees_through_;
  std::vector<Image> pictures_;
  std::vector<float> depth_;
};

/// Solids, and the surfaces of them.
struct Drawing {
  std::vector<std::unique_ptr<Solid>> solids;
  std::vector<std::unique_ptr<Subdivision>> subdivisions;
  std::vector<Surface> surfaces;
  std::vector<uint32_t> turns;

  uint32_t add(const Scene& scene, Boundary boundary, bool by_cells, bool is_same_solid = false) {
    if (!is_same_solid) {
      solids.push_back(std::make_unique<Solid>(canonical_primitives(scene), scene.model));
    }
    Surface surface{solids.back().get(), nullptr, boundary, {}};
    surface.frame.front = {0.9f, 0.5f, 0.1f};
    surface.frame.back = {0.1f, 0.7f, 0.3f};
    if (by_cells) {
      subdivisions.push_back(std::make_unique<Subdivision>(*solids.back(), SubdivisionOptions{}));
      surface.subdivision = subdivisions.back().get();
    }
    surfaces.push_back(surface);
    return static_cast<uint32_t>(surfaces.size()) - 1;
  }

  TraceStats expect_drawn(const View& view, bool sees_through) const {
    Recorder recorder(view, turns.size(), sees_through);
    TraceStats stats;
    draw_surfaces(surfaces, turns, view, {}, recorder, stats);
    recorder.expect_turns(surfaces, turns);
    return stats;
  }
};

Scene ball_at(const Vec3& center, double radius) {
  return test_support::scene_of(Op::kUnion, {make_sphere(radius, checks::moved(center))});
}

class SurfacesOf : public testing::TestWithParam<bool> {};

TEST_P(SurfacesOf, ManySolidsAreThoseOfEach) {
  Drawing drawing;
  Box box;
  for (const char* const name : {"Random10", "Ball", "Flush", "Cones", "Repeated", "Random40"}) {
    const Scene scene = checks::trace_scene(name).scene;
    const uint32_t behind = drawing.add(scene, Boundary::kBehind, GetParam());
    const uint32_t first = drawing.add(scene, Boundary::kFirst, GetParam(), true);
    drawing.turns.insert(drawing.turns.end(), {behind, first});
    const uint32_t several = drawing.add(scene, Boundary::kFirst, GetParam());
    const uint32_t far_side = drawing.add(scene, Boundary::kBehind, GetParam());
    drawing.turns.insert(drawing.turns.end(), {several, far_side, several});
    box.merge(drawing.solids.back()->bounds());
  }
  for (const auto& [name, view] : checks::trace_views(box, kWidth_px, kHeight_px)) {
    SCOPED_TRACE(name);
    drawing.expect_drawn(view, true);
  }
}

TEST_P(SurfacesOf, HiddenSolidsAreLeftOut) {
  std::mt19937 random(1);
  Drawing drawing;
  Box box;
  for (int i = 0; i < 150; ++i) {
    const Vec3 center{checks::uniform(random, -4, 4), checks::uniform(random, -4, 4),
                      checks::uniform(random, -4, 4)};
    const Scene scene = ball_at(center, checks::uniform(random, 1, 2));
    const uint32_t behind = drawing.add(scene, Boundary::kBehind, GetParam());
    const uint32_t first = drawing.add(scene, Boundary::kFirst, GetParam(), true);
    drawing.turns.insert(drawing.turns.end(), {behind, first});
    if (i % 7 == 0) drawing.turns.push_back(drawing.turns[1]);
    box.merge(drawing.solids.back()->bounds());
  }
  uint64_t all = 0, seen = 0;  // rays
  for (const auto& [name, view] : checks::trace_views(box, kWidth_px, kHeight_px)) {
    SCOPED_TRACE(name);
    all += drawing.expect_drawn(view, true).rays;
    seen += drawing.expect_drawn(view, false).rays;
  }
  EXPECT_LT(2 * seen, all);
}

INSTANTIATE_TEST_SUITE_P(Tracer, SurfacesOf, testing::Bool(), [](const auto& by_cells) {
  return std::string(by_cells.param ? "Cells" : "Tiles");
});

TEST(Surfaces, BehindAnotherCostNoRays) {
  const View view = checks::view_of({Vec3(-10.0), Vec3(10.0)}, {0, 0, -1}, 3);
  Drawing drawing;
  drawing.turns = {drawing.add(ball_at({0, 0, 8}, 6), Boundary::kFirst, false)};
  const uint64_t of_one = drawing.expect_drawn(view, false).rays;
  ASSERT_GT(of_one, 0u);
  for (int i = 0; i < 50; ++i) {
    drawing.turns.push_back(drawing.add(ball_at({0, 0, -5}, 1), Boundary::kFirst, false));
  }
  EXPECT_EQ(drawing.expect_drawn(view, false).rays, of_one);
}

TEST(Surfaces, OfSeveralTurnsAreTracedOnce) {
  const View view = checks::view_of({Vec3(-10.0), Vec3(10.0)}, {0, 0, -1}, 3);
  Drawing drawing;
  drawing.turns = {drawing.add(ball_at({0, 0, 0}, 6), Boundary::kBehind, false)};
  drawing.turns.resize(2, 0);
  const uint64_t of_two = drawing.expect_drawn(view, true).rays;
  drawing.turns.resize(10, 0);
  EXPECT_EQ(drawing.expect_drawn(view, true).rays, of_two);
}

TEST(Surfaces, OfNothingAndBesideThePictureAreNotDrawn) {
  const View view = checks::view_of({Vec3(-1.0), Vec3(1.0)}, {0, 0, -1}, 3);
  Drawing drawing;
  drawing.turns = {drawing.add(Scene{}, Boundary::kFirst, false),
                   drawing.add(ball_at({1000, 0, 0}, 1), Boundary::kFirst, false)};
  EXPECT_EQ(drawing.expect_drawn(view, true).rays, 0u);
}

}  // namespace
}  // namespace csgcore
