// The paper's §4.2: pictures compared with POV-Ray's, hit for hit and colour for colour.
//
// What counts as a difference is measured with the reference (tests/support): a pixel may differ
// only where the reference's own picture changes when all rays are moved by a fiftieth of a pixel,
// that is, where a silhouette or an edge runs that near to the pixel's centre.
#include "povray.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <iostream>
#include <sstream>

#include "support/full_run.hpp"
#include "support/read_design.hpp"
#ifdef SCADRAY_HAS_RENDER
#include "frontend/render.hpp"
#endif

namespace povray {
namespace {

using csgcore::Box;
using csgcore::Image;
using csgcore::kNoPrimitive;
using csgcore::PhongLight;
using csgcore::Projection;
using csgcore::ReferenceColors;
using csgcore::Scene;
using csgcore::Vec3;
using csgcore::View;

/// How near to a pixel's centre an edge must run for two tracers to disagree about it.
constexpr double kEdgePx = 1.0 / 50;
/// 8-bit levels by which colours may differ: two roundings, and POV-Ray's single-precision colours.
constexpr int kLevels = 2;
/// OpenGL's float arithmetic may decide this share of the hits differently, at edges only. POV-Ray
/// and the reference, in double and better, were seen to agree in every pixel.
constexpr double kWrongShare = 1e-4;

const ReferenceColors kColors{
    .background = Vec3(0.0), .front = {0.98, 0.84, 0.17}, .back = {0.62, 0.8, 0.32}};

Scene example(const std::string& name) {
  return test_support::read_design(std::string(SCADRAY_EXAMPLES_DIR "/") + name + ".scad").scene;
}

/// A camera at `distance` from the target, `azimuth_deg` from −y towards +x and `elevation_deg`
/// above the horizon.
View look_at(Projection projection, const Vec3& target, double distance, double azimuth_deg,
             double elevation_deg, double half_height) {
  const double degree = std::acos(-1.0) / 180;
  const double a = azimuth_deg * degree, e = elevation_deg * degree;
  View view;
  view.projection = projection;
  view.forward = {-std::sin(a) * std::cos(e), std::cos(a) * std::cos(e), -std::sin(e)};
  view.right = {std::cos(a), std::sin(a), 0};
  view.up = glm::cross(view.right, view.forward);
  view.eye = target - distance * view.forward;
  view.half_height = half_height;
  view.width_px = 640;
  view.height_px = 480;
  return view;
}

/// Views the whole model.
View overview(const Scene& scene, Projection projection) {
  const Box box = csgcore::reference_box(scene);
  const double radius = box.diagonal() / 2;
  constexpr double kTangent = 0.2;  // of half the vertical angle of view
  const double distance = radius / kTangent * 1.05;
  const bool orthographic = projection == Projection::kOrthographic;
  return look_at(projection, box.center(), distance, 25, 35, orthographic ? radius : kTangent);
}

/// Figure 15: so near to the wall of CS1000 that a few dozen holes fill the picture.
View close_up() { return look_at(Projection::kPerspective, {10, 0, 3}, 7, 70, 20, 0.4); }

struct Case {
  const char* name;
  const char* example;
  bool close_up = false;
  Projection projection = Projection::kPerspective;
  bool in_sample = true;  // also without SCADRAY_TEST_FULL=1
};

std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

const Case kCases[] = {
    {"r9", "r9"},
    {"r9_orthographic", "r9", false, Projection::kOrthographic},
    {"three_spheres", "three_spheres"},
    {"three_spheres_orthographic", "three_spheres", false, Projection::kOrthographic, false},
    {"knob", "knob"},
    {"flange", "flange"},
    {"pulley", "pulley"},
    {"t1022", "t1022"},
    {"t1022_orthographic", "t1022", false, Projection::kOrthographic, false},
    {"cs100", "cs100"},
    {"cs1000", "cs1000", false, Projection::kPerspective, false},
    {"cs1000_orthographic", "cs1000", false, Projection::kOrthographic, false},
    {"cs1000_close_up", "cs1000", true},
    {"cc100", "cc100"},
    {"cc200", "cc200", false, Projection::kPerspective, false},
    {"cc500", "cc500", false, Projection::kPerspective, false},
    {"cc1000", "cc1000", false, Projection::kPerspective, false},
};

/// Draws the picture that phong.hpp defines, by brute force, with its rays moved by a part of a
/// pixel.
Image reference(const Scene& scene, View view, const PhongLight& light, double right_px,
                double down_px) {
  const double step = 2 * view.half_height / view.height_px;
  const Vec3 moved = step * (right_px * view.right - down_px * view.up);
  (view.projection == Projection::kOrthographic ? view.eye : view.forward) += moved;
  Image image = csgcore::reference_render(scene, view);
  csgcore::reference_shade_phong(image, scene, view, light, kColors);
  return image;
}

bool differ(const std::array<uint8_t, 3>& a, const std::array<uint8_t, 3>& b) {
  for (int c = 0; c < 3; ++c) {
    if (std::abs(a[c] - b[c]) > kLevels) return true;
  }
  return false;
}

/// A picture in the form that the comparison uses.
struct Picture {
  Pixels rgb;
  std::vector<bool> hit;
};

Picture picture_of(Image image) {
  Picture picture{std::move(image.rgb), {}};
  for (const uint32_t id : image.id) picture.hit.push_back(id != kNoPrimitive);
  return picture;
}

Picture picture_of(Pixels rgb) {
  Picture picture{std::move(rgb), {}};
  for (const auto& pixel : picture.rgb) picture.hit.push_back(pixel[0] || pixel[1] || pixel[2]);
  return picture;
}

/// A scene seen by a camera, and the reference's picture of it.
class Judged {
 public:
  Judged(const Case& c, Scene scene_in) : scene(std::move(scene_in)) {
    view = c.close_up ? close_up() : overview(scene, c.projection);
    if (c.close_up && !test_support::full_run()) {  // POV-Ray takes 10 s for the full size
      view.width_px /= 2;
      view.height_px /= 2;
    }
    light = csgcore::phong_light(view, csgcore::reference_box(scene));
    truth = picture_of(reference(scene, view, light, 0, 0));
    excused.assign(truth.hit.size(), false);
    for (const double x : {-kEdgePx, kEdgePx}) {
      for (const double y : {-kEdgePx, kEdgePx}) {
        const Picture moved = picture_of(reference(scene, view, light, x, y));
        for (size_t i = 0; i < excused.size(); ++i) {
          if (moved.hit[i] != truth.hit[i] || differ(moved.rgb[i], truth.rgb[i])) excused[i] = true;
        }
      }
    }
  }

