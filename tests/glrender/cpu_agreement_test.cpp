// Tests the OpenGL picture against the CPU tracer's, channel by channel.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <glm/geometric.hpp>
#include <string>

#include "agreement.hpp"
#include "examples.hpp"

namespace {

using csgcore::Image;
using csgcore::Projection;
using csgcore::View;
using gl_test::LoadedScene;

constexpr gl_test::EdgeLimits kEdges{.face_distance = 0.05};
/// The tracer takes its samples only where neighbouring pixels show an edge, and so misses some
/// things that are smaller than a pixel: one pixel for this many that it blends.
constexpr uint64_t kBlendedPerMissed = 20;

struct Pictures {
  Image gl, cpu;
};

struct Case {
  const char* example;
  Projection projection;
};

/// Prints the case for the test's name, which must not contain an address.
void PrintTo(const Case& one, std::ostream* out) { *out << one.example; }

class CpuAgreementTest : public testing::TestWithParam<std::tuple<Case, gl_test::Way>> {
 protected:
  CpuAgreementTest()
      : design_(gl_test::example(drawn().example)),
        view_(gl_test::default_view(design_, 320, 240)),
        loaded_(design_.scene, std::get<1>(GetParam())) {
    const csgcore::Box box = csgcore::reference_box(design_.scene);
    model_size_ = box.diagonal();
    if (drawn().projection == Projection::kOrthographic) {
      view_.projection = Projection::kOrthographic;
      view_.half_height *= glm::length(view_.eye - box.center());
    }
    loaded_.settings.background = glm::vec3(0xff, 0xff, 0xe5) / 255.0f;
    loaded_.settings.front = glm::vec3(0xf9, 0xd7, 0x2c) / 255.0f;
    loaded_.settings.back = glm::vec3(0x9d, 0xcb, 0x51) / 255.0f;
  }

  static const Case& drawn() { return std::get<0>(GetParam()); }

  Pictures draw(uint32_t samples = 1) {
    Pictures pictures;
    loaded_.settings.samples = samples;
    pictures.gl = loaded_.draw(view_);
    pictures.cpu = gl_test::draw_by_cpu(loaded_, view_);
    return pictures;
  }

  frontend::ImportedDesign design_;
  View view_;
  LoadedScene loaded_;
  double model_size_ = 0;
};

INSTANTIATE_TEST_SUITE_P(
    , CpuAgreementTest,
    testing::Combine(testing::Values(Case{"r9", Projection::kPerspective},
                                     Case{"three_spheres", Projection::kOrthographic},
                                     Case{"knob", Projection::kPerspective},
                                     Case{"flange", Projection::kOrthographic},
                                     Case{"cs100", Projection::kPerspective},
                                     Case{"nut_trap", Projection::kPerspective},
                                     Case{"bracket", Projection::kOrthographic},
                                     Case{"t1022", Projection::kOrthographic}),
                     testing::Values(gl_test::Way(gl_test::leaves_of(8)), gl_test::by_tiles())),
    [](const auto& instance) {
      const bool tiles = std::get<1>(instance.param).technique == glrender::Technique::kTiles;
      return std::get<0>(instance.param).example + std::string(tiles ? "_tiles" : "_cells");
    });

TEST_P(CpuAgreementTest, OfEveryChannel) {
  for (const auto shading :
       {glrender::Shading::kOpenScad, glrender::Shading::kPhong, glrender::Shading::kStudio}) {
    loaded_.settings.shading = shading;
    const Pictures pictures = draw();
    gl_test::expect_agreement(pictures.gl, pictures.cpu, view_, model_size_, kEdges,
                              drawn().example);
  }
}

TEST_P(CpuAgreementTest, OfTheSamples) {
  const Pictures one = draw(1);
  const Pictures many = draw(8);
  uint64_t blended = 0, apart = 0;
  int most = 0;
  for (size_t i = 0; i < many.cpu.rgb.size(); ++i) {
    blended += gl_test::levels_apart(one.cpu, many.cpu, i) > gl_test::kLevels;
    const int levels = gl_test::levels_apart(many.gl, many.cpu, i);
    apart += levels > gl_test::kLevels;
    most = std::max(most, levels);
  }
  std::printf("%s: %llu pixels blended, %llu of them differently, by up to %d\n", drawn().example,
              static_cast<unsigned long long>(blended), static_cast<unsigned long long>(apart),
              most);
  EXPECT_GT(blended, 200u);
  EXPECT_LE(apart * kBlendedPerMissed, blended);
}

}  // namespace
