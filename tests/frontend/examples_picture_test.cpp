// Tests every example, drawn as the command draws it, with every renderer, against the brute-force
// oracle. Prints a table. The bars at the default settings: the CPU tracer has no wrong pixel,
// OpenGL at most 1 in 10,000 hits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "csgcore/subdivision.hpp"
#include "csgcore/tracer.hpp"
#include "glrender/examples.hpp"
#include "glrender/fixture.hpp"
#include "judge.hpp"
#include "support/full_run.hpp"

namespace {

/// The wrong pixels of each renderer.
struct WrongPixels {
  uint64_t tiles, cells;  // by the CPU tracer, with screen tiles and with a kd-tree
  uint64_t gl;
  uint64_t paper;      // by GL with the paper's own rule
  uint64_t undecided;  // by the tracer: the oracle's own rounding leaves them open
};

csgcore::Image image_of(const stress::Oracle& oracle, const csgcore::Scene& scene) {
  const csgcore::View& view = oracle.view();
  csgcore::Image image{view.width_px, view.height_px, {}, {}, {}, {}, {}, {}};
  for (size_t i = 0; i < size_t{view.width_px} * view.height_px; ++i) {
    const oracle::ExactHit& hit = oracle.hit(i);
    image.z.push_back(static_cast<float>(hit.s.lower));
    image.position.emplace_back(hit.position);
    image.normal.emplace_back(hit.normal);
    image.id.push_back(hit.hit() ? scene.primitives[hit.primitive].id : csgcore::kNoPrimitive);
  }
  return image;
}

/// The size is divided by this. The oracle takes ten seconds for so many rays where they
/// meet profiles or meshes, which it solves exactly: a sample has fewer.
uint32_t divisor_for(const csgcore::Scene& scene) {
  uint32_t divisor = 1;
  if (test_support::full_run()) return divisor;
  for (const csgcore::Primitive& primitive : scene.primitives) {
    if (primitive.mesh()) divisor = std::max(divisor, 2u);
    if (primitive.profile()) divisor = 4;
  }
  return divisor;
}

csgcore::View view_of(const frontend::ImportedDesign& design) {
  const uint32_t divisor = divisor_for(design.scene);
  return gl_test::default_view(design, 640 / divisor, 480 / divisor);
}

class ExamplePictureTest : public testing::TestWithParam<std::string> {
 protected:
  ExamplePictureTest()
      : design_(gl_test::example(GetParam())),
        view_(view_of(design_)),
        solid_(csgcore::canonical_primitives(design_.scene), design_.scene.model),
        oracle_(design_.scene, view_) {}

  /// `tracer` is the solid, or a subdivision of it.
  template <typename Tracer>
  uint64_t wrong_on_cpu(const Tracer& tracer, WrongPixels& wrong) {
    csgcore::Hits hits;
    csgcore::TraceStats stats;
    csgcore::trace(tracer, view_, {}, hits, stats);
    const stress::Tally tally = stress::judge(oracle_, hits, stress::kDoubleTolerance);
    EXPECT_EQ(tally.wrong_pixels(), 0u) << tally.first_wrong;
    wrong.undecided = std::max(wrong.undecided, tally.undecided);
    return tally.wrong_pixels();
  }

  gl_test::Comparison gl_compared(const csgcore::SubdivisionOptions& options) const {
    return gl_test::compare(gl_test::draw(design_.scene, view_, options), picture_,
                            oracle_.model_size());
  }

  frontend::ImportedDesign design_;
  csgcore::View view_;
  csgcore::Solid solid_;
  stress::Oracle oracle_;
  csgcore::Image picture_ = image_of(oracle_, design_.scene);
};

TEST_P(ExamplePictureTest, EqualsTheOracle) {
  WrongPixels wrong{};
  wrong.tiles = wrong_on_cpu(solid_, wrong);
  wrong.cells = wrong_on_cpu(csgcore::Subdivision(solid_, gl_test::leaves_of(8)), wrong);
  const gl_test::Comparison gl = gl_compared(gl_test::leaves_of(8));
  const gl_test::Comparison paper = gl_compared(csgcore::SubdivisionOptions::paper(1, view_));
  wrong.gl = gl.wrong();
  wrong.paper = paper.wrong();
  const auto number = [](uint64_t n) { return static_cast<unsigned long long>(n); };
  std::printf(
      "%-14s %8llu hits; wrong: CPU, tiles %llu, cells %llu (%llu undecided); GL, K = 8: %llu, the "
      "paper's K = 2 at 1 px: %llu lost or wrong\n",
      GetParam().c_str(), number(gl.hits), number(wrong.tiles), number(wrong.cells),
      number(wrong.undecided), number(wrong.gl), number(wrong.paper));
  constexpr uint64_t kLeastShare = 64;  // of the picture: the design is seen
  EXPECT_GT(kLeastShare * gl.hits, uint64_t{view_.width_px} * view_.height_px);
  // The bar: 1 in 100,000.
  EXPECT_LE(wrong.undecided * 100000, std::max<uint64_t>(gl.hits, 100000));
  EXPECT_LE(wrong.gl * 10000, gl.hits) << gl.first;
  // The dropped cells lose little (paper, figure 3), but not nothing.
  EXPECT_LE(wrong.paper * 20, paper.hits);
}

std::vector<std::string> examples() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(SCADRAY_EXAMPLES_DIR)) {
    if (entry.path().extension() == ".scad") names.push_back(entry.path().stem());
  }
  std::erase(names, "cut_cylinder");  // the common base of csN and ccN
  std::sort(names.begin(), names.end());
  return names;
}

INSTANTIATE_TEST_SUITE_P(, ExamplePictureTest, testing::ValuesIn(examples()),
                         [](const auto& instance) { return instance.param; });

}  // namespace
