// The test kind of the triangle mesh.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "csgcore/triangle_mesh.hpp"
#include "kinds/mesh_solid.hpp"
#include "kinds/povray_text.hpp"
#include "kinds/test_kind.hpp"
#include "test_meshes.hpp"

namespace test_support {
namespace {

using csgcore::LongVec3;
using csgcore::Primitive;
using csgcore::Real;
using csgcore::TriangleMesh;
using csgcore::Vec3;
using csgcore::reference::LocalSolid;
using csgcore::reference::MeshPassage;
using csgcore::reference::NearRay;
using csgcore::reference::Span;

/// Returns the spans of origin + t·direction within a closed mesh.
std::vector<Span> spans_of(const TriangleMesh& mesh, const Vec3& origin, const Vec3& direction) {
  return csgcore::reference::wound_spans(
      csgcore::reference::passages(mesh, {LongVec3(origin), LongVec3(direction)}));
}

/// A direction that no edge or face of the variants is parallel to.
constexpr Vec3 kAskew{0.6123, 0.4571, 0.6449};

bool contains(const TriangleMesh& mesh, const Vec3& point) {
  for (const Span& span : spans_of(mesh, point, kAskew)) {
    if (span.begin <= 0 && span.end >= 0) return true;
  }
  return false;
}

/// Returns the primitive moved so that the z axis passes well inside of the solid there.
Primitive about(const MeshParts& parts, const Vec3& inside) {
  return csgcore::make_mesh(parts.moved(-inside).mesh());
}

Vec3 lengths(Sizes& sizes) {
  Vec3 result;
  for (int axis = 0; axis < 3; ++axis) result[axis] = sizes.length();
  return result;
}

constexpr Variant kVariants[] = {
    {"Tetrahedron",
     [](Sizes& sizes) { return about(tetrahedron_parts(sizes.length()), Vec3(0.0)); }},
    // These two share faces with polyhedra of such sizes.
    {"MeshBox",
     [](Sizes& sizes) {
       const Vec3 low = -lengths(sizes);
       return csgcore::make_mesh(box_parts(low, lengths(sizes)).mesh());
     }},
    {"MeshPrism",
     [](Sizes& sizes) {
       const double radius = sizes.length(), bottom = -sizes.length(), top = sizes.length();
       const int fragments = sizes.fragments();
       return csgcore::make_mesh(
           parts_of(csgcore::frustum_mesh(bottom, top, radius, radius, fragments)).mesh());
     }},
    {"LPrism",
     [](Sizes& sizes) {
       const double length = sizes.length(), height = sizes.length();
       return about(l_prism_parts(length, length / 4, height),
                    {length / 7, length / 9, height / 2.3});
     }},
    {"Torus",
     [](Sizes& sizes) {
       const double radius = sizes.length();
       return about(torus_parts(radius, radius / 3, 17, 10), {radius * 1.01, radius / 77, 0});
     }},
    {"Helix",
     [](Sizes& sizes) {
       const double radius = sizes.length();
       // Halfway between two rings of the tube.
       return about(helix_parts(radius, radius / 6, radius / 2, 3, 12, 6),
                    {radius * 0.9, -radius * 0.25, radius * 0.48});
     }},
    {"Icosphere",
     [](Sizes& sizes) { return about(icosphere_parts(sizes.length(), 2), Vec3(0.0)); }},
    {"Cavity",
     [](Sizes& sizes) {
       const Vec3 half = lengths(sizes);
       MeshParts parts = box_parts(-half, half);
       parts.add(icosphere_parts(1, 1).scaled(0.7 * half).inside_out());
       return about(parts, {0.85 * half.x, 0.8 * half.y, 0.1 * half.z});
     }},
    {"InsideOut",
     [](Sizes& sizes) {
       const double radius = sizes.length();
       return about(torus_parts(radius, radius / 4, 9, 5).inside_out(),
                    {radius * 0.97, radius / 50, 0});
     }},
    {"Shells",
     [](Sizes& sizes) {
       const Vec3 half = lengths(sizes);
       MeshParts parts = box_parts(-half, half);
       parts.add(icosphere_parts(1, 1).scaled(half).moved({0.8 * half.x, 0.5 * half.y, 0}));
       return about(parts, {0.6 * half.x, 0.3 * half.y, 0.2 * half.z});
     }},
    {"HeightField",
     [](Sizes& sizes) {
       const double size = sizes.length(), high = sizes.length();
       return about(height_field_parts(size, 8, high / 5, high, sizes.random()),
                    {size / 2.1, size / 1.9, high / 11});
     }},
    {"Star",
     [](Sizes& sizes) {
       const double high = sizes.length();
       return about(star_parts(0.3 * high, high, 2, sizes.random()), Vec3(0.0));
     }},
    {"SlicedBox", [](Sizes& sizes) {
       return about(sliced_box_parts(lengths(sizes), 4, sizes.random()), Vec3(0.0));
     }}};

/// The point of a triangle that is nearest to p (Ericson, "Real-Time Collision Detection", 5.1.5).
LongVec3 nearest_in(const LongVec3& a, const LongVec3& b, const LongVec3& c, const LongVec3& p) {
  const LongVec3 ab = b - a, ac = c - a, ap = p - a;
  const Real d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return a;
  const LongVec3 bp = p - b;
  const Real d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return b;
  const LongVec3 cp = p - c;
  const Real d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return c;
  const Real vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + d1 / (d1 - d3) * ab;
  const Real vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + d2 / (d2 - d6) * ac;
  const Real va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6) return b + (d4 - d3) / (d4 - d3 + d5 - d6) * (c - b);
  return a + (vb * ab + vc * ac) / (va + vb + vc);
}

class MeshTestKind final : public TestKind {
 public:
  std::span<const Variant> variants() const override { return kVariants; }
  bool is_told_tightly() const override { return false; }

