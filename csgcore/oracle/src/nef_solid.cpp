#include "oracle/nef_solid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <set>
#include <sstream>
#include <utility>

#include "child_process.hpp"
#include "csgcore/polyhedron.hpp"
#include "nef_lines.hpp"
#include "nef_polytope.hpp"

namespace oracle {
namespace {

using csgcore::Primitive;
using csgcore::Vec3;

/// The coefficients a, b, c, d divided by the absolute value of the first one that is not 0, so
/// that equal half-spaces have equal keys.
using PlaneKey = std::array<Rational, 4>;

PlaneKey key_of(const Plane& plane) {
  PlaneKey key{rational_of(plane.a()), rational_of(plane.b()), rational_of(plane.c()),
               rational_of(plane.d())};
  const auto first = std::find_if(key.begin(), key.end(), [](const auto& x) { return x != 0; });
  const Rational scale = abs(*first);
  for (Rational& coefficient : key) coefficient /= scale;
  return key;
}

Plane plane_of(const PlaneKey& key) { return Plane(key[0], key[1], key[2], key[3]); }

FacetPlane facet_plane_of(const PlaneKey& key) {
  return {{key[0], key[1], key[2]},
          -key[3],
          glm::normalize(Vec3(key[0].get_d(), key[1].get_d(), key[2].get_d())),
          {}};
}

/// Returns the sum of numbers with many digits. It adds them in pairs, so that few of the sums are
/// long.
Rational sum_of(std::vector<Rational> terms) {
  if (terms.empty()) return 0;
  for (; terms.size() > 1; terms.resize((terms.size() + 1) / 2)) {
    for (size_t i = 0; i < terms.size() / 2; ++i) {
      terms[i] = terms[2 * i] + terms[2 * i + 1];
    }
    if (terms.size() % 2 == 1) terms[terms.size() / 2] = terms.back();
  }
  return terms[0];
}

}  // namespace

class NefSolid::Impl {
 public:
  Impl(const ExactBoundary& boundary, const csgcore::CsgTree& tree,
       std::span<const FacetedSolid> polyhedra)
      : triangles_(add_planes(boundary)), lines_(triangles_, planes_) {
    name_polyhedra(tree, polyhedra);
  }

  const std::vector<BoundaryTriangle>& triangles() const { return triangles_; }
  const std::vector<FacetPlane>& facet_planes() const { return facet_planes_; }
  const NefLines& lines() const { return lines_; }

 private:
  std::vector<BoundaryTriangle> add_planes(const ExactBoundary& boundary) {
    std::vector<BoundaryTriangle> triangles;
    for (const auto& [a, b, c] : boundary.triangles) {
      const Kernel::Triangle_3 triangle(boundary.vertices[a], boundary.vertices[b],
                                        boundary.vertices[c]);
      const PlaneKey key = key_of(triangle.supporting_plane());
      const auto [entry, is_new] = indices_.try_emplace(key, static_cast<uint32_t>(planes_.size()));
      if (is_new) {
        planes_.push_back(plane_of(key));
        facet_planes_.push_back(facet_plane_of(key));
      }
      triangles.push_back({triangle, entry->second});
    }
    return triangles;
  }

  void name_polyhedra(const csgcore::CsgTree& tree, std::span<const FacetedSolid> polyhedra) {
    std::set<uint32_t> in_tree;
    for (const csgcore::CsgToken& token : tree.tokens()) {
      if (token.is_primitive) in_tree.insert(token.value);
    }
    for (const uint32_t polyhedron : in_tree) {
      const FacetedSolid& solid = polyhedra[polyhedron];
      for (const csgcore::HalfSpace& half_space : solid.half_spaces) {
        name_both(key_of(world_plane(half_space, solid.local_to_world)), polyhedron);
      }
      if (!solid.mesh) continue;
      for (const Plane& plane : triangle_planes(solid)) name_both(key_of(plane), polyhedron);
    }
  }

  /// The solid may lie on either side, if this was subtracted.
  void name_both(PlaneKey key, uint32_t polyhedron) {
    name(key, polyhedron);
    for (Rational& coefficient : key) coefficient = -coefficient;
    name(key, polyhedron);
  }

  void name(const PlaneKey& key, uint32_t polyhedron) {
    const auto found = indices_.find(key);
    if (found == indices_.end()) return;
    std::vector<uint32_t>& names = facet_planes_[found->second].polyhedra;
    if (names.empty() || names.back() != polyhedron) names.push_back(polyhedron);
  }

