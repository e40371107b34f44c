// Tests how extrusions are cut into slices, and the meshes between them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "csgcore/triangle_mesh.hpp"
#include "solids/sliced_solid.hpp"
#include "solids/smooth_slices.hpp"

namespace frontend {
namespace {

using testing::ElementsAre;

SimplePolygons square(double size) { return {{{0, 0}, {size, 0}, {size, size}, {0, size}}}; }

struct Given {
  TwistedLayers layers;
  csgcore::FacetSettings facets;
};

double slices(const Given& given) { return slice_count(given.layers, square(5), given.facets); }

TEST(SliceCount, IsOpenScads) {
  // As OpenSCAD 2021.01 writes them.
  EXPECT_EQ(slices({{0, 10, 90}, {}}), 8);
  EXPECT_EQ(slices({{0, 10, 360}, {}}), 23);
  EXPECT_EQ(slices({{0, 10, 0, {1, 2}}, {}}), 6);
  EXPECT_EQ(slices({{0, 10, 90, {2, 2}}, {0, 1, 0.5}}), 28);
  EXPECT_EQ(slices({{0, 10, 200, {0.3, 0.3}}, {0, 1, 0.5}}), 40);
  EXPECT_EQ(slices({{0, 10, 200, {0.3, 0.3}}, {}}), 10);
  EXPECT_EQ(slices({{0, 10, 0, {2, 2}}, {}}), 1);
}

TEST(SliceCount, IsFinite) {
  EXPECT_EQ(slices({{0, 10, 400}, {std::nan(""), 12, 2}}), 4);
  EXPECT_EQ(slices({{0, 10, 90}, {100, 12, 2}}), 25);
  EXPECT_EQ(slices({{0, 10, 90}, {0, 12, 0}}), 1);
  EXPECT_EQ(slices({{0, 10, 0, {1, 2}}, {0, 12, 0}}), 1);
  EXPECT_EQ(slices({{0, 10, 0, {1, 2}}, {7.5, 12, 2}}), 7);
  EXPECT_EQ(slice_count({0, 10, 90}, {}, {}), 1);
}

TEST(OpenScadSlicing, CutsTheLongestEdges) {
  const SimplePolygons outline{{{0, 0}, {4, 0}, {4, 2}, {0, 2}}};
  EXPECT_EQ(openscad_slicing(3, std::nullopt, outline).outline, outline);
  EXPECT_EQ(openscad_slicing(3, 3, outline).outline, outline);
  const Polygon six = openscad_slicing(3, 7, outline).outline.front();
  EXPECT_EQ(six, (Polygon{{0, 0}, {2, 0}, {4, 0}, {4, 2}, {2, 2}, {0, 2}}));
  EXPECT_EQ(openscad_slicing(3, 12, outline).outline.front().size(), 12u);
}

TEST(OpenScadSlicing, IsBounded) {
  const Slicing slicing = openscad_slicing(1e300, 1e300, square(1));
  EXPECT_LE(2.0 * slicing.slices * static_cast<double>(slicing.outline.front().size()),
            kMostSideTriangles);
  EXPECT_EQ(openscad_slicing(1e300, std::nullopt, square(1)).slices, kMostSideTriangles / 8);
}

/// How many pieces each edge of a rectangle of 5 by 3 has. The expected ones are those of OpenSCAD
/// 2025.07.18.
std::vector<size_t> pieces_of(double twist, const Vec2& scale,
                              const csgcore::FacetSettings& facets = {},
                              const std::optional<double>& segments = {}) {
  const SimplePolygons outline{{{-2.5, -1.5}, {2.5, -1.5}, {2.5, 1.5}, {-2.5, 1.5}}};
  const Slicing slicing = cut_slicing({0, 10, twist, scale}, 5, segments, facets, outline);
  std::vector<size_t> count(2);
  for (const Vec2& point : slicing.outline.front()) {
    if (point.y == -1.5 && point.x < 2.5) ++count[0];
    if (point.x == 2.5 && point.y < 1.5) ++count[1];
  }
  return count;
}

TEST(CutSlicing, EdgesOfTwistedExtrusionsAreCut) {
  EXPECT_THAT(pieces_of(90, {1, 1}), ElementsAre(3, 2));
  EXPECT_THAT(pieces_of(0, {2, 0.5}), ElementsAre(5, 2));
  EXPECT_THAT(pieces_of(0, {0.5, 2}), ElementsAre(3, 3));
  // The image of an edge may be longest between the ends.
  EXPECT_THAT(pieces_of(60, {2, 0.5}), ElementsAre(4, 3));
  EXPECT_THAT(pieces_of(90, {3, 1}), ElementsAre(4, 5));
  EXPECT_THAT(pieces_of(200, {2, 1}), ElementsAre(5, 3));
  EXPECT_THAT(pieces_of(30, {1, 1}, {}, 4), ElementsAre(1, 1));
  // A turned edge is as long as it was.
  EXPECT_THAT(pieces_of(30, {1, 1}, {0, 5, 0.5}), ElementsAre(10, 6));
  EXPECT_THAT(pieces_of(30, {1, 1}, {0, 12, 0.1}), ElementsAre(9, 6));
  EXPECT_THAT(pieces_of(30, {1, 1}, {0, 60, 0.1}), ElementsAre(2, 1));
  // No more slices are lost than edges can be cut without.
  EXPECT_THAT(pieces_of(90, {1, 1}, {0, 12, 1e-9}), testing::Each(testing::Le(1u << 16)));
}

TEST(SliceCount, AnUnevenScaleAsksForItsSlices) {
  const SimplePolygons outline{{{-2.5, -1.5}, {2.5, -1.5}, {2.5, 1.5}, {-2.5, 1.5}}};
  const TwistedLayers layers{0, 10, 200, {2, 1}};
  EXPECT_EQ(slice_count(layers, outline, {20, 12, 2}, true), 20);
  EXPECT_EQ(slice_count(layers, outline, {20, 12, 2}), 12);
  EXPECT_EQ(slice_count(layers, outline, {}, true), 8);
}

/// The largest distance between the middle of a quadrilateral's diagonal and the smooth side, as a
/// share of the reach.
double error_of(const TwistedLayers& layers, const Slicing& slicing) {
  double worst = 0;
  for (int k = 0; k < slicing.slices; ++k) {
    const double from = static_cast<double>(k) / slicing.slices;
    const double to = (k + 1.0) / slicing.slices;
    const Polygon& polygon = slicing.outline.front();
    for (size_t i = 0; i < polygon.size(); ++i) {
      const Vec2& p = polygon[i];
      const Vec2& q = polygon[(i + 1) % polygon.size()];
      const Vec2 chord = (layers.at(from).image(p) + layers.at(to).image(q)) / 2.0;
      worst = std::max(worst, glm::length(chord - layers.at((from + to) / 2).image((p + q) / 2.0)));
    }
  }
  return worst / glm::length(Vec2(5, 5));
}

TEST(SmoothSlicing, IsNearTheSmoothSides) {
  for (const TwistedLayers& layers :
       {TwistedLayers{0, 10, 90}, TwistedLayers{0, 10, 300}, TwistedLayers{0, 10, 0, {1, 2}},
        TwistedLayers{0, 10, 0, {0, 3}}, TwistedLayers{0, 10, 30, {0, 0.5}}}) {
    const Slicing slicing = smooth_slicing(layers, 2, square(5));
    EXPECT_LT(error_of(layers, slicing), 3e-3);
    EXPECT_LT(2 * slicing.slices * slicing.outline.front().size(), 1u << 18);
    EXPECT_GT(error_of(layers, openscad_slicing(2, std::nullopt, square(5))), 1e-2);
  }
}

TEST(SmoothSlicing, HasNoFewerSlicesThanOpenScad) {
  EXPECT_EQ(smooth_slicing({0, 10, 90}, 1000, square(5)).slices, 1000);
}

TEST(SmoothSlicing, IsCoarserWhereItHasToBe) {
  const Slicing slicing = smooth_slicing({0, 1e9, 1e9}, 100, square(5));
  EXPECT_GE(slicing.slices, 100);
  EXPECT_LE(2 * slicing.slices * slicing.outline.front().size(), 1u << 18);
}

TEST(SmoothSlicing, OfAThreadJoinsEdgesOfTheSameDirection) {
  const Polygon circle = circle_polygon({{1, 0}, 10}, 120);
  const TwistedLayers layers{0, 10, -359};
  const Slicing slicing = smooth_slicing(layers, 60, {circle});
  EXPECT_EQ(slicing.slices, 60);
  EXPECT_EQ(slicing.outline.front(), circle);
  EXPECT_EQ(slicing.offsets.front(), 118u);
  const Polygon hole(circle.rbegin(), circle.rend());
  EXPECT_EQ(smooth_slicing(layers, 60, {hole}).offsets.front(), 2u);
}

/// The largest distance from the sides, in the middle of the first slice, to a disc that turns with
/// them.
double error_of_sides(const TwistedLayers& layers, const Slicing& slicing, const Disc& disc) {
  const Polygon& polygon = slicing.outline.front();
  const double step = 1.0 / slicing.slices;
  const Vec2 center = layers.at(step / 2).image(disc.center);
  double worst = 0;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 below = polygon[i];
    const Vec2 above =
        layers.at(step).image(polygon[(i + slicing.offsets.front()) % polygon.size()]);
    worst = std::max(worst, std::abs(glm::length((below + above) / 2.0 - center) - disc.radius));
  }
  return worst;
}

TEST(SmoothSlicing, OfAThreadHasAsManySlicesAsItsShapeAsksFor) {
  for (const double depth : {0.01, 0.1, 1.0, 3.0}) {
    const Disc disc{{depth, 0}, 10};
    const TwistedLayers layers{0, 10, 720};
    const Slicing slicing = smooth_slicing(layers, 1, {circle_polygon(disc, 120)});
    const double tolerance = smooth_tolerance(layers, 10 + depth);
    EXPECT_LT(error_of_sides(layers, slicing, disc), 1.1 * tolerance) << depth;
    EXPECT_GE(slicing.slices, 16) << depth;
    EXPECT_LE(slicing.slices, depth < 1 ? 48 : depth < 2 ? 90 : 160) << depth;
  }
}

TEST(SmoothTolerance, IsAShareOfTheSize) {
  EXPECT_EQ(smooth_tolerance({0, 1, 90}, 10), 10 * kSmoothTolerance);
  EXPECT_EQ(smooth_tolerance({0, 1, 90, {2, 1}}, 10), 20 * kSmoothTolerance);
  EXPECT_EQ(smooth_tolerance({0, 100, 90}, 10), 50 * kSmoothTolerance);
}

TEST(SmoothSlicing, HasFewerCornersWhereTheFigureBendsSmoothly) {
  const TwistedLayers layers{0, 40, 30};
  const Slicing slicing = smooth_slicing(layers, 3, {circle_polygon({{0, 0}, 10}, 360)});
  EXPECT_LE(slicing.outline.front().size(), 144u);
  EXPECT_GE(slicing.outline.front().size(), 24u);
}

TEST(SmoothSlicing, OfAThreadWithCornersIsOpenScads) {
  const Slicing slicing = smooth_slicing({0, 1, 360}, 30, square(5));
  EXPECT_EQ(slicing.slices, 30);
  EXPECT_EQ(slicing.outline, square(5));
  EXPECT_EQ(slicing.offsets.front(), 0u);
}

TEST(SlicedMesh, IsClosed) {
  const Polygon hole{{1, 1}, {1, 2}, {2, 2}, {2, 1}};
  const Polygon neighbour{{5, 5}, {7, 5}, {7, 7}};  // shares a corner with the square
  for (const Vec2& scale : {Vec2(1, 1), Vec2(2, 0.5), Vec2(0, 1), Vec2(1, 0), Vec2(0, 0)}) {
    const TwistedLayers layers{-1, 3, 77, scale};
    SimplePolygons outline = square(5);
    outline.push_back(hole);
    outline.push_back(neighbour);
    outline.push_back(circle_polygon({{20, 1}, 3}, 61));
    for (const Slicing& slicing :
         {openscad_slicing(3, 11, outline), openscad_slicing(1, {}, outline),
          smooth_slicing(layers, 4, outline)}) {
      const csgcore::Primitive mesh = sliced_mesh(layers, slicing);
      EXPECT_TRUE(mesh.mesh()->is_closed()) << scale.x << ' ' << scale.y;
      EXPECT_TRUE(csgcore::is_valid(mesh));
    }
  }
}

TEST(SlicedMesh, OfARoundThreadIsClosed) {
  const TwistedLayers layers{0, 2, 800};
  const Slicing slicing = smooth_slicing(layers, 4, {circle_polygon({{1, 0}, 10}, 90)});
  EXPECT_NE(slicing.offsets.front(), 0u);
  EXPECT_TRUE(sliced_mesh(layers, slicing).mesh()->is_closed());
}

TEST(SlicedBox, IsThatOfAllLayers) {
  const csgcore::Box box = sliced_box({0, 10, 180}, 2, square(1));
  EXPECT_EQ(box.min, csgcore::Vec3(-1, -1, 0));
  EXPECT_EQ(box.max, csgcore::Vec3(1, 1, 10));
}

}  // namespace
}  // namespace frontend
