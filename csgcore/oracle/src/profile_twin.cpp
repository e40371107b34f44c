// The exact twins of the extrusion and the revolution.
#include <algorithm>
#include <utility>

#include "disc_box.hpp"
#include "exact_profile.hpp"
#include "exact_twin.hpp"
#include "number_text.hpp"

namespace oracle {
namespace {

using csgcore::Affine;
using csgcore::ExtrusionShape;
using csgcore::Primitive;
using csgcore::Profile;
using csgcore::ProfileEdge;
using csgcore::ProfileLoop;
using csgcore::RevolutionShape;
using csgcore::Vec2;
using csgcore::Vec3;

std::string text_of(const Vec2& v) { return "{" + joined(std::vector{v.x, v.y}) + "}"; }

std::string cpp_of(const Profile& profile) {
  std::vector<std::string> loops;
  for (const ProfileLoop& loop : profile.loops()) {
    std::vector<std::string> edges;
    for (const ProfileEdge& edge : loop) {
      const char* const kinds[] = {"kLine", "kArc", "kBezier"};
      edges.push_back("{ProfileEdge::Kind::" + std::string(kinds[int(edge.kind)]) +
                      (edge.is_counterclockwise ? ", true, " : ", false, ") + text_of(edge.end) +
                      ", " + text_of(edge.control) + "}");
    }
    loops.push_back("{" + joined(edges) + "}");
  }
  const bool is_even_odd = profile.fill_rule() == csgcore::FillRule::kEvenOdd;
  return "std::make_shared<Profile>(std::vector<ProfileLoop>{" + joined(loops) +
         "}, FillRule::" + (is_even_odd ? "kEvenOdd" : "kNonZero") + ")";
}

/// Returns OpenSCAD's polygon through the control points, which is even-odd.
std::string openscad_of(const Profile& profile) {
  std::vector<std::string> points, paths;
  size_t count = 0;
  for (const ProfileLoop& loop : profile.loops()) {
    std::vector<std::string> path;
    const auto add = [&](const Vec2& p) {
      points.push_back("[" + joined(std::vector{p.x, p.y}) + "]");
      path.push_back(std::to_string(count++));
    };
    for (const ProfileEdge& edge : loop) {
      if (edge.kind == ProfileEdge::Kind::kBezier) add(edge.control);
      add(edge.end);
    }
    paths.push_back("[" + joined(path) + "]");
  }
  return "polygon([" + joined(points) + "], [" + joined(paths) + "])";
}

/// Returns profiles of fewer loops or edges that have an area.
std::vector<std::shared_ptr<const Profile>> smaller_than(const Profile& profile) {
  std::vector<std::shared_ptr<const Profile>> result;
  const std::vector<ProfileLoop> loops(profile.loops().begin(), profile.loops().end());
  const auto add = [&](std::vector<ProfileLoop> fewer) {
    auto made = std::make_shared<Profile>(std::move(fewer), profile.fill_rule());
    if (made->has_area()) result.push_back(std::move(made));
  };
  for (size_t i = 0; i < loops.size(); ++i) {
    std::vector<ProfileLoop> fewer = loops;
    fewer.erase(fewer.begin() + std::ptrdiff_t(i));
    add(std::move(fewer));
    for (size_t k = 0; k < loops[i].size(); ++k) {
      // An arc after the edge would no longer begin on its circle.
      if (loops[i][(k + 1) % loops[i].size()].kind == ProfileEdge::Kind::kArc) continue;
      fewer = loops;
      fewer[i].erase(fewer[i].begin() + std::ptrdiff_t(k));
      add(std::move(fewer));
    }
  }
  return result;
}

/// Merges a range about the exact coordinate of a point on the z axis.
void merge_range(const Vec3& point, const Affine& map, double z, int axis, const Interval& range,
                 csgcore::Box& box) {
  merge(coordinate_about(point, map, {0, 0, z}, axis) + range, axis, box);
}

class ProfileTwin : public ExactTwin {
 public:
  void add_surfaces(const Primitive& primitive, const Exact& magnification,
                    Target<Exact>& target) const override {
    target.profile = std::make_shared<ExactProfile>(primitive, middle(primitive), magnification);
    const Vec3 size = size_of(primitive);
    const Vec3 slender = std::min({size.x, size.y, size.z}) / size;
    target.weight = slender * slender;
  }
  std::vector<Primitive> simpler(const Primitive& primitive) const override {
    std::vector<Primitive> result{csgcore::make_sphere(1, primitive.local_to_world)};
    for (auto& profile : smaller_than(*primitive.profile())) {
      result.push_back(primitive);
      profile_in(result.back()) = std::move(profile);
    }
    return result;
  }