  std::map<PlaneKey, uint32_t> indices_;
  std::vector<Plane> planes_;
  std::vector<FacetPlane> facet_planes_;
  std::vector<BoundaryTriangle> triangles_;
  NefLines lines_;
};

NefBuild NefSolid::build(const csgcore::CsgTree& tree, std::span<const FacetedSolid> polyhedra,
                         const NefLimits& limits) {
  const ChildOutput output = run_in_child(
      [&](std::ostream& out) { write_boundary(out, nef_boundary(tree, polyhedra)); }, limits);
  if (output.status != NefStatus::kBuilt) return {output.status, nullptr, output.text};
  std::istringstream in(output.text);
  auto impl = std::make_unique<const Impl>(read_boundary(in), tree, polyhedra);
  return {NefStatus::kBuilt, std::unique_ptr<const NefSolid>(new NefSolid(std::move(impl))), {}};
}

NefBuild NefSolid::build(const csgcore::Scene& scene, int fragments, const NefLimits& limits) {
  std::vector<FacetedSolid> polyhedra;
  for (const Primitive& primitive : scene.primitives) {
    polyhedra.push_back(faceted(primitive, fragments));
  }
  return build(scene.model, polyhedra, limits);
}

NefSolid::NefSolid(std::unique_ptr<const Impl> impl) : impl_(std::move(impl)) {}
NefSolid::~NefSolid() = default;

bool NefSolid::empty() const { return impl_->triangles().empty(); }

const std::vector<FacetPlane>& NefSolid::planes() const { return impl_->facet_planes(); }

Place NefSolid::locate(const Vec3& point) const { return impl_->lines().locate(point_of(point)); }

std::vector<Crossing> NefSolid::crossings(const csgcore::Ray& line) const {
  return impl_->lines().crossings(point_of(line.origin), line.direction);
}

std::optional<Crossing> NefSolid::first_hit(const csgcore::Ray& ray, double from) const {
  for (const Crossing& crossing : crossings(ray)) {
    const bool is_beyond =
        crossing.s_lower > from ||
        (crossing.s_upper > from && exact_parameter(ray, crossing) > Rational(from));
    if (is_beyond) return crossing;
  }
  return std::nullopt;
}

Rational NefSolid::exact_parameter(const csgcore::Ray& line, const Crossing& crossing) const {
  return rational_of(
      impl_->lines().parameter(crossing.plane, point_of(line.origin), vector_of(line.direction)));
}

Rational NefSolid::volume() const {
  std::vector<Rational> terms;
  for (const auto& [triangle, plane] : impl_->triangles()) {
    const Number six_times = CGAL::determinant(
        triangle[0] - CGAL::ORIGIN, triangle[1] - CGAL::ORIGIN, triangle[2] - CGAL::ORIGIN);
    terms.push_back(rational_of(six_times));
  }
  return sum_of(std::move(terms)) / 6;
}

double NefSolid::area() const {
  double sum = 0;
  for (const auto& [triangle, plane] : impl_->triangles()) {
    sum += std::sqrt(CGAL::to_double(triangle.squared_area()));
  }
  return sum;
}

csgcore::Box NefSolid::bounds() const {
  csgcore::Box box;
  for (const auto& [triangle, plane] : impl_->triangles()) {
    const CGAL::Bbox_3 b = triangle.bbox();
    box.merge(csgcore::Box{{b.xmin(), b.ymin(), b.zmin()}, {b.xmax(), b.ymax(), b.zmax()}});
  }
  return box;
}

csgcore::Mesh NefSolid::mesh() const {
  csgcore::Mesh mesh;
  std::map<std::array<double, 3>, uint32_t> indices;
  for (const auto& [triangle, plane] : impl_->triangles()) {
    std::vector<uint32_t> face;
    for (int i = 0; i < 3; ++i) {
      const Vec3 v(CGAL::to_double(triangle[i].x()), CGAL::to_double(triangle[i].y()),
                   CGAL::to_double(triangle[i].z()));
      const auto [entry, is_new] = indices.try_emplace({v.x, v.y, v.z}, indices.size());
      if (is_new) mesh.vertices.push_back(v);
      face.push_back(entry->second);
    }
    const bool is_degenerate = face[0] == face[1] || face[1] == face[2] || face[2] == face[0];
    if (!is_degenerate) mesh.faces.push_back(std::move(face));
  }
  return mesh;
}

}  // namespace oracle
