// What convex bodies primitives span.
#include <gtest/gtest.h>

#include <memory>

#include "csgcore/profile.hpp"
#include "hulls/generator.hpp"
#include "hulls/hull_support.hpp"
#include "plane/hull.hpp"

namespace frontend {
namespace {

using csgcore::Vec3;

csgcore::Primitive extruded(const Figure& figure) {
  Outline outline = outline_of(figure);
  return csgcore::make_extrusion(
      std::make_shared<csgcore::Profile>(std::move(outline.loops), outline.fill_rule), 0, 2);
}

TEST(SupportSet, KeepsTheArcsOfConvexOutlinesAsDiscs) {
  const std::vector<Disc> discs{{{0, 0}, 2}, {{10, 0}, 1}, {{3, 7}, 0.5}};
  SupportSet support;
  add_support(extruded(convex_hull(discs)), support);
  EXPECT_FALSE(support.is_faceted);
  EXPECT_NEAR(hull_test::support(support.generators, Vec3(-0.6, -0.8, 0)), 2, 1e-15);
  EXPECT_NEAR(hull_test::support(support.generators, Vec3(0.6, -0.8, 1)), 6 + 1 + 2, 1e-15);
}

TEST(SupportSet, TakesPointsForArcsWhoseDiscsStickOut) {
  // A segment of a disc of radius 5 about (0, −4), above the x axis.
  Outline cap;
  csgcore::ProfileEdge arc;
  arc.kind = csgcore::ProfileEdge::Kind::kArc;
  arc.control = {0, -4};
  arc.end = {-3, 0};
  csgcore::ProfileEdge chord;
  chord.end = {3, 0};
  cap.loops = {{chord, arc}};
  SupportSet support;
  add_support(extruded(cap), support);
  EXPECT_TRUE(support.is_faceted);
  EXPECT_NEAR(hull_test::support(support.generators, Vec3(0, -1, 0)), 0, 1e-15);
  EXPECT_NEAR(hull_test::support(support.generators, Vec3(0, 1, 0)), 1, 1e-3);
}

TEST(SupportSet, TakesATorusForADiscAndABall) {
  Outline circle = outline_of(Figure(Disc{{5, 1}, 2}));
  SupportSet support;
  add_support(csgcore::make_revolution(
                  std::make_shared<csgcore::Profile>(std::move(circle.loops), circle.fill_rule)),
              support);
  EXPECT_FALSE(support.is_faceted);
  EXPECT_NEAR(hull_test::support(support.generators, Vec3(1, 0, 0)), 7, 1e-14);
  EXPECT_NEAR(hull_test::support(support.generators, Vec3(0.6, 0, 0.8)), 3 + 0.8 + 2, 1e-14);
}

TEST(SupportSet, KnowsConvexLoops) {
  const auto is_convex_polygon = [](Polygon corners) {
    return is_convex_loop(outline_of(Polygons{std::move(corners)}).loops.front());
  };
  EXPECT_TRUE(is_convex_polygon({{0, 0}, {4, 0}, {4, 3}, {0, 3}}));
  EXPECT_FALSE(is_convex_polygon({{0, 0}, {4, 0}, {1, 1}, {0, 4}}));
  EXPECT_FALSE(is_convex_polygon({{0, 3}, {4, 3}, {4, 0}, {0, 0}})) << "clockwise";
  EXPECT_FALSE(is_convex_polygon({{0, 4}, {-2, -3}, {3, 1}, {-3, 1}, {2, -3}})) << "a pentagram";
}

}  // namespace
}  // namespace frontend
