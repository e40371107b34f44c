// The OpenGL picture against the CPU tracer's, channel by channel.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <string>

#include "csgcore/tracer.hpp"
#include "examples.hpp"
#include "fixture.hpp"

namespace {

using csgcore::Image;
using csgcore::Projection;
using csgcore::Vec3;
using csgcore::View;
using gl_test::LoadedScene;

// What float does to a hit. A ray's own coordinates are relative to the scene's middle, so that
// they are rounded to 2^-25 of its size, and some tens of operations lead from them to the
// boundary.

/// Along the normal, a share of the model's size: half of GL's own tolerance (kThinnestPiece).
constexpr double kSurfaceError = 0x1p-22;
/// Of a number that the picture stores as a float, by itself.
constexpr double kFloatRounding = 0x1p-24;
/// Length of the difference of unit normals, times their cosine to the ray: a point that is off by
/// kSurfaceError, on surfaces with radii down to 2^-10 of the model's size.
constexpr double kNormalError = 0x1p-12;
/// Unit normals further apart are of two faces, at whose common edge either is right.
constexpr double kOtherFace = 0.05;
/// Levels of 255: both round the same colour but for 1e-4.
constexpr int kLevels = 1;
/// Pixels at an edge whose ray float takes to the other side of it: of so many hits one.
constexpr uint64_t kHitsPerEdgePixel = 2000;
/// The tracer takes its samples only where neighbouring pixels show an edge, so that it misses some
/// of what is smaller than a pixel: one of so many pixels that it blends.
constexpr uint64_t kBlendedPerMissed = 20;

/// What the pictures' pixels have in common, of the channels of their hits at most.
struct Agreement {
  uint64_t hits = 0;
  uint64_t other_face = 0;  // of the same primitive
  double surface = 0;       // along the normal, a share of the model's size, as the next two
  double depth = 0;         // beyond what rounding does to it, times the cosine
  double normal = 0;        // times the cosine
  int levels = 0;
};

int levels_apart(const Image& a, const Image& b, size_t i) {
  int most = 0;
  for (int c = 0; c < 3; ++c) most = std::max(most, std::abs(int{a.rgb[i][c]} - b.rgb[i][c]));
  return most;
}

Agreement agreement(const Image& gl, const Image& cpu, const View& view, double model_size) {
  Agreement result;
  for (size_t i = 0; i < cpu.id.size(); ++i) {
    if (gl.id[i] != cpu.id[i]) continue;
    if (cpu.id[i] == csgcore::kNoPrimitive) {
      EXPECT_TRUE(std::isinf(gl.z[i]) && std::isinf(cpu.z[i]));
      EXPECT_EQ(gl.rgb[i], cpu.rgb[i]);
      continue;
    }
    ++result.hits;
    const Vec3 normal(cpu.normal[i]);
    const double normal_error = glm::length(Vec3(gl.normal[i]) - normal);
    if (normal_error > kOtherFace) {
      ++result.other_face;
      continue;
    }
    const csgcore::Ray ray =
        csgcore::pixel_ray(view, double(i % view.width_px), double(i / view.width_px));
    const double cosine = std::abs(glm::dot(normal, ray.direction));
    const Vec3 apart = Vec3(gl.position[i]) - Vec3(cpu.position[i]);
    const double rounding = 2 * kFloatRounding * glm::length(Vec3(cpu.position[i]));
    const double surface = std::max(0.0, std::abs(glm::dot(apart, normal)) - rounding);
    const double depth = std::abs(double(gl.z[i]) - double(cpu.z[i]));
    const double depth_rounding = 2 * kFloatRounding * std::abs(double(cpu.z[i]));
    result.surface = std::max(result.surface, surface / model_size);
    result.depth =
        std::max(result.depth, std::max(0.0, depth - depth_rounding) * cosine / model_size);
    result.normal = std::max(result.normal, normal_error * cosine);
    result.levels = std::max(result.levels, levels_apart(gl, cpu, i));
  }
  return result;
}

struct Pictures {
  Image gl, cpu;
};

struct Case {
  const char* example;
  Projection projection;
};

/// For the test's name, which must not hold an address.
void PrintTo(const Case& one, std::ostream* out) { *out << one.example; }

class CpuAgreementTest : public testing::TestWithParam<Case> {
 protected:
  CpuAgreementTest()
      : design_(gl_test::read_design(std::string(SCADRAY_EXAMPLES_DIR "/") + GetParam().example +
                                     ".csg")),
        view_(gl_test::default_view(design_, 320, 240)),
        loaded_(design_.scene, gl_test::leaves_of(8)) {
    const csgcore::Box box = csgcore::reference_box(design_.scene);
    model_size_ = box.diagonal();
    if (GetParam().projection == Projection::kOrthographic) {
      view_.projection = Projection::kOrthographic;
      view_.half_height *= glm::length(view_.eye - box.center());
    }
    loaded_.settings.background = glm::vec3(0xff, 0xff, 0xe5) / 255.0f;
    loaded_.settings.front = glm::vec3(0xf9, 0xd7, 0x2c) / 255.0f;
    loaded_.settings.back = glm::vec3(0x9d, 0xcb, 0x51) / 255.0f;
  }

