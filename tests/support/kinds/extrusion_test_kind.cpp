// The test kind of the extrusion.
#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "kinds/povray_text.hpp"
#include "kinds/profile_solid.hpp"
#include "kinds/test_kind.hpp"
#include "test_profiles.hpp"

namespace test_support {
namespace {

using csgcore::ExtrusionShape;
using csgcore::LongVec3;
using csgcore::Primitive;
using csgcore::Real;
using csgcore::Vec3;
using csgcore::reference::ExtrusionSolid;
using csgcore::reference::LongVec2;
using csgcore::reference::Span;

/// An extrusion of heights of both signs.
Primitive extruded(Sizes& sizes, ProfilePointer profile, double bottom = 1, double top = 1) {
  const double z_min = -sizes.length(), z_max = sizes.length();
  return csgcore::make_extrusion(std::move(profile), z_min, z_max, bottom, top);
}

ProfilePointer rounded(Sizes& sizes) {
  const double width = sizes.length(), depth = sizes.length();
  const Vec2 min(-0.5 * width, -depth), max(width, depth);
  return profile_of({rounded_loop(min, max, 0.25 * std::min(width, depth))});
}

/// A bent stroke with a hole, about the origin.
ProfilePointer glyph(Sizes& sizes) {
  const double a = sizes.length();
  return profile_of({glyph_loop({a * Vec2(-1, -1), a * Vec2(0.5, -1.25), a * Vec2(1, 0.5),
                                 a * Vec2(0.25, 0.375), a * Vec2(0, 1), a * Vec2(-1, 0.75)}),
                     glyph_loop({a * Vec2(-0.75, -0.5), a * Vec2(-0.5, 0.25),
                                 a * Vec2(-0.25, 0.125), a * Vec2(-0.25, -0.5)})});
}

ProfilePointer star(Sizes& sizes) {
  const double outer = sizes.length();
  return profile_of({star_loop({0, 0}, 5, outer, 0.4 * outer)}, FillRule::kNonZero);
}

constexpr Variant kVariants[] = {
    {"StarExtrusion", [](Sizes& sizes) { return extruded(sizes, star(sizes)); }},
    {"ExtrusionWithAHole",
     [](Sizes& sizes) {
       const double width = sizes.length(), depth = sizes.length();
       const Vec2 half(width, depth);
       return extruded(
           sizes, profile_of({rectangle_loop(-0.5 * half, half),
                              polygon_loop({0.25 * half, 0.75 * half, half * Vec2(0.25, 0.75)})}));
     }},
    {"DiscExtrusion",
     [](Sizes& sizes) {
       const double radius = sizes.length();
       return extruded(sizes, profile_of({circle_loop({0.25 * radius, 0}, radius)}));
     }},
    {"RoundedExtrusion", [](Sizes& sizes) { return extruded(sizes, rounded(sizes)); }},
    {"GlyphExtrusion", [](Sizes& sizes) { return extruded(sizes, glyph(sizes)); }},
    {"WideningExtrusion", [](Sizes& sizes) { return extruded(sizes, rounded(sizes), 0.5, 1.25); }},
    {"PointedStarExtrusion", [](Sizes& sizes) { return extruded(sizes, star(sizes), 1, 0); }},
    {"PointedGlyphExtrusion", [](Sizes& sizes) { return extruded(sizes, glyph(sizes), 0, 1); }},
};

class ExtrusionTestKind final : public TestKind {
 public:
  std::span<const Variant> variants() const override { return kVariants; }
  bool is_told_tightly() const override { return false; }

  bool holds(const Primitive& p, const Vec3& point) const override {
    return ExtrusionSolid(p).contains(LongVec3(point));
  }
  Vec3 surface_point(const Primitive& primitive, std::mt19937& random) const override {
    const auto& p = primitive.as<ExtrusionShape>();
    const ExtrusionSolid solid(primitive);
    std::uniform_real_distribution<double> height(p.z_min, p.z_max);
    double z = random() % 2 ? p.z_min : p.z_max;
    const bool is_cap = random() % 3 == 0 && (z == p.z_min ? p.scale_bottom : p.scale_top) > 0;
    const LongVec2 place =
        is_cap ? solid.figure().random_point(random) : solid.figure().edge_point(random, false);
    if (!is_cap && random() % 3 != 0) z = height(random);
    const double scale = z == p.z_max ? p.scale_top : static_cast<double>(solid.scale_at(z));
    return {scale * double(place.x), scale * double(place.y), z};
  }
  Vec3 core(const Primitive& p, const Vec3& surface_point) const override {
    return ExtrusionSolid(p).core(surface_point);
  }