  bool holds(const Primitive& p, const Vec3& point) const override {
    return contains(*p.mesh(), point);
  }
  /// Triangles within another shell are no surface.
  Vec3 surface_point(const Primitive& p, std::mt19937& random) const override {
    const TriangleMesh& mesh = *p.mesh();
    std::uniform_real_distribution<double> share(0, 1);
    for (;;) {
      const auto triangle = static_cast<uint32_t>(random() % mesh.triangles().size());
      const auto corner = [&](size_t k) { return mesh.vertices()[mesh.triangles()[triangle][k]]; };
      const double root = std::sqrt(share(random)), along = share(random);
      const Vec3 inside =
          (1 - root) * corner(0) + root * (1 - along) * corner(1) + root * along * corner(2);
      if (random() % 3 != 0) {
        if (is_surface(mesh, triangle, inside)) return inside;
        continue;
      }
      constexpr double kStep = 1e-3;  // a vertex is taken for the points next to it
      const Vec3 vertex = corner(random() % 3);
      if (is_surface(mesh, triangle, glm::mix(vertex, inside, kStep))) return vertex;
    }
  }
  Vec3 core(const Primitive& p, const Vec3& surface_point) const override {
    return way_in(*p.mesh(), surface_point);
  }

  LongVec3 middle(const Primitive& p) const override {
    return LongVec3(p.mesh()->canonical().center);
  }
  Real reach_world(const Primitive& p) const override {
    const glm::mat<3, 3, Real> linear(p.local_to_world.linear);
    Real reach = 0;
    for (const Vec3& vertex : p.mesh()->vertices()) {
      reach = std::max(reach, glm::length(linear * (LongVec3(vertex) - middle(p))));
    }
    return reach;
  }
  /// One side: the distance from the surface, which is not convex.
  std::vector<Side> sides(const Primitive& p, const LongVec3& point) const override {
    const TriangleMesh& mesh = *p.mesh();
    const auto corner = [&](uint32_t vertex) { return LongVec3(mesh.vertices()[vertex]); };
    Real least = std::numeric_limits<Real>::infinity();
    LongVec3 nearest(0);
    for (const auto& [a, b, c] : mesh.triangles()) {
      const LongVec3 candidate = nearest_in(corner(a), corner(b), corner(c), point);
      const Real distance = glm::length(candidate - point);
      if (distance < least) least = distance, nearest = candidate;
    }
    const auto passages = csgcore::reference::passages(mesh, {point, LongVec3(kAskew)});
    int winding = 0;
    for (const MeshPassage& passage : passages) winding += passage.t < 0 ? passage.turn : 0;
    const Real sign = winding != 0 ? -1 : 1;
    const LongVec3 outwards = sign * (point - nearest);
    return {{sign * least, least > 0 ? outwards / least : LongVec3(kAskew)}};
  }

