#include "meshes/triangulation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include "meshes/planar_predicates.hpp"

namespace frontend {
namespace {

using glm::dvec2;
using Triangle = std::array<uint32_t, 3>;
using ::testing::ElementsAre;
using ::testing::SizeIs;
using ::testing::UnorderedElementsAre;

std::vector<uint32_t> numbered(size_t count) {
  std::vector<uint32_t> numbers(count);
  for (uint32_t i = 0; i < count; ++i) numbers[i] = i;
  return numbers;
}

/// The triangles, each from its least corner on.
std::vector<Triangle> triangles_of(const std::vector<dvec2>& places,
                                   const std::vector<uint32_t>& corners) {
  std::vector<Triangle> triangles;
  triangulate(corners, places, triangles);
  for (Triangle& t : triangles)
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return triangles;
}
std::vector<Triangle> triangles_of(const std::vector<dvec2>& places) {
  return triangles_of(places, numbered(places.size()));
}

double area_of(const dvec2& a, const dvec2& b, const dvec2& c) {
  return ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) / 2;
}

/// Edges that the triangles pass in one direction only, and how much more often.
std::map<std::pair<uint32_t, uint32_t>, int> open_edges(const std::vector<Triangle>& triangles) {
  std::map<std::pair<uint32_t, uint32_t>, int> counts;
  for (const Triangle& t : triangles) {
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t a = t[k], b = t[(k + 1) % 3];
      counts[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
  }
  std::erase_if(counts, [](const auto& entry) { return entry.second == 0; });
  return counts;
}

std::map<std::pair<uint32_t, uint32_t>, int> edges_of(const std::vector<uint32_t>& corners) {
  std::map<std::pair<uint32_t, uint32_t>, int> counts;
  for (size_t i = 0; i < corners.size(); ++i) {
    const uint32_t a = corners[i], b = corners[(i + 1) % corners.size()];
    counts[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
  }
  std::erase_if(counts, [](const auto& entry) { return entry.second == 0; });
  return counts;
}

/// Checks that the triangles bound what the polygon bounds, and returns them. `overlap` where the
/// polygon is no sum of areas that it runs around counterclockwise.
std::vector<Triangle> checked(const std::vector<dvec2>& places,
                              const std::vector<uint32_t>& corners, bool overlap = false) {
  const std::vector<Triangle> triangles = triangles_of(places, corners);
  EXPECT_EQ(open_edges(triangles), edges_of(corners));
  std::map<uint32_t, dvec2> place_of;
  for (size_t i = 0; i < corners.size(); ++i) place_of[corners[i]] = places[i];
  for (const Triangle& t : triangles) {
    if (overlap) break;
    EXPECT_GT(area_of(place_of[t[0]], place_of[t[1]], place_of[t[2]]), 0);
  }
  return triangles;
}

TEST(Triangulate, ASquareHasNoDiagonalFromItsLeastCorner) {
  const std::vector<dvec2> square{{0, 0}, {4, 0}, {4, 4}, {0, 4}};
  for (size_t start = 0; start < 4; ++start) {
    std::vector<uint32_t> corners = numbered(4);
    std::vector<dvec2> places = square;
    std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(start),
                corners.end());
    std::rotate(places.begin(), places.begin() + static_cast<std::ptrdiff_t>(start), places.end());
    EXPECT_THAT(triangles_of(places, corners),
                UnorderedElementsAre(Triangle{0, 1, 3}, Triangle{1, 2, 3}))
        << start;
  }
}

TEST(Triangulate, AQuadrilateralHasDelaunaysDiagonal) {
  EXPECT_THAT(triangles_of({{0, 0}, {9, 1}, {10, 5}, {1, 4}}),
              UnorderedElementsAre(Triangle{0, 1, 3}, Triangle{1, 2, 3}));
  EXPECT_THAT(triangles_of({{0, 0}, {4, -2}, {5, 0}, {4, 3}}),
              UnorderedElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}));
  EXPECT_THAT(triangles_of({{0, 0}, {2, -3}, {4, 0}, {2, 3}}),
              UnorderedElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}));
}

