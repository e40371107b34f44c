// Tests the parts of a scene that cannot be seen: rays are not intersected with them, and they
// change no bit of the picture.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <span>

#include "csgcore/polyhedron.hpp"
#include "csgcore/tracer.hpp"
#include "trace_scenes.hpp"
#include "whole_list.hpp"

namespace csgcore {
namespace {

/// So many parts that every list with all of them is long.
constexpr uint32_t kParts = 300;

/// Looks down on x, y in [−8, 8].
View view_from_above(Projection projection) {
  View view;
  view.projection = projection;
  view.eye = {0, 0, 100};
  view.half_height = projection == Projection::kOrthographic ? 8 : 0.08;
  view.width_px = view.height_px = 64;
  return view;
}

/// A tree of a few primitives that are seen, and many that are not.
struct Parts {
  std::vector<Primitive> seen;
  std::function<Primitive(uint32_t)> unseen;
  /// Builds the tree of the primitives that are seen, [0, seen.size()), and of the others, [first,
  /// end).
  std::function<void(CsgTreeBuilder&, uint32_t first, uint32_t end)> build;
};

Scene make_scene(const Parts& parts, uint32_t count) {
  Scene scene;
  scene.primitives = parts.seen;
  const uint32_t first = static_cast<uint32_t>(parts.seen.size());
  for (uint32_t i = 0; i < count; ++i) scene.primitives.push_back(parts.unseen(i));
  CsgTreeBuilder builder;
  parts.build(builder, first, first + count);
  scene.model = builder.finish();
  return scene;
}

void add_range(CsgTreeBuilder& builder, uint32_t first, uint32_t end) {
  for (uint32_t i = first; i < end; ++i) builder.primitive(i);
}

/// Two balls far away, which fix the solid's box whatever else there is.
const Primitive kLeft = make_sphere(1, checks::moved({-1e3, -1e3, -1e3}));
const Primitive kRight = make_sphere(1, checks::moved({1e3, 1e3, 50}));

constexpr Projection kBothProjections[] = {Projection::kOrthographic, Projection::kPerspective};
constexpr std::span kPerspective(kBothProjections + 1, 1);

void expect_skipped(const Parts& parts,
                    std::span<const Projection> projections = kBothProjections) {
  for (const Projection projection : projections) {
    SCOPED_TRACE(projection == Projection::kOrthographic ? "orthographic" : "perspective");
    const View view = view_from_above(projection);
    Hits with, without;
    TraceStats stats, stats_without;
    const Scene whole = make_scene(parts, kParts);
    const Scene seen = make_scene(parts, 0);
    const Solid solid(canonical_primitives(whole), whole.model);
    const Solid solid_seen(canonical_primitives(seen), seen.model);
    ASSERT_EQ(solid.bounds().diagonal(), solid_seen.bounds().diagonal());
    trace(solid, view, {}, with, stats);
    trace(solid_seen, view, {}, without, stats_without);
    EXPECT_TRUE(checks::same_bits(with, without));
    EXPECT_GT(checks::count_hits(without), 500u);
    EXPECT_LE(stats.intersections, stats_without.intersections * 11 / 10);
    EXPECT_TRUE(checks::same_bits(with, checks::WholeList(solid, view).picture()));
  }
}

/// A union of the seen and all others.
void build_union(CsgTreeBuilder& builder, uint32_t first, uint32_t end) {
  builder.open(Op::kUnion);
  add_range(builder, 0, first);
  add_range(builder, first, end);
  builder.close();
}

/// Hardly any ray is traced that passes a large shape, although the shape fills its rectangle
/// badly.
TEST(Skipped, RaysThatPassLargeShapes) {
  Affine tilted;  // a rotation
  tilted.linear = {
      {2.0 / 3, 2.0 / 3, -1.0 / 3}, {-1.0 / 3, 2.0 / 3, 2.0 / 3}, {2.0 / 3, -1.0 / 3, 2.0 / 3}};
  const Primitive shapes[] = {make_sphere(5), make_frustum(-5, 5, 3, 3, tilted),
                              make_frustum(-5, 5, 5, 0.5, tilted),
                              make_polyhedron(Polyhedron::box({Vec3(-3.5), Vec3(3.5)}), tilted)};
  for (const Projection projection : kBothProjections) {
    for (const Primitive& shape : shapes) {
      View view = view_from_above(projection);
      view.width_px = view.height_px = 640;
      Scene scene;
      scene.primitives = {shape};
      CsgTreeBuilder builder;
      builder.primitive(0);
      scene.model = builder.finish();
      Hits hits;
      TraceStats stats;
      trace(Solid(canonical_primitives(scene), scene.model), view, {}, hits, stats);
      // Tiles reach some pixels beyond the shape.
      EXPECT_LT(static_cast<double>(stats.rays),
                1.22 * static_cast<double>(checks::count_hits(hits)));
    }
  }
}

double place(uint32_t i) { return -5 + 10.0 * i / kParts; }

TEST(Skipped, OffTheScreen) {
  const auto aside = [](uint32_t i) {
    return make_sphere(1, checks::moved({i % 2 ? 40 : -40, 3 * place(i), 0}));
  };
  expect_skipped({{kLeft, kRight, make_sphere(5)}, aside, build_union});
}

TEST(Skipped, BehindTheEye) {
  const auto behind = [](uint32_t i) { return make_sphere(1, checks::moved({0, 0, 200 + i})); };
  expect_skipped({{kLeft, kRight, make_sphere(5), make_sphere(1, checks::moved({0, 0, 1e3}))},
                  behind,
                  build_union},
                 kPerspective);
}

TEST(Skipped, BetweenTheSamples) {
  // A pixel is 0.25 wide, and its corners are at multiples of that.
  const auto dust = [](uint32_t i) {
    const double x = 0.25 * std::round(4 * place(i)),
                 y = 0.25 * std::round(2 * place(7 * i % kParts));
    return make_sphere(0.02, checks::moved({x, y, 1e-3 * i}));  // no two are equal
  };
  expect_skipped({{kLeft, kRight, make_sphere(5, checks::moved({0, 0, -20}))}, dust, build_union});
}

TEST(Skipped, SubtractedFromTheAir) {
  const auto build = [](CsgTreeBuilder& builder, uint32_t first, uint32_t end) {
    builder.open(Op::kUnion);
    add_range(builder, 0, 2);
    builder.open(Op::kDifference);
    add_range(builder, 2, end);
    builder.close();
    builder.close();
    (void)first;
  };
  const auto beside = [](uint32_t i) { return make_sphere(1, checks::moved({6, place(i), 0})); };
  expect_skipped({{kLeft, kRight, make_sphere(4)}, beside, build});
}

TEST(Skipped, AddedAndWhollySubtracted) {
  const auto build = [](CsgTreeBuilder& builder, uint32_t first, uint32_t end) {
    builder.open(Op::kUnion);
    add_range(builder, 0, 3);
    builder.open(Op::kDifference);
    builder.open(Op::kUnion);
    builder.primitive(3);
    add_range(builder, first, end);
    builder.close();
    builder.primitive(4);
    builder.close();
    builder.close();
  };
  // A block whose upper half is cut off; the parts are in the air above it, and cut off, too.
  const auto in_the_air = [](uint32_t i) {
    return make_sphere(0.5, checks::moved({0.1 * (i % 7), 0.1 * (i % 5), 4 + 0.01 * i}));
  };
  expect_skipped({{kLeft, kRight, make_sphere(2, checks::moved({0, 0, -30})),
                   make_frustum(-3, 3, 5, 5), make_frustum(0, 20, 100, 100)},
                  in_the_air,
                  build});
}

TEST(Skipped, IntersectedAway) {
  const auto build = [](CsgTreeBuilder& builder, uint32_t first, uint32_t end) {
    builder.open(Op::kUnion);
    add_range(builder, 0, first);
    for (uint32_t i = first; i + 1 < end; i += 2) {
      builder.open(Op::kIntersection);
      add_range(builder, i, i + 2);
      builder.close();
    }
    builder.close();
  };
  // Pairs that are disjoint.
  const auto apart = [](uint32_t i) {
    return make_sphere(1, checks::moved({i % 2 ? 6.5 : -6.5, place(i), 0}));
  };
  expect_skipped({{kLeft, kRight, make_sphere(4)}, apart, build});
}

/// Seen from outside the parts are hidden, too; therefore the eye is inside.
TEST(Skipped, InsideTheSolid) {
  // The parts are behind each other, so that each tile has all of them or none.
  const auto within = [](uint32_t i) {
    return make_sphere(1, checks::moved({0, 0, -2 + 4.0 * i / kParts}));
  };
  expect_skipped({{kLeft, kRight, make_sphere(200)}, within, build_union}, kPerspective);
}

TEST(Skipped, BehindWhatIsSeen) {
  const auto behind = [](uint32_t i) {
    return make_sphere(2,
                       checks::moved({0.3 * place(i), 0.3 * place(7 * i % kParts), -20 - 0.1 * i}));
  };
  expect_skipped({{kLeft, kRight, make_frustum(0, 1, 7, 7)}, behind, build_union});
}

}  // namespace
}  // namespace csgcore