 protected:
  virtual std::shared_ptr<const Profile>& profile_in(Primitive& primitive) const = 0;
  /// The size of the local solid's box.
  virtual Vec3 size_of(const Primitive& primitive) const = 0;
};

class ExtrusionTwin final : public ProfileTwin {
 public:
  Vector<Exact> middle(const Primitive& primitive) const override {
    const auto& [profile, z_min, z_max, bottom, top] = primitive.as<ExtrusionShape>();
    const Vec2& center = profile->center();
    const Exact scale = Exact(0.5) * (Exact(bottom) + Exact(top));
    return {scale * Exact(center.x), scale * Exact(center.y),
            Exact(0.5) * (Exact(z_min) + Exact(z_max))};
  }
  void merge_box(const Vec3& point, const Primitive& primitive, csgcore::Box& box) const override {
    const Affine& map = primitive.local_to_world;
    const auto& [profile, z_min, z_max, bottom, top] = primitive.as<ExtrusionShape>();
    for (int axis = 0; axis < 3; ++axis) {
      const Interval range =
          range_along(*profile, Interval(map.linear[0][axis]), Interval(map.linear[1][axis]));
      merge_range(point, map, z_min, axis, Interval(bottom) * range, box);
      merge_range(point, map, z_max, axis, Interval(top) * range, box);
    }
  }
  std::string as_cpp(const Primitive& primitive, const std::string& map) const override {
    const auto& [profile, z_min, z_max, bottom, top] = primitive.as<ExtrusionShape>();
    return "make_extrusion(" + cpp_of(*profile) + ", " +
           joined(std::vector{z_min, z_max, bottom, top}) + ", " + map + ")";
  }
  std::string as_openscad(const Primitive& primitive) const override {
    const auto& p = primitive.as<ExtrusionShape>();
    const bool is_pointed_below = p.scale_bottom == 0;
    const double from = is_pointed_below ? p.scale_top : p.scale_bottom;
    const double to = is_pointed_below ? p.scale_bottom : p.scale_top;
    return "translate([0, 0, " + shortest_text(is_pointed_below ? p.z_max : p.z_min) + "]) " +
           (is_pointed_below ? "mirror([0, 0, 1]) " : "") + "linear_extrude(" +
           shortest_text(p.z_max - p.z_min) + ", scale = " + shortest_text(to / from) + ") scale(" +
           shortest_text(from) + ") " + openscad_of(*p.profile);
  }
  std::vector<double*> sizes(Primitive& primitive) const override {
    auto& p = primitive.as<ExtrusionShape>();
    return {&p.z_min, &p.z_max, &p.scale_bottom, &p.scale_top};
  }

 protected:
  std::shared_ptr<const Profile>& profile_in(Primitive& primitive) const override {
    return primitive.as<ExtrusionShape>().profile;
  }
  Vec3 size_of(const Primitive& primitive) const override {
    const auto& p = primitive.as<ExtrusionShape>();
    const Vec2 half = std::max(p.scale_bottom, p.scale_top) * p.profile->half();
    return {2 * half.x, 2 * half.y, p.z_max - p.z_min};
  }
};

class RevolutionTwin final : public ProfileTwin {
 public:
  Vector<Exact> middle(const Primitive& primitive) const override {
    return {0, 0, primitive.profile()->center().y};
  }
  void merge_box(const Vec3& point, const Primitive& primitive, csgcore::Box& box) const override {
    const Affine& map = primitive.local_to_world;
    for (int axis = 0; axis < 3; ++axis) {
      const Interval lateral = CGAL::sqrt(CGAL::square(Interval(map.linear[0][axis])) +
                                          CGAL::square(Interval(map.linear[1][axis])));
      for (const Interval& x : {lateral, -lateral}) {
        const Interval range = range_along(*primitive.profile(), x, Interval(map.linear[2][axis]));
        merge_range(point, map, 0, axis, range, box);
      }
    }
  }
  std::string as_cpp(const Primitive& primitive, const std::string& map) const override {
    return "make_revolution(" + cpp_of(*primitive.profile()) + ", " + map + ")";
  }
  std::string as_openscad(const Primitive& primitive) const override {
    return "rotate_extrude() " + openscad_of(*primitive.profile());
  }

 protected:
  std::shared_ptr<const Profile>& profile_in(Primitive& primitive) const override {
    return primitive.as<RevolutionShape>().profile;
  }
  Vec3 size_of(const Primitive& primitive) const override {
    const Profile& profile = *primitive.profile();
    const double radius = profile.center().x + profile.half().x;
    return {2 * radius, 2 * radius, 2 * profile.half().y};
  }
};

constexpr ExtrusionTwin kExtrusionTwin;
constexpr RevolutionTwin kRevolutionTwin;

}  // namespace

constinit const ExactTwin& Extrusion_twin = kExtrusionTwin;
constinit const ExactTwin& Revolution_twin = kRevolutionTwin;

}  // namespace oracle