TEST(Triangulate, ADentedQuadrilateralIsCutAtItsDent) {
  for (const double dent : {-1.0, 0.0}) {  // also a corner on a straight side
    EXPECT_THAT(triangles_of({{-2, 0}, {0, -dent}, {2, 0}, {0, 5}}),
                UnorderedElementsAre(Triangle{0, 1, 3}, Triangle{1, 2, 3}));
  }
}

/// Found by OpenSCAD 2021.01, which wrote these faces as STL.
TEST(Triangulate, GivesOpenScadsTriangles) {
  EXPECT_THAT(triangles_of({{0, 0}, {6, 0}, {6, 2}, {2, 2}, {2, 6}, {0, 6}}),
              UnorderedElementsAre(Triangle{0, 1, 3}, Triangle{1, 2, 3}, Triangle{0, 3, 5},
                                   Triangle{3, 4, 5}));
}

TEST(Triangulate, StarsOfAnyShape) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0, 1);
  for (int round = 0; round < 500; ++round) {
    const size_t count = 5 + random() % 60;
    std::vector<double> angles(count);
    for (double& angle : angles) angle = 2 * M_PI * share(random);
    std::sort(angles.begin(), angles.end());
    double widest = angles.front() + 2 * M_PI - angles.back();
    for (size_t i = 1; i < count; ++i) widest = std::max(widest, angles[i] - angles[i - 1]);
    if (widest > 3) continue;
    std::vector<dvec2> places;
    double area = 0;
    for (const double angle : angles) {
      const double radius = 0.1 + share(random);
      places.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    for (size_t i = 0; i < count; ++i) {
      area += area_of({0, 0}, places[i], places[(i + 1) % count]);
    }
    const std::vector<Triangle> triangles = checked(places, numbered(count));
    ASSERT_THAT(triangles, SizeIs(count - 2));
    double sum = 0;
    for (const Triangle& t : triangles) sum += area_of(places[t[0]], places[t[1]], places[t[2]]);
    EXPECT_NEAR(sum, area, 1e-12);
    // No corner is within the circle of a triangle that could be flipped.
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> opposite;
    for (const Triangle& t : triangles) {
      for (size_t k = 0; k < 3; ++k) opposite[{t[k], t[(k + 1) % 3]}] = t[(k + 2) % 3];
    }
    for (const auto& [edge, near] : opposite) {
      const auto far = opposite.find({edge.second, edge.first});
      if (far == opposite.end()) continue;
      EXPECT_LE(
          in_circle(places[edge.first], places[edge.second], places[near], places[far->second]), 0);
    }
  }
}

