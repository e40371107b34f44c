#include "lower/import_polyhedra.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

namespace frontend {
namespace {

using csgcore::Affine;
using csgcore::Mat3;
using csgcore::Mesh;
using csgcore::Primitive;
using csgcore::Vec3;

/// x ↦ map(origin + size · x), by coordinate.
Affine resized(const Affine& map, const Vec3& origin, const Vec3& size) {
  return {Mat3(map.linear[0] * size.x, map.linear[1] * size.y, map.linear[2] * size.z),
          map.point(origin)};
}

double largest_coordinate(const Mesh& mesh) {
  double largest = 0;
  for (const Vec3& v : mesh.vertices) {
    for (int axis = 0; axis < 3; ++axis) largest = std::max(largest, std::abs(v[axis]));
  }
  return largest;
}

std::vector<double> numbers_of(const Mesh& mesh) {
  std::vector<double> numbers;
  for (const Vec3& v : mesh.vertices) numbers.insert(numbers.end(), {v.x, v.y, v.z});
  for (const std::vector<uint32_t>& face : mesh.faces) {
    numbers.push_back(static_cast<double>(face.size()));
    numbers.insert(numbers.end(), face.begin(), face.end());
  }
  return numbers;
}

}  // namespace

bool faces_inwards(const PolyhedronArguments& arguments) {
  const Mesh mesh = csgcore::polyhedron_mesh(arguments.points, arguments.faces);
  double volume = 0;  // six times; positive where the faces run counter-clockwise
  for (const std::vector<uint32_t>& face : mesh.faces) {
    for (size_t i = 2; i < face.size(); ++i) {
      // From a vertex of the solid, so that no large offset cancels.
      const Vec3& apex = mesh.vertices.front();
      volume +=
          glm::dot(mesh.vertices[face[0]] - apex,
                   glm::cross(mesh.vertices[face[i - 1]] - apex, mesh.vertices[face[i]] - apex));
    }
  }
  return volume < 0;
}

Primitive PolyhedronPool::box(const csgcore::Box& box, const Affine& local_to_world) {
  const Vec3 size = box.size();
  const bool is_finite = std::isfinite(size.x) && std::isfinite(size.y) && std::isfinite(size.z);
  const bool is_solid = is_finite && size.x > 0 && size.y > 0 && size.z > 0;
  if (!is_solid) return csgcore::make_polyhedron(nullptr);
  if (!unit_box_) {
    const csgcore::Box unit{Vec3(0.0), Vec3(1.0)};
    unit_box_ = csgcore::Polyhedron::box(unit);
    if (keeps_meshes_) meshes_of_[unit_box_.get()] = facet_mesh(csgcore::box_mesh(unit), false);
  }
  return csgcore::make_polyhedron(unit_box_, resized(local_to_world, box.min, size));
}

Convexity PolyhedronPool::convex(const PolyhedronArguments& arguments, const Affine& local_to_world,
                                 Primitive& primitive) {
  Mesh mesh = csgcore::polyhedron_mesh(arguments.points, arguments.faces);
  if (mesh.faces.empty()) return Convexity::kNothing;
  if (mesh.faces.size() * mesh.vertices.size() > kMostConvexitySteps) return Convexity::kTooLarge;
  // By a power of two to unit size, so that products of coordinates are representable.
  const double largest = largest_coordinate(mesh);
  const int exponent = largest > 0 ? std::ilogb(largest) : 0;
  for (Vec3& v : mesh.vertices) {
    for (int axis = 0; axis < 3; ++axis) v[axis] = std::ldexp(v[axis], -exponent);
  }
  const auto [entry, is_new] = meshes_.try_emplace(numbers_of(mesh));
  if (is_new) {
    entry->second = csgcore::Polyhedron::from(mesh);
    if (keeps_meshes_ && entry->second) {
      meshes_of_[entry->second.get()] = facet_mesh(mesh, false);
    }
  }
  if (!entry->second) return Convexity::kNot;
  primitive = csgcore::make_polyhedron(
      entry->second, resized(local_to_world, Vec3(0.0), Vec3(std::ldexp(1.0, exponent))));
  return Convexity::kConvex;
}

bool PolyhedronPool::facet(Primitive& primitive, int fragments) {
  const Faceting faceting = traits_of(primitive.shape).faceting(primitive, fragments);
  Shared polyhedron = faceted(faceting, fragments);
  if (!polyhedron) return false;
  Primitive faceted = csgcore::make_polyhedron(
      std::move(polyhedron), resized(primitive.local_to_world, faceting.origin, faceting.size));
  // Only where sizes near the ends of double's range meet: not to be drawn in either form.
  if (!csgcore::is_valid(faceted)) return true;
  faceted.color = primitive.color;
  faceted.cut_faces = primitive.cut_faces;
  faceted.id = primitive.id;
  primitive = std::move(faceted);
  return true;
}

PolyhedronPool::Shared PolyhedronPool::faceted(const Faceting& faceting, int fragments) {
  const FacetedKey key{fragments, local_solid(faceting.unit)};
  const auto found = faceted_.find(key);
  if (found != faceted_.end()) return found->second;
  if (faceting.faces > kFewFacets) {
    if (facets_ + faceting.faces > kMostFacets) return nullptr;
    facets_ += faceting.faces;
  }
  const PrimitiveTraits& traits = traits_of(faceting.unit.shape);
  Shared polyhedron = traits.faceted(faceting.unit, fragments);
  if (keeps_meshes_) meshes_of_[polyhedron.get()] = traits.facet_mesh(faceting.unit, fragments);
  return faceted_[key] = std::move(polyhedron);
}

}  // namespace frontend