  Pictures draw(uint32_t samples = 1) {
    Pictures pictures;
    loaded_.settings.samples = samples;
    pictures.gl = loaded_.draw(view_);
    csgcore::TraceOptions options;
    options.samples = samples;
    csgcore::TraceStats stats;
    csgcore::draw(loaded_.solid, view_, loaded_.settings, options, pictures.cpu, stats);
    return pictures;
  }

  frontend::ImportedDesign design_;
  View view_;
  LoadedScene loaded_;
  double model_size_ = 0;
};

INSTANTIATE_TEST_SUITE_P(, CpuAgreementTest,
                         testing::Values(Case{"r9", Projection::kPerspective},
                                         Case{"three_spheres", Projection::kOrthographic},
                                         Case{"knob", Projection::kPerspective},
                                         Case{"flange", Projection::kOrthographic},
                                         Case{"cs100", Projection::kPerspective},
                                         Case{"t1022", Projection::kOrthographic}),
                         [](const auto& instance) { return instance.param.example; });

TEST_P(CpuAgreementTest, OfEveryChannel) {
  for (const auto shading : {glrender::Shading::kOpenScad, glrender::Shading::kPhong}) {
    loaded_.settings.shading = shading;
    const Pictures pictures = draw();
    const auto edges = gl_test::speckle(pictures.gl, pictures.cpu);
    const Agreement same = agreement(pictures.gl, pictures.cpu, view_, model_size_);
    std::printf(
        "%s: %llu hits, %llu of another primitive, %llu of another face; off by %.1e along "
        "the normal, %.1e in depth, normals by %.1e, colours by %d\n",
        GetParam().example, static_cast<unsigned long long>(edges.hits),
        static_cast<unsigned long long>(edges.wrong),
        static_cast<unsigned long long>(same.other_face), same.surface, same.depth, same.normal,
        same.levels);
    EXPECT_GT(same.hits, 1500u);
    EXPECT_EQ(edges.speckle, 0u);
    EXPECT_LE((edges.wrong + same.other_face) * kHitsPerEdgePixel, edges.hits);
    EXPECT_LE(same.surface, kSurfaceError);
    EXPECT_LE(same.depth, kSurfaceError);
    EXPECT_LE(same.normal, kNormalError);
    EXPECT_LE(same.levels, kLevels);
  }
}

TEST_P(CpuAgreementTest, OfTheSamples) {
  const Pictures one = draw(1);
  const Pictures many = draw(8);
  uint64_t blended = 0, apart = 0;
  int most = 0;
  for (size_t i = 0; i < many.cpu.rgb.size(); ++i) {
    blended += levels_apart(one.cpu, many.cpu, i) > kLevels;
    const int levels = levels_apart(many.gl, many.cpu, i);
    apart += levels > kLevels;
    most = std::max(most, levels);
  }
  std::printf("%s: %llu pixels blended, %llu of them differently, by up to %d\n",
              GetParam().example, static_cast<unsigned long long>(blended),
              static_cast<unsigned long long>(apart), most);
  EXPECT_GT(blended, 200u);
  EXPECT_LE(apart * kBlendedPerMissed, blended);
}

}  // namespace