  Picture povray() const {
    return picture_of(
        render(scene_text(scene, view, light, kColors), view.width_px, view.height_px));
  }

  Scene scene;
  View view;
  PhongLight light;
  Picture truth;
  std::vector<bool> excused;
};

struct Difference {
  size_t hits = 0, hit_or_miss = 0, colour = 0;            // all pixels
  size_t unexcused_hit_or_miss = 0, unexcused_colour = 0;  // those that no edge excuses
  std::string where;                                       // the first few of those
};

Difference compare(const Picture& a, const Picture& b, const Judged& judged) {
  Difference result;
  for (size_t i = 0; i < a.rgb.size(); ++i) {
    result.hits += a.hit[i];
    const bool hit_differs = a.hit[i] != b.hit[i];
    const bool colour_differs = !hit_differs && differ(a.rgb[i], b.rgb[i]);
    result.hit_or_miss += hit_differs;
    result.colour += colour_differs;
    if (judged.excused[i] || !(hit_differs || colour_differs)) continue;
    result.unexcused_hit_or_miss += hit_differs;
    result.unexcused_colour += colour_differs;
    constexpr size_t kShown = 10;
    if (result.unexcused_hit_or_miss + result.unexcused_colour > kShown) continue;
    std::ostringstream where;
    where << "\n  (" << i % judged.view.width_px << "," << i / judged.view.width_px << "):";
    for (const auto& pixel : {a.rgb[i], b.rgb[i], judged.truth.rgb[i]}) {
      for (const uint8_t level : pixel) where << " " << int(level);
      where << " /";
    }
    result.where += where.str();
  }
  return result;
}

std::ostream& operator<<(std::ostream& out, const Difference& d) {
  return out << d.hits << " hits; differing: " << d.hit_or_miss << " in hit or miss ("
             << d.unexcused_hit_or_miss << " away from edges), " << d.colour << " in colour ("
             << d.unexcused_colour << " away from edges)" << d.where;
}

class PovRay : public testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    if (!installed()) GTEST_SKIP() << "povray is not installed";
    if (!GetParam().in_sample && !test_support::full_run()) {
      GTEST_SKIP() << "run with SCADRAY_TEST_FULL=1";
    }
  }
};

#ifdef SCADRAY_HAS_RENDER
uint8_t level(double share) { return uint8_t(std::lround(255 * share)); }

frontend::Rgb rgb(const Vec3& color) { return {level(color.x), level(color.y), level(color.z)}; }

Picture scadray(const Judged& judged, frontend::RendererKind renderer) {
  frontend::RenderSettings settings;
  settings.renderer = renderer;
  settings.scheme = {"test",         rgb(kColors.background), rgb(kColors.front), rgb(kColors.back),
                     rgb(Vec3(0.0)), rgb(Vec3(0.0)),          rgb(Vec3(0.0)),     rgb(Vec3(0.0))};
  settings.shading = frontend::Shading::kPhong;
  settings.measured_channels = true;
  frontend::RenderStats stats;
  return picture_of(frontend::render(judged.scene, judged.view, settings, stats));
}
#endif

