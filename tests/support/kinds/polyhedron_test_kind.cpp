// The test kind of the convex polyhedron.
#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

#include "csgcore/polyhedron.hpp"
#include "kinds/povray_text.hpp"
#include "kinds/test_kind.hpp"
#include "models.hpp"

namespace test_support {
namespace {

using csgcore::HalfSpace;
using csgcore::LongVec3;
using csgcore::Polyhedron;
using csgcore::Primitive;
using csgcore::Real;
using csgcore::Vec3;
using csgcore::reference::ConvexSolid;
using csgcore::reference::LocalSolid;
using csgcore::reference::NearRay;
using csgcore::reference::Span;
using csgcore::reference::Surface;

class PolyhedronSolid final : public ConvexSolid {
 public:
  explicit PolyhedronSolid(const Primitive& primitive)
      : polyhedron_(primitive.as<csgcore::PolyhedronShape>().polyhedron) {}

  Span span(const NearRay& ray) const override {
    constexpr Real kInfinity = std::numeric_limits<Real>::infinity();
    Span span{-kInfinity, kInfinity};
    const std::vector<HalfSpace>& faces = polyhedron_->half_spaces();
    for (size_t i = 0; i < faces.size(); ++i) {
      const LongVec3 normal(faces[i].normal);
      const Real room = Real(faces[i].offset) - glm::dot(normal, ray.origin);
      const Real ascent = glm::dot(normal, ray.direction);
      if (ascent == 0 && room < 0) return {};
      const Real t = room / ascent;
      if (ascent < 0 && t > span.begin) span.begin = t, span.begin_surface = Surface(i);
      if (ascent > 0 && t < span.end) span.end = t, span.end_surface = Surface(i);
    }
    return span;
  }
  LongVec3 normal(const LongVec3&, Surface surface) const override {
    return LongVec3(polyhedron_->half_spaces()[uint32_t(surface)].normal);
  }

 private:
  const std::shared_ptr<const Polyhedron> polyhedron_;
};

Primitive frustum(Sizes& sizes, double r_bottom, double r_top) {
  const double bottom = -sizes.length(), top = sizes.length();
  return csgcore::make_polyhedron(
      Polyhedron::frustum(bottom, top, r_bottom, r_top, sizes.fragments()));
}

constexpr Variant kVariants[] = {
    {"Box",
     [](Sizes& sizes) {
       Vec3 low, high;
       for (int axis = 0; axis < 3; ++axis) low[axis] = -sizes.length();
       for (int axis = 0; axis < 3; ++axis) high[axis] = sizes.length();
       return csgcore::make_polyhedron(Polyhedron::box({low, high}));
     }},
    {"Octahedron",
     [](Sizes& sizes) { return csgcore::make_polyhedron(octahedron(sizes.length())); }},
    {"Prism",
     [](Sizes& sizes) {
       const double radius = sizes.length();
       return frustum(sizes, radius, radius);
     }},
    {"Pyramid",
     [](Sizes& sizes) {
       const double radius = sizes.length();
       return sizes.by_chance(0.5) ? frustum(sizes, radius, 0) : frustum(sizes, 0, radius);
     }},
    {"FacetedFrustum",
     [](Sizes& sizes) {
       const double r_bottom = sizes.length();
       return frustum(sizes, r_bottom, sizes.length());
     }},
    {"FacetedSphere", [](Sizes& sizes) {
       const double radius = sizes.length();
       return csgcore::make_polyhedron(Polyhedron::sphere(radius, sizes.fragments()));
     }}};

/// Returns how far the point can move along a direction before it leaves a half-space.
double room_along(std::span<const HalfSpace> half_spaces, const Vec3& point,
                  const Vec3& direction) {
  double room = std::numeric_limits<double>::infinity();
  for (const HalfSpace& half_space : half_spaces) {
    const double growth = glm::dot(half_space.normal, direction);
    if (growth <= 0) continue;
    room = std::min(room, (half_space.offset - glm::dot(half_space.normal, point)) / growth);
  }
  return room;
}

/// Bounds in POV-Ray reach beyond the rounded vertices by this share of the polyhedron's size.
constexpr double kBoundsMargin = 1e-6;

class PolyhedronTestKind final : public TestKind {
 public:
  std::span<const Variant> variants() const override { return kVariants; }

