#include "kinds/test_kind.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <ostream>
#include <stdexcept>

namespace test_support {

using csgcore::Affine;
using csgcore::Primitive;
using csgcore::Vec3;

// Each kind's own file defines its test kind.
#define TEST_SUPPORT_DECLARE(Name) extern const TestKind& Name##_test_kind;
CSGCORE_FOR_EACH_SHAPE(TEST_SUPPORT_DECLARE)
#undef TEST_SUPPORT_DECLARE

const TestKind& test_kind_of(csgcore::Shape shape) {
  switch (shape) {
#define TEST_SUPPORT_CASE(Name) \
  case csgcore::Shape::k##Name: \
    return Name##_test_kind;
    CSGCORE_FOR_EACH_SHAPE(TEST_SUPPORT_CASE)
#undef TEST_SUPPORT_CASE
  }
  throw std::logic_error("a shape that is none");
}

Vec3 TestKind::upwards(const Primitive& primitive, const Vec3& sideways, const Vec3&) const {
  const auto [low, high] = heights(primitive);
  return on_surface(primitive, sideways, high) - on_surface(primitive, sideways, low);
}

std::optional<double> TestKind::apex(const Primitive&) const { return std::nullopt; }

std::optional<FacetedSolid> TestKind::faceted(const Primitive&, int) const { return std::nullopt; }

double Sizes::length() {
  const double length = uniform(range_.low, range_.high);
  if (!by_chance(range_.even_share)) return length;
  return std::clamp(range_.step * std::round(length / range_.step), range_.low, range_.high);
}

namespace {

std::vector<Variant> variants_of(bool only_convex) {
  std::vector<Variant> all;
  for (const csgcore::Shape shape : kAllShapes) {
    if (only_convex && !csgcore::is_convex(shape)) continue;
    const std::span<const Variant> some = test_kind_of(shape).variants();
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

}  // namespace

const std::vector<Variant>& all_variants() {
  static const std::vector<Variant> variants = variants_of(false);
  return variants;
}

const std::vector<Variant>& convex_variants() {
  static const std::vector<Variant> variants = variants_of(true);
  return variants;
}

void PrintTo(const Variant& variant, std::ostream* out) { *out << variant.name; }

Primitive random_primitive(const TestKind& kind, Sizes& sizes, const Affine& local_to_world) {
  const std::span<const Variant> variants = kind.variants();
  Primitive primitive = variants[sizes.random()() % variants.size()].make(sizes);
  primitive.local_to_world = local_to_world;
  return primitive;
}

Primitive random_primitive(Sizes& sizes, const Affine& local_to_world) {
  const csgcore::Shape shape = kAllShapes[sizes.random()() % std::size(kAllShapes)];
  return random_primitive(test_kind_of(shape), sizes, local_to_world);
}

namespace {

Vec3 to_local(const Primitive& primitive, const Vec3& point_world) {
  const Affine& map = primitive.local_to_world;
  return glm::inverse(map.linear) * (point_world - map.translation);
}

}  // namespace

bool holds(const Primitive& primitive, const Vec3& point_world) {
  return test_kind_of(primitive.shape()).holds(primitive, to_local(primitive, point_world));
}

Vec3 surface_point(const Primitive& primitive, std::mt19937& random) {
  const Vec3 local = test_kind_of(primitive.shape()).surface_point(primitive, random);
  return primitive.local_to_world.point(local);
}

Vec3 core_of(const Primitive& primitive, const Vec3& surface_world) {
  const TestKind& kind = test_kind_of(primitive.shape());
  return primitive.local_to_world.point(kind.core(primitive, to_local(primitive, surface_world)));
}

Vec3 random_direction(std::mt19937& random) {
  std::uniform_real_distribution<double> coordinate(-1, 1);
  for (;;) {
    const double x = coordinate(random), y = coordinate(random), z = coordinate(random);
    const Vec3 v{x, y, z};
    const double length = glm::length(v);
    if (length > 0.1 && length < 1) return v / length;
  }
}

}  // namespace test_support