TEST_P(PovRay, Agrees) {
  const Judged judged(GetParam(), example(GetParam().example));
  ASSERT_TRUE(may_be_told_from_black(judged.scene, kColors));
  const Picture povray = judged.povray();

  // The judge itself is compared: POV-Ray with the formulas of phong.hpp, traced by the reference.
  const Difference truth = compare(povray, judged.truth, judged);
  std::cout << GetParam().name << ", reference: " << truth << "\n";
  EXPECT_GT(truth.hits, povray.rgb.size() / 50) << "the picture must show something";
  EXPECT_EQ(truth.unexcused_hit_or_miss + truth.unexcused_colour, 0u);

#ifdef SCADRAY_HAS_RENDER
  using frontend::RendererKind;
  for (const auto& [name, renderer] :
       {std::pair{"cpu", RendererKind::kCpu}, std::pair{"gl", RendererKind::kGl}}) {
    const Difference ours = compare(scadray(judged, renderer), povray, judged);
    std::cout << GetParam().name << ", scadray, " << name << ": " << ours << "\n";
    EXPECT_EQ(ours.unexcused_hit_or_miss + ours.unexcused_colour, 0u) << name;
    // In double, as in the reference, no pixel may differ beyond that.
    const double limit = renderer == RendererKind::kCpu
                             ? double(truth.hit_or_miss + truth.colour)
                             : std::ceil(kWrongShare * double(truth.hits));
    EXPECT_LE(double(ours.hit_or_miss + ours.colour), limit) << name;
  }
#endif
}

INSTANTIATE_TEST_SUITE_P(Examples, PovRay, testing::ValuesIn(kCases),
                         [](const auto& instance) { return std::string(instance.param.name); });

// phong.hpp against POV-Ray at points whose colours are worked out by hand: a sphere of radius 1
// at distance 5, the light at the eye (n·l = r·v = 1 in the middle), and one from the side.
TEST(PovRayPhong, ColoursAreThoseOfTheFormula) {
  if (!installed()) GTEST_SKIP() << "povray is not installed";
  Scene scene;
  csgcore::Primitive ball;
  ball.solid = csgcore::SphereShape{1};
  ball.color = csgcore::Color{0.4f, 0.5f, 0.2f, 1};
  scene.primitives.push_back(ball);
  csgcore::CsgTreeBuilder builder;
  builder.primitive(0);
  scene.model = builder.finish();
  View view;
  view.eye = {0, 0, 5};
  view.half_height = 0.25;
  view.width_px = view.height_px = 101;
  const size_t middle = 50 * 101 + 50;
  const Pixels front = render(scene_text(scene, view, {view.eye}, kColors), 101, 101);
  // 255·(0.9·colour + 0.3) = 168.3, 191.25, 122.4
  EXPECT_THAT(front[middle], testing::ElementsAre(168, 191, 122));
  EXPECT_THAT(front[0], testing::ElementsAre(0, 0, 0));
  // The light at 45°: n·l = cos 45°, (r·v)^40 = 2^-20: 255·(0.2 + 0.7/√2)·colour
  const Pixels side = render(scene_text(scene, view, {Vec3(10, 0, 11)}, kColors), 101, 101);
  EXPECT_THAT(side[middle], testing::ElementsAre(71, 89, 35));
  // The light behind: the ambient part alone, without a highlight.
  const Pixels back = render(scene_text(scene, view, {Vec3(0, 0, -9)}, kColors), 101, 101);
  EXPECT_THAT(back[middle], testing::ElementsAre(20, 26, 10));
}

// A test that cannot fail is no test: a difference of a twentieth of the picture must show.
TEST(PovRayPhong, AWrongPictureIsSeen) {
  const Case c{"r9", "r9"};
  const Judged judged(c, example("r9"));
  Picture wrong = judged.truth;
  const size_t row = 240 * 640;
  size_t changed = 0;
  for (size_t i = row; i < row + 640; ++i) {
    if (judged.excused[i]) continue;
    wrong.hit[i] = !wrong.hit[i];
    ++changed;
  }
  ASSERT_GT(changed, 500u);
  EXPECT_EQ(compare(wrong, judged.truth, judged).unexcused_hit_or_miss, changed);
  wrong = judged.truth;
  wrong.rgb[row + 320][1] = uint8_t(wrong.rgb[row + 320][1] + 3);
  EXPECT_EQ(compare(wrong, judged.truth, judged).colour, 1u);
}

}  // namespace
}  // namespace povray
