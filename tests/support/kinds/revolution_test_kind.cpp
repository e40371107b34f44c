// The test kind of the revolution.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "kinds/povray_text.hpp"
#include "kinds/profile_solid.hpp"
#include "kinds/test_kind.hpp"
#include "test_profiles.hpp"

namespace test_support {
namespace {

using csgcore::LongVec3;
using csgcore::Primitive;
using csgcore::Real;
using csgcore::Vec3;
using csgcore::reference::LongVec2;
using csgcore::reference::RevolutionSolid;
using csgcore::reference::Span;

Primitive revolved(ProfileLoop loop) {
  return csgcore::make_revolution(profile_of({std::move(loop)}));
}

constexpr Variant kVariants[] = {
    {"RevolvedRectangle",
     [](Sizes& sizes) {
       const double inner = sizes.length(), width = sizes.length(), height = sizes.length();
       return revolved(rectangle_loop({0.5 * inner, -height}, {0.5 * inner + width, height}));
     }},
    {"RevolvedTriangle",
     [](Sizes& sizes) {
       const double radius = sizes.length(), height = sizes.length();
       return revolved(polygon_loop({{0, -height}, {radius, 0.25 * height}, {0, height}}));
     }},
    {"RevolvedCircle",
     [](Sizes& sizes) {
       const double radius = sizes.length();
       return revolved(circle_loop({1.25 * radius, 0}, 0.5 * radius));
     }},
    {"RevolvedRounded",
     [](Sizes& sizes) {
       const double radius = sizes.length(), height = sizes.length();
       return revolved(rounded_loop({0.5 * radius, -height}, {2 * radius, height},
                                    0.25 * std::min(radius, height)));
     }},
    {"RevolvedGlyph",
     [](Sizes& sizes) {
       const double a = sizes.length();
       return revolved(glyph_loop({a * Vec2(0.5, -1), a * Vec2(1.5, -0.75), a * Vec2(1, 0),
                                   a * Vec2(1.75, 1), a * Vec2(0.5, 0.75)}));
     }},
    // A vase about the axis, of lines, an arc and a Bézier curve.
    {"RevolvedVase",
     [](Sizes& sizes) {
       using csgcore::ProfileEdge;
       const double a = sizes.length();
       return revolved(
           {{.end = a * Vec2(0, -1)},
            {.end = a * Vec2(0.75, -1)},
            {.kind = ProfileEdge::Kind::kBezier,
             .end = a * Vec2(0.5, 0.5),
             .control = a * Vec2(1.25, 0)},
            {.kind = ProfileEdge::Kind::kArc, .end = a * Vec2(0, 1), .control = a * Vec2(0, 0.5)}});
     }},
};

class RevolutionTestKind final : public TestKind {
 public:
  std::span<const Variant> variants() const override { return kVariants; }
  bool is_told_tightly() const override { return false; }

  bool holds(const Primitive& p, const Vec3& point) const override {
    return RevolutionSolid(p).contains(LongVec3(point));
  }
  Vec3 surface_point(const Primitive& p, std::mt19937& random) const override {
    const LongVec2 place = RevolutionSolid(p).figure().edge_point(random, true);
    const double angle = std::uniform_real_distribution<double>(0, 2 * std::numbers::pi)(random);
    return {double(place.x) * std::cos(angle), double(place.x) * std::sin(angle), double(place.y)};
  }
  Vec3 core(const Primitive& p, const Vec3& surface_point) const override {
    return RevolutionSolid(p).core(surface_point);
  }

  LongVec3 middle(const Primitive& p) const override { return {0, 0, p.profile()->center().y}; }
  Real reach_world(const Primitive& p) const override {
    const csgcore::reference::Figure figure(*p.profile());
    const csgcore::Mat3& linear = p.local_to_world.linear;
    return figure.max().x * (glm::length(LongVec3(linear[0])) + glm::length(LongVec3(linear[1]))) +
           (figure.max().y - figure.min().y) * glm::length(LongVec3(linear[2]));
  }
  std::vector<Side> sides(const Primitive& p, const LongVec3& point) const override {
    return RevolutionSolid(p).sides(point);
  }

  std::unique_ptr<const csgcore::reference::LocalSolid> solid(const Primitive& p) const override {
    return std::make_unique<RevolutionSolid>(p);
  }
  double furthest(const Primitive& p, const Vec3& direction) const override {
    const csgcore::reference::Figure figure(*p.profile());
    return double(figure.furthest({std::hypot(direction.x, direction.y), direction.z}));
  }

  /// The z axis need not be inside: these are the figure's.
  Heights heights(const Primitive& p) const override {
    const csgcore::reference::Figure figure(*p.profile());
    return {double(figure.min().y), double(figure.max().y)};
  }
  Vec3 on_surface(const Primitive& p, const Vec3& sideways, double height) const override {
    const Vec3 on_axis{0, 0, height};
    if (glm::length(sideways) == 0) return on_axis;
    std::vector<Span> spans;
    RevolutionSolid(p).add_spans({LongVec3(on_axis), LongVec3(glm::normalize(sideways))}, 0, spans);
    return spans.empty() ? on_axis : on_axis + double(spans.back().end) * sideways;
  }

  /// POV-Ray revolves about y.
  std::string as_povray(const Primitive& p) const override {
    return "lathe { linear_spline " + povray::figure(*p.profile(), 1) +
           " matrix <1,0,0, 0,0,1, 0,1,0, 0,0,0>";
  }
};

constexpr RevolutionTestKind kTestKind;

}  // namespace

constinit const TestKind& Revolution_test_kind = kTestKind;

}  // namespace test_support