  std::unique_ptr<const LocalSolid> solid(const Primitive& p) const override {
    return std::make_unique<csgcore::reference::MeshSolid>(p);
  }
  double furthest(const Primitive& p, const Vec3& direction) const override {
    double most = -std::numeric_limits<double>::infinity();
    for (const TriangleMesh::Triangle& triangle : p.mesh()->triangles()) {
      for (const uint32_t v : triangle) {
        most = std::max(most, glm::dot(direction, p.mesh()->vertices()[v]));
      }
    }
    return most;
  }

  /// Those of the part about the origin.
  Heights heights(const Primitive& p) const override {
    for (const Span& span : spans_of(*p.mesh(), Vec3(0.0), {0, 0, 1})) {
      if (span.begin <= 0 && span.end >= 0) return {double(span.begin), double(span.end)};
    }
    return {0, 0};
  }
  Vec3 on_surface(const Primitive& p, const Vec3& sideways, double height) const override {
    const Vec3 on_axis{0, 0, height};
    if (glm::length(sideways) == 0) return on_axis;
    const Vec3 direction = glm::normalize(sideways);
    for (const Span& span : spans_of(*p.mesh(), on_axis, direction)) {
      if (span.end >= 0) return on_axis + double(span.end) * sideways;
    }
    return on_axis;
  }

  /// POV-Ray takes the inside of a mesh from its crossings along `inside_vector`.
  std::string as_povray(const Primitive& p) const override {
    std::string text = "mesh {";
    for (const auto& [a, b, c] : p.mesh()->triangles()) {
      text += " triangle { " + povray::vector(p.mesh()->vertices()[a]) + "," +
              povray::vector(p.mesh()->vertices()[b]) + "," +
              povray::vector(p.mesh()->vertices()[c]) + " }";
    }
    return text + " inside_vector " + povray::vector(kAskew);
  }

 private:
  /// Returns a point well inside that sees the surface point.
  static Vec3 way_in(const TriangleMesh& mesh, const Vec3& surface_point) {
    csgcore::Box box;
    for (const Vec3& vertex : mesh.vertices()) box.merge(vertex);
    const double size = box.diagonal();
    constexpr double kRounding = 1e-13;  // of a surface point, as a share of the size
    double furthest = 0;
    Vec3 best = surface_point;
    for (int i = 0; i < 27; ++i) {
      const Vec3 grid(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
      const Vec3 direction = glm::normalize(grid + 0.3 * kAskew * Vec3(1, -1, 1));
      double way = 0;
      bool is_alone = true;  // a line may touch a vertex within the solid
      for (const Span& span : spans_of(mesh, surface_point, direction)) {
        if (std::abs(span.begin) <= kRounding * size) way = 0.5 * double(span.end);
        if (std::abs(span.end) <= kRounding * size) is_alone = false;
      }
      if (is_alone && way > furthest) furthest = way, best = surface_point + way * direction;
    }
    return best;
  }
  /// Returns whether a point of a triangle is on the surface: whether one side of it is outside.
  static bool is_surface(const TriangleMesh& mesh, uint32_t triangle, const Vec3& point) {
    const LongVec3 normal = csgcore::reference::triangle_normal(mesh, triangle);
    const auto passages = csgcore::reference::passages(mesh, {LongVec3(point), -normal});
    int winding = 0;
    for (const MeshPassage& passage : passages) {
      const bool is_outside = winding == 0;
      winding += passage.turn;
      if (passage.triangle == triangle) return is_outside != (winding == 0);
    }
    return false;  // the triangle is passed at an edge, or has no area
  }
};

constexpr MeshTestKind kTestKind;

}  // namespace

constinit const TestKind& Mesh_test_kind = kTestKind;

}  // namespace test_support
