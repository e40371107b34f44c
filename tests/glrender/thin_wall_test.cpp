// Tests walls about as thick as OpenGL's tolerance. Each is drawn whole or not at all, although
// floats tell its thickness no better than to a third of the tolerance.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "csgcore/polyhedron.hpp"
#include "csgcore/tracer.hpp"
#include "fixture.hpp"
#include "support/full_run.hpp"
#include "support/models.hpp"

namespace {

using csgcore::Affine;
using csgcore::Box;
using csgcore::Image;
using csgcore::make_frustum;
using csgcore::make_polyhedron;
using csgcore::make_sphere;
using csgcore::Mat3;
using csgcore::Op;
using csgcore::Polyhedron;
using csgcore::Primitive;
using csgcore::Projection;
using csgcore::Scene;
using csgcore::Vec3;
using csgcore::View;
using gl_test::LoadedScene;
using gl_test::Way;
using test_support::scene_of;

/// A share of the largest side, as in renderer.cpp.
constexpr double kThicknessTolerance = 0x1p-21;
/// Doubtful pixels that are left as they are in a picture, and some at a silhouette.
constexpr uint64_t kFewPixels = 16;
constexpr double kEdges = 0.003;

/// A design that is all wall, `thickness` of its largest side, which is 10.
struct Wall {
  const char* name;
  Scene (*make)(double thickness);
};

void PrintTo(const Wall& wall, std::ostream* out) { *out << wall.name; }

Primitive box(const Vec3& min, const Vec3& max) {
  return make_polyhedron(Polyhedron::box({min, max}));
}

/// A pin beside which the walls are in a list of several primitives.
Primitive pin() { return make_frustum(0, 1, 0.1, 0.1); }

const Wall kWalls[] = {
    {"Plate", [](double w) { return scene_of(Op::kUnion, {make_frustum(0, 10 * w, 5, 5)}); }},
    {"Slab",
     [](double w) {
       return scene_of(Op::kUnion, {box({-5, -5, 0}, {5, 5, 10 * w})});
     }},
    {"PlateAndPin",
     [](double w) {
       return scene_of(Op::kUnion, {make_frustum(0, 10 * w, 5, 5), pin()});
     }},
    {"Shell",
     [](double w) {
       return scene_of(Op::kDifference, {make_sphere(5), make_sphere(5 - 10 * w)});
     }},
    {"Tube",
     [](double w) {
       return scene_of(Op::kDifference,
                       {make_frustum(0, 10, 5, 5), make_frustum(-1, 11, 5 - 10 * w, 5 - 10 * w)});
     }},
    {"Lid",
     [](double w) {
       return scene_of(Op::kDifference,
                       {box({-5, -5, -5}, {5, 5, 5}), box({-6, -6, -6}, {6, 6, 5 - 10 * w})});
     }},
    {"Common",
     [](double w) {
       return scene_of(Op::kIntersection,
                       {make_frustum(-9, 10 * w, 5, 5), make_frustum(0, 9, 5, 5)});
     }},
    {"OfThree",
     [](double w) {
       return scene_of(Op::kDifference,
                       {make_frustum(0, 5, 5, 5), make_frustum(-1, 5 - 10 * w, 6, 6),
                        make_frustum(-1, 6, 1, 1)});
     }},
};

Affine turned() {
  const double tilt = 0.3, turn = 1.7;
  const Mat3 tilted{Vec3{1, 0, 0}, Vec3{0, std::cos(tilt), std::sin(tilt)},
                    Vec3{0, -std::sin(tilt), std::cos(tilt)}};
  const Mat3 turned{Vec3{std::cos(turn), std::sin(turn), 0},
                    Vec3{-std::sin(turn), std::cos(turn), 0}, Vec3{0, 0, 1}};
  return {turned * tilted, {3.1, -2.7, 11.3}};
}

Scene under(Scene scene, const Affine& frame) {
  for (Primitive& primitive : scene.primitives) {
    primitive.local_to_world = csgcore::compose(frame, primitive.local_to_world);
  }
  return scene;
}

View under(View view, const Affine& frame) {
  view.eye = frame.point(view.eye);
  for (Vec3* axis : {&view.forward, &view.right, &view.up}) *axis = frame.linear * *axis;
  return view;
}

View small_view(Projection projection, double above_deg) {
  View view = gl_test::view_from(Box{{-5, -5, 0}, {5, 5, 5}}, projection, 25, above_deg);
  view.width_px = 120;
  view.height_px = 90;
  return view;
}

/// Returns GL's own tolerance for a solid.
double tolerance_of(const csgcore::Solid& solid) {
  const Vec3 size = solid.bounds().size();
  return kThicknessTolerance * std::max({size.x, size.y, size.z});
}

uint64_t hits(const Image& image) {
  return static_cast<uint64_t>(
      std::count_if(image.z.begin(), image.z.end(), [](float z) { return std::isfinite(z); }));
}

class ThinWallTest : public testing::TestWithParam<std::tuple<Wall, Way>> {};

INSTANTIATE_TEST_SUITE_P(
    , ThinWallTest,
    testing::Combine(testing::ValuesIn(kWalls),
                     testing::Values(Way(gl_test::leaves_of(8)), gl_test::by_tiles())),
    [](const auto& instance) {
      const bool tiles = std::get<1>(instance.param).technique == glrender::Technique::kTiles;
      return std::string(std::get<0>(instance.param).name) + (tiles ? "Tiles" : "Cells");
    });

TEST_P(ThinWallTest, IsDrawnWholeOrNotAtAll) {
  const auto& [wall, way] = GetParam();
  const std::vector<double> above_deg = test_support::full_run()
                                            ? std::vector<double>{80, 60, 40, 20, 10}
                                            : std::vector<double>{60, 30};
  for (const Affine& frame : {Affine{}, turned()}) {
    // The tolerance depends on the box along the axes.
    const csgcore::Solid solid(csgcore::canonical_primitives(under(wall.make(1e-3), frame)),
                               wall.make(1e-3).model);
    const double tolerance = tolerance_of(solid) / 10;
    std::vector<double> thicknesses{1e-8, 1e-7, 2e-7, 3.5e-7, 0.98 * tolerance, 1.02 * tolerance,
                                    6e-7, 8e-7, 1e-6, 1e-5};
    if (test_support::full_run()) {
      for (double w = 1e-8; w < 1e-5; w *= 1.07) thicknesses.push_back(w);
    }
    for (const double above : above_deg) {
      const Projection projection =
          above > 50 ? Projection::kPerspective : Projection::kOrthographic;
      const View view = under(small_view(projection, above), frame);
      const uint64_t all = hits(gl_test::draw(under(wall.make(3e-3), frame), view, way));
      const uint64_t none =
          hits(gl_test::draw(under(scene_of(Op::kUnion, {pin()}), frame), view, way));
      EXPECT_GT(all, 300u);
      for (const double w : thicknesses) {
        SCOPED_TRACE(std::to_string(1e9 * w) + "e-9, " + std::to_string(above) + " degrees");
        const uint64_t drawn = hits(gl_test::draw(under(wall.make(w), frame), view, way));
        if (w > tolerance) {
          EXPECT_GE(drawn + kFewPixels, uint64_t((1 - kEdges) * double(all)));
        } else {
          EXPECT_LE(drawn, none + kFewPixels);
          if (wall.name == std::string("PlateAndPin")) {
            EXPECT_EQ(drawn, none);
          }
        }
      }
    }
  }
}

/// Every channel, in front and behind, with one ray a pixel and with several, equals what the CPU
/// draws with the same tolerance.
TEST(ThinWallChannelsTest, AreTheCpus) {
  for (const double share : {0.97, 1.03}) {
    for (const Way& way : {Way(gl_test::leaves_of(8)), gl_test::by_tiles()}) {
      SCOPED_TRACE(gl_test::name_of(way) + (share > 1 ? ", whole" : ", gone"));
      const double wall = share * kThicknessTolerance;
      LoadedScene loaded(scene_of(Op::kDifference, {make_sphere(5), make_sphere(5 - 10 * wall),
                                                    make_frustum(0, 9, 1, 1)}),
                         way);
      for (const uint32_t samples : {1u, 4u}) {
        loaded.settings.samples = samples;
        const View view = small_view(Projection::kPerspective, 60);
        csgcore::TraceOptions options;
        options.samples = samples;
        options.thickness_tolerance = tolerance_of(loaded.solid);
        for (const auto boundary : {csgcore::Boundary::kFirst, csgcore::Boundary::kBehind}) {
          const Image gl = boundary == csgcore::Boundary::kFirst
                               ? loaded.draw(view)
                               : loaded.renderer.draw_behind(view, loaded.settings, loaded.stats);
          options.boundary = boundary;
          Image cpu;
          csgcore::TraceStats stats;
          csgcore::draw(loaded.solid, view, loaded.settings, options, cpu, stats);
          uint64_t other = 0, other_color = 0;
          for (size_t i = 0; i < cpu.id.size(); ++i) {
            const bool same =
                gl.id[i] == cpu.id[i] &&
                (std::isinf(cpu.z[i]) || (std::abs(gl.z[i] - cpu.z[i]) < 1e-4 &&
                                          glm::distance(gl.normal[i], cpu.normal[i]) < 1e-3));
            other += !same;
            for (int c = 0; c < 3; ++c) other_color += std::abs(gl.rgb[i][c] - cpu.rgb[i][c]) > 24;
          }
          EXPECT_LE(other, kFewPixels);
          EXPECT_LE(other_color, 3 * kFewPixels * samples);
          EXPECT_EQ(hits(cpu) > 1500, share > 1);
        }
      }
    }
  }
}

/// A plate's cap has its normal up to the rim, and a needle's wall up to its ends. In canonical
/// space both are as wide as long, so that float misplaces a point by more than the thin side.
TEST(ThinNormalsTest, PlatesAndNeedlesHaveTheirNormals) {
  for (const double thickness : {1e-5, 1e-4}) {
    const Scene plate = scene_of(Op::kUnion, {make_frustum(0, thickness, 5, 5)});
    const View view = small_view(Projection::kPerspective, 60);
    const Image image = gl_test::draw(plate, view, gl_test::by_tiles());
    uint64_t caps = 0, others = 0;
    for (size_t i = 0; i < image.z.size(); ++i) {
      if (!std::isfinite(image.z[i])) continue;
      (glm::distance(image.normal[i], glm::vec3(0, 0, 1)) < 1e-3 ? caps : others) += 1;
    }
    EXPECT_GT(caps, 1000u);
    EXPECT_EQ(others, 0u) << thickness;
  }
  const Scene needle = scene_of(Op::kUnion, {make_frustum(-50, 50, 1e-3, 1e-3)});
  View view;
  view.projection = Projection::kOrthographic;
  view.eye = {0, -10, 49.9};
  view.forward = {0, 1, 0};
  view.right = {1, 0, 0};
  view.up = {0, 0, 1};
  view.half_height = 0.05;
  view.width_px = view.height_px = 400;
  const Image image = gl_test::draw(needle, view, gl_test::by_tiles());
  EXPECT_GT(hits(image), 1000u);
  for (size_t i = 0; i < image.z.size(); ++i) {
    if (!std::isfinite(image.z[i])) continue;
    ASSERT_LT(std::abs(image.normal[i].z), 1e-3) << i;
  }
}

}  // namespace