  bool holds(const Primitive& p, const Vec3& point) const override {
    const std::vector<HalfSpace>& half_spaces = p.polyhedron()->half_spaces();
    return std::all_of(half_spaces.begin(), half_spaces.end(), [&](const HalfSpace& half_space) {
      return glm::dot(half_space.normal, point) <= half_space.offset;
    });
  }
  Vec3 surface_point(const Primitive& p, std::mt19937& random) const override {
    const std::vector<Vec3>& vertices = p.polyhedron()->vertices();
    if (random() % 3 == 0) return vertices[random() % vertices.size()];
    const Vec3 direction = random_direction(random);
    const Vec3& middle = p.polyhedron()->canonical().center;
    return middle + room_along(p.polyhedron()->half_spaces(), middle, direction) * direction;
  }
  Vec3 core(const Primitive& p, const Vec3&) const override {
    return p.polyhedron()->canonical().center;
  }

  LongVec3 middle(const Primitive& p) const override {
    return LongVec3(p.polyhedron()->canonical().center);
  }
  Real reach_world(const Primitive& p) const override {
    const glm::mat<3, 3, Real> linear(p.local_to_world.linear);
    Real reach = 0;
    for (const Vec3& vertex : p.polyhedron()->vertices()) {
      reach = std::max(reach, glm::length(linear * (LongVec3(vertex) - middle(p))));
    }
    return reach;
  }
  std::vector<Side> sides(const Primitive& p, const LongVec3& point) const override {
    std::vector<Side> faces;
    faces.reserve(p.polyhedron()->half_spaces().size());
    for (const HalfSpace& half_space : p.polyhedron()->half_spaces()) {
      const LongVec3 normal(half_space.normal);
      faces.push_back({glm::dot(normal, point) - half_space.offset, normal});
    }
    return faces;
  }

  std::unique_ptr<const LocalSolid> solid(const Primitive& p) const override {
    return std::make_unique<PolyhedronSolid>(p);
  }
  double furthest(const Primitive& p, const Vec3& direction) const override {
    double most = -std::numeric_limits<double>::infinity();
    for (const Vec3& v : p.polyhedron()->vertices()) most = std::max(most, glm::dot(direction, v));
    return most;
  }

  Heights heights(const Primitive& p) const override {
    csgcore::Box box;
    for (const Vec3& vertex : p.polyhedron()->vertices()) box.merge(vertex);
    return {box.min.z, box.max.z};
  }
  Vec3 on_surface(const Primitive& p, const Vec3& sideways, double height) const override {
    const Vec3 on_axis{0, 0, height};
    if (glm::length(sideways) == 0) return on_axis;
    const Vec3 direction = glm::normalize(sideways);
    return on_axis + room_along(p.polyhedron()->half_spaces(), on_axis, direction) * sideways;
  }

  /// A face is a plane, whose inside is what lies behind it. POV-Ray does not see that they are
  /// bounded.
  std::string as_povray(const Primitive& p) const override {
    csgcore::Box box;
    for (const Vec3& vertex : p.polyhedron()->vertices()) box.merge(vertex);
    const Vec3 margin(kBoundsMargin * box.diagonal());
    std::string text = "intersection {";
    for (const HalfSpace& half_space : p.polyhedron()->half_spaces()) {
      const double length = glm::length(half_space.normal);
      text += " plane { " + povray::vector(half_space.normal / length) + "," +
              povray::number(half_space.offset / length) + " }";
    }
    return text + " bounded_by { box { " + povray::vector(box.min - margin) + "," +
           povray::vector(box.max + margin) + " } }";
  }
};

constexpr PolyhedronTestKind kTestKind;

}  // namespace

constinit const TestKind& Polyhedron_test_kind = kTestKind;

}  // namespace test_support