  LongVec3 middle(const Primitive& primitive) const override {
    const auto& p = primitive.as<ExtrusionShape>();
    const Vec2 place = 0.5 * (p.scale_bottom + p.scale_top) * p.profile->center();
    return {place.x, place.y, 0.5 * p.z_min + 0.5 * p.z_max};
  }
  Real reach_world(const Primitive& primitive) const override {
    const auto& p = primitive.as<ExtrusionShape>();
    const glm::mat<3, 3, Real> linear(primitive.local_to_world.linear);
    const csgcore::reference::Figure figure(*p.profile);
    Real reach = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const Real scale = corner & 4 ? p.scale_top : p.scale_bottom;
      const LongVec3 point{scale * (corner & 1 ? figure.max() : figure.min()).x,
                           scale * (corner & 2 ? figure.max() : figure.min()).y,
                           corner & 4 ? p.z_max : p.z_min};
      reach = std::max(reach, glm::length(linear * (point - middle(primitive))));
    }
    return reach;
  }
  std::vector<Side> sides(const Primitive& p, const LongVec3& point) const override {
    return ExtrusionSolid(p).sides(point);
  }

  std::unique_ptr<const csgcore::reference::LocalSolid> solid(const Primitive& p) const override {
    return std::make_unique<ExtrusionSolid>(p);
  }
  double furthest(const Primitive& primitive, const Vec3& direction) const override {
    const auto& p = primitive.as<ExtrusionShape>();
    const csgcore::reference::Figure figure(*p.profile);
    const double lateral = double(figure.furthest({direction.x, direction.y}));
    return std::max(p.scale_bottom * lateral + p.z_min * direction.z,
                    p.scale_top * lateral + p.z_max * direction.z);
  }

  Heights heights(const Primitive& primitive) const override {
    const auto& p = primitive.as<ExtrusionShape>();
    return {p.z_min, p.z_max};
  }
  Vec3 on_surface(const Primitive& p, const Vec3& sideways, double height) const override {
    const Vec3 on_axis{0, 0, height};
    if (glm::length(sideways) == 0) return on_axis;
    std::vector<Span> spans;
    ExtrusionSolid(p).add_spans({LongVec3(on_axis), LongVec3(glm::normalize(sideways))}, 0, spans);
    for (const Span& span : spans) {
      if (span.end >= 0) return on_axis + double(span.end) * sideways;
    }
    return on_axis;
  }

  /// POV-Ray sweeps along y, and a cone's prism from scale 0 at y = 0.
  std::string as_povray(const Primitive& primitive) const override {
    const auto& p = primitive.as<ExtrusionShape>();
    const bool is_prism = p.scale_bottom == p.scale_top;
    const double from = is_prism ? p.z_min : std::min(p.scale_bottom, p.scale_top);
    const double to = is_prism ? p.z_max : std::max(p.scale_bottom, p.scale_top);
    const double scale = is_prism ? p.scale_bottom : 1;
    const double steepness = is_prism ? 1 : (p.z_max - p.z_min) / (p.scale_top - p.scale_bottom);
    const double start = is_prism ? 0 : p.z_min - steepness * p.scale_bottom;
    return std::string("prism { ") + (is_prism ? "linear" : "conic") + "_sweep linear_spline " +
           povray::number(from) + "," + povray::number(to) + "," +
           povray::figure(*p.profile, scale) + " matrix <1,0,0, 0,0," + povray::number(steepness) +
           ", 0,1,0, 0,0," + povray::number(start) + ">";
  }
};

constexpr ExtrusionTestKind kTestKind;

}  // namespace

constinit const TestKind& Extrusion_test_kind = kTestKind;

}  // namespace test_support
