// Tests the traits of every kind of primitive, against the solid itself and the defaults.
#include "base/primitive_traits.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <vector>

#include "csgcore/canonical_primitive.hpp"
#include "csgcore/polyhedron.hpp"
#include "support/kinds/test_kind.hpp"

namespace frontend {
namespace {

using csgcore::Box;
using csgcore::Primitive;
using csgcore::Vec3;

constexpr double kRounding = 1e-12;  // the solids below are of size 1 to 10

class Defaults final : public PrimitiveTraits {};

/// Some of each variant of each kind.
std::vector<Primitive> samples() {
  std::mt19937 random(1);
  test_support::Sizes sizes(random, {.low = 0.5, .high = 3, .most_fragments = 12});
  std::vector<Primitive> primitives;
  for (const test_support::Variant& variant : test_support::all_variants()) {
    for (int i = 0; i < 3; ++i) primitives.push_back(variant.make(sizes));
  }
  return primitives;
}

bool holds(const Primitive& primitive, const Vec3& point) {
  return csgcore::contains(csgcore::canonicalize(primitive), point);
}

void expect_same(const Vec3& a, const Vec3& b, double tolerance = kRounding) {
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(a[axis], b[axis], tolerance);
}

TEST(PrimitiveTraits, SizesAreTheSolids) {
  const Defaults defaults;
  for (const Primitive& primitive : samples()) {
    const PrimitiveTraits& traits = traits_of(primitive.shape());
    const double extent = defaults.extent(primitive);
    EXPECT_GE(traits.extent(primitive), extent * (1 - kRounding));
    EXPECT_LE(traits.extent(primitive), 2 * extent);
    const csgcore::FacetSettings fine{.fn = 10000};
    const Box box = traits.faceted_box(primitive, fine);
    expect_same(box.min, defaults.faceted_box(primitive, fine).min, 1e-6);
    expect_same(box.max, defaults.faceted_box(primitive, fine).max, 1e-6);
  }
}

TEST(PrimitiveTraits, DefaultsDoNotDependOnTheMatrix) {
  const Defaults defaults;
  Primitive primitive = csgcore::make_sphere(2);
  primitive.local_to_world.linear = csgcore::Mat3(0.0);  // not valid
  primitive.local_to_world.translation = Vec3(1e300);
  EXPECT_EQ(defaults.extent(primitive), 2);
  expect_same(defaults.faceted_box(primitive, {}).max, Vec3(2));
}

TEST(PrimitiveTraits, FacetsHaveTheFacetedBox) {
  for (const Primitive& primitive : samples()) {
    const PrimitiveTraits& traits = traits_of(primitive.shape());
    for (const int fragments : {3, 4, 5, 6, 7, 30}) {
      const auto faceted = csgcore::faceted_polyhedron(primitive, fragments);
      if (!faceted) continue;
      Box box;
      for (const Vec3& vertex : faceted->vertices()) box.merge(vertex);
      const csgcore::FacetSettings settings{.fn = double(fragments)};
      expect_same(traits.faceted_box(primitive, settings).min, box.min);
      expect_same(traits.faceted_box(primitive, settings).max, box.max);
    }
  }
}

TEST(PrimitiveTraits, MeshesAreThoseOfTheFacets) {
  for (const Primitive& primitive : samples()) {
    const csgcore::Mesh mesh = csgcore::faceted_mesh(primitive, 9);
    const auto expected = test_support::test_kind_of(primitive.shape()).faceted(primitive, 9);
    EXPECT_EQ(mesh.vertices, expected ? expected->mesh.vertices : std::vector<Vec3>{});
    EXPECT_EQ(mesh.faces.size(), expected ? expected->mesh.faces.size() : 0);
  }
}

TEST(PrimitiveTraits, FacetsAreThoseOfTheUnit) {
  for (const Primitive& primitive : samples()) {
    const PrimitiveTraits& traits = traits_of(primitive.shape());
    if (traits.fragments(primitive, {}) == 0) continue;
    EXPECT_EQ(traits.fragments(primitive, {.fn = 7}), 7);
    for (const int fragments : {3, 6, 11}) {
      const Faceting faceting = traits.faceting(primitive, fragments);
      const auto unit = csgcore::faceted_polyhedron(faceting.unit, fragments);
      const auto faceted = csgcore::faceted_polyhedron(primitive, fragments);
      ASSERT_TRUE(unit && faceted);
      EXPECT_GE(faceting.faces, faceted->half_spaces().size());
      ASSERT_EQ(unit->vertices().size(), faceted->vertices().size());
      for (size_t i = 0; i < unit->vertices().size(); ++i) {
        expect_same(faceting.origin + faceting.size * unit->vertices()[i], faceted->vertices()[i]);
      }
    }
  }
}

TEST(PrimitiveTraits, FacetsOfOneSizeAreTheSameUnits) {
  const auto unit_of = [](const Primitive& primitive) {
    return traits_of(primitive.shape()).faceting(primitive, 6).unit.solid;
  };
  EXPECT_EQ(unit_of(csgcore::make_sphere(2)), unit_of(csgcore::make_sphere(3)));
  EXPECT_EQ(unit_of(csgcore::make_frustum(0, 1, 2, 1)), unit_of(csgcore::make_frustum(3, 9, 4, 2)));
  EXPECT_NE(unit_of(csgcore::make_frustum(0, 1, 2, 1)), unit_of(csgcore::make_frustum(0, 1, 1, 2)));
}

TEST(PrimitiveTraits, PlaneFacesBoundTheSolid) {
  for (const Primitive& primitive : samples()) {
    PlaneFaces found;
    traits_of(primitive.shape()).find_plane_faces(primitive, found);
    EXPECT_LE(found.faces.size(), kMostComparedFaces);
    for (uint32_t i = 0; i < found.faces.size(); ++i) {
      const PlaneFace& face = found.faces[i];
      EXPECT_NEAR(glm::length(face.normal), 1, kRounding);
      if (face.opposite) {
        ASSERT_LT(*face.opposite, found.faces.size());
        EXPECT_TRUE(parallel(face.normal, found.faces[*face.opposite].normal));
        EXPECT_EQ(found.faces[*face.opposite].opposite, i);
      }
      if (face.corner_count == 0) continue;  // an apex
      ASSERT_GE(face.corner_count, 3u);
      for (const Vec3& corner : found.corners_of(face)) {
        EXPECT_NEAR(glm::dot(face.normal, corner - face.center), 0, kRounding);
      }
      // The middle of a mesh's face may lie beside it, but not that of a triangle.
      const auto corners = found.corners_of(face);
      const bool is_convex = csgcore::is_convex(primitive.shape());
      const Vec3 within = is_convex ? face.center : (corners[0] + corners[1] + corners[2]) / 3.0;
      const Vec3 step = 1e-6 * face.normal;
      EXPECT_NE(holds(primitive, within + step), holds(primitive, within - step));
    }
  }
}

TEST(PrimitiveTraits, WhatIsRoundStaysWhenItIsTurned) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-5, 5);
  for (const Primitive& primitive : samples()) {
    const Roundness roundness = traits_of(primitive.shape()).roundness(primitive);
    if (roundness.about == Roundness::About::kNothing) continue;
    EXPECT_LE(std::max(roundness.radii[0], roundness.radii[1]),
              traits_of(primitive.shape()).extent(primitive));
    const bool has_axis = roundness.about == Roundness::About::kAxis;
    EXPECT_EQ(has_axis, roundness.axis_z[0] != roundness.axis_z[1]);
    int inside = 0;
    for (int i = 0; i < 2000; ++i) {
      const Vec3 point(coordinate(random), coordinate(random), coordinate(random));
      // Turned into the half-plane of x, or onto its half-axis.
      const Vec3 turned = has_axis ? Vec3(std::hypot(point.x, point.y), 0, point.z)
                                   : Vec3(glm::length(point), 0, 0);
      EXPECT_EQ(holds(primitive, point), holds(primitive, turned));
      inside += holds(primitive, point);
    }
    EXPECT_GT(inside, 0);
  }
}

TEST(PrimitiveTraits, RadialPlacesAreTheSmoothSurfaces) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-5, 5);
  for (const Primitive& primitive : samples()) {
    const PrimitiveTraits& traits = traits_of(primitive.shape());
    int within = 0;
    for (int i = 0; i < 500; ++i) {
      const Vec3 point(coordinate(random), coordinate(random), coordinate(random));
      const std::optional<RadialPlace> place = traits.radial_place(primitive, point);
      EXPECT_EQ(place.has_value(), traits.fragments(primitive, {}) > 0);
      if (!place || place->height < 0 || place->height > 1) continue;
      ++within;
      EXPECT_LE(place->surface, place->largest_surface);
      const double length = glm::length(place->part);
      const auto at = [&](double share) {
        return point + (share * place->surface / length - 1) * place->part;
      };
      EXPECT_TRUE(holds(primitive, at(1 - 1e-9)));
      EXPECT_FALSE(holds(primitive, at(1 + 1e-9)));
    }
    EXPECT_EQ(within > 0, traits.fragments(primitive, {}) > 0);
  }
}

}  // namespace
}  // namespace frontend
