// Tests pictures whose cells are drawn while another thread makes them.
#include <gtest/gtest.h>

#include "fixture.hpp"
#include "support/models.hpp"

namespace {

using csgcore::Image;
using csgcore::Projection;
using csgcore::Scene;
using csgcore::SubdivisionOptions;
using csgcore::View;
using gl_test::expect_right;
using gl_test::leaves_of;
using gl_test::LoadedScene;
using gl_test::view_from;

TEST(WhileSubdividing, DrawsTheWholePicture) {
  const Scene scene = test_support::cylinder_minus_spheres(2000);
  const View view = view_from(scene, Projection::kPerspective, 25, 35);
  LoadedScene loaded(scene, leaves_of(8));
  const Image whole = loaded.draw(view);
  const Image batches =
      loaded.renderer.draw_while_subdividing(leaves_of(8), view, loaded.settings, loaded.stats);
  EXPECT_EQ(whole.rgb, batches.rgb);
  EXPECT_EQ(whole.id, batches.id);
  EXPECT_GE(loaded.stats.draw_calls, 1u);
}

/// Cells that the budget did not suffice to divide are drawn as they are.
TEST(WhileSubdividing, DrawsCellsThatAreGivenUp) {
  const Scene scene = test_support::stacked_frusta(12);
  const View view = view_from(scene, Projection::kPerspective, 25, 35);
  SubdivisionOptions options = leaves_of(2);
  options.budget_bytes = 1 << 15;
  expect_right(scene, view, options);
  LoadedScene loaded(scene, options);
  const csgcore::LeafCensus leaves = csgcore::census(loaded.subdivision);
  EXPECT_GT(leaves.by_kind[static_cast<size_t>(csgcore::LeafKind::kGivenUp)], 0u);
  const Image whole = loaded.draw(view);
  const Image batches =
      loaded.renderer.draw_while_subdividing(options, view, loaded.settings, loaded.stats);
  EXPECT_EQ(whole.rgb, batches.rgb);
  EXPECT_EQ(whole.id, batches.id);
}

}  // namespace