TEST(Triangulate, DoesNotDependOnTheFirstCorner) {
  std::vector<dvec2> places;
  for (int i = 0; i < 24; ++i) {  // a grid's outline, with many corners on lines and circles
    const int side = i / 6, along = i % 6;
    const std::array<dvec2, 4> starts{{{0, 0}, {6, 0}, {6, 6}, {0, 6}}};
    const std::array<dvec2, 4> steps{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
    places.push_back(starts[static_cast<size_t>(side)] +
                     static_cast<double>(along) * steps[static_cast<size_t>(side)]);
  }
  std::vector<uint32_t> corners = numbered(24);
  std::set<std::set<Triangle>> results;
  for (int i = 0; i < 24; ++i) {
    const std::vector<Triangle> triangles = checked(places, corners);
    results.insert({triangles.begin(), triangles.end()});
    std::rotate(corners.begin(), corners.begin() + 1, corners.end());
    std::rotate(places.begin(), places.begin() + 1, places.end());
  }
  EXPECT_THAT(results, SizeIs(1));
  EXPECT_THAT(*results.begin(), SizeIs(22));
}

TEST(Triangulate, OfCornersOnACircleTheLeastIsAnEar) {
  const std::vector<dvec2> places{{-5, 0}, {-4, -3}, {-3, -4}, {5, 0}, {0, 5}};
  const std::vector<Triangle> triangles = checked(places, numbered(5));
  const auto count_of = [&](uint32_t corner) {
    return std::ranges::count_if(
        triangles, [&](const Triangle& t) { return std::ranges::count(t, corner) > 0; });
  };
  EXPECT_EQ(count_of(0), 1);
  EXPECT_EQ(count_of(1), 2) << "an ear of what is left";
}

TEST(Triangulate, AHoleBehindABridge) {
  // A square of 6 with a hole of 2, whose bridge is an edge there and back.
  const std::vector<dvec2> places{{0, 0}, {6, 0}, {6, 6}, {0, 6}, {0, 0},
                                  {2, 2}, {2, 4}, {4, 4}, {4, 2}, {2, 2}};
  const std::vector<uint32_t> corners{0, 1, 2, 3, 0, 4, 5, 6, 7, 4};
  const std::vector<Triangle> triangles = checked(places, corners);
  EXPECT_THAT(triangles, SizeIs(8));
}

TEST(Triangulate, PartsThatTouchInACorner) {
  const std::vector<dvec2> places{{0, 0}, {2, 0}, {2, 2}, {4, 2}, {4, 4}, {2, 4}, {2, 2}, {0, 2}};
  EXPECT_THAT(checked(places, {0, 1, 2, 3, 4, 5, 2, 6}), SizeIs(4));
  // The second part runs the other way.
  const std::vector<dvec2> eight{{0, 0}, {2, 0}, {2, 2}, {2, 4}, {4, 4}, {4, 2}, {2, 2}, {0, 2}};
  EXPECT_THAT(checked(eight, {0, 1, 2, 3, 4, 5, 2, 6}, true), SizeIs(4));
}

TEST(Triangulate, WhatCrossesItselfIsAFan) {
  const std::vector<dvec2> bow_tie{{0, 0}, {4, 4}, {4, 0}, {0, 4}};
  EXPECT_THAT(checked(bow_tie, numbered(4), true),
              ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}));
  // A corner lies on another edge; two vertices are at one place; all lie on a line.
  checked({{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}, numbered(5), true);
  checked({{0, 0}, {4, 0}, {4, 4}, {0, 0}, {0, 4}}, numbered(5), true);
  checked({{0, 0}, {1, 1}, {2, 2}, {3, 3}, {4, 4}}, numbered(5), true);
}

TEST(Triangulate, TakesFewStepsForEachCorner) {
  // A comb, whose teeth all see one another; a circle.
  for (const bool is_comb : {true, false}) {
    std::vector<dvec2> places;
    constexpr int kCorners = 20000;
    for (int i = 0; i < kCorners; ++i) {
      const double angle = 2 * M_PI * i / kCorners;
      const double radius = is_comb && i % 2 == 1 ? 0.5 : 1;
      places.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    EXPECT_THAT(checked(places, numbered(places.size()), is_comb), SizeIs(kCorners - 2));
  }
}

TEST(Orientation, IsExact) {
  // Points next to a line, where the rounded determinant is 0.
  const dvec2 a{12, 12}, b{24, 24};
  for (int i = 1; i < 100; ++i) {
    const double x = 0.5 + i * 0x1p-53;
    EXPECT_EQ(orientation({x, 0.5}, a, b), x > 0.5 ? -1 : 0) << i;
    EXPECT_EQ(orientation({0.5, x}, a, b), x > 0.5 ? 1 : 0) << i;
  }
  EXPECT_EQ(orientation({0.1, 0.1}, {0.2, 0.2}, {0.7, 0.7}), 0);
}

TEST(TriangulateAll, LeavesOutHoles) {
  const std::vector<dvec2> places{{0, 0}, {8, 0}, {8, 8}, {0, 8}, {2, 2}, {2, 5}, {5, 5}, {5, 2}};
  const std::vector<uint32_t> ends{4, 8};
  std::vector<Triangle> triangles;
  triangulate_all(numbered(places.size()), ends, places, triangles);
  double area = 0;
  for (const Triangle& t : triangles) {
    const double own = area_of(places[t[0]], places[t[1]], places[t[2]]);
    EXPECT_GT(own, 0);
    area += own;
  }
  EXPECT_EQ(area, 64 - 9);
  auto edges = edges_of({0, 1, 2, 3});
  edges.merge(edges_of({4, 5, 6, 7}));
  EXPECT_EQ(open_edges(triangles), edges);
}

}  // namespace
}  // namespace frontend
