#include "solids/import_polyhedra.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "base/hashes.hpp"
#include "csgcore/stop_scope.hpp"
#include "meshes/face_set.hpp"

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

/// Coordinates below this share of the largest count as 0. No picture shows them, and products of
/// two differences of the others, with all of their bits, are representable: the triangulation of
/// faces relies on exact signs of determinants.
constexpr double kLeastCoordinate = 0x1p-400;

/// Scales the points by a power of two, so that products of coordinates are representable. Returns
/// its exponent.
int scale_to_unit(FaceSet& faces) {
  double largest = 0;
  for (const Vec3& point : faces.points) {
    for (int axis = 0; axis < 3; ++axis) {
      const double size = std::abs(point[axis]);
      if (size > largest && std::isfinite(size)) largest = size;
    }
  }
  const int exponent = largest > 0 ? std::ilogb(largest) : 0;
  const double factor = std::ldexp(1.0, -exponent);
  const bool is_normal = std::isnormal(factor);
  for (Vec3& point : faces.points) {
    for (int axis = 0; axis < 3; ++axis) {
      point[axis] = is_normal ? point[axis] * factor : std::ldexp(point[axis], -exponent);
      if (point[axis] != 0 && std::abs(point[axis]) < kLeastCoordinate) point[axis] = 0;
    }
  }
  return exponent;
}

using Triangle = csgcore::TriangleMesh::Triangle;
using SharedMesh = std::shared_ptr<const csgcore::TriangleMesh>;

/// Returns the mesh with the first one of all triangles that have the same corners.
SharedMesh without_twins(const csgcore::TriangleMesh& mesh) {
  std::set<Triangle> seen;
  std::vector<Triangle> triangles;
  std::vector<std::optional<csgcore::Color>> colors;
  for (size_t i = 0; i < mesh.triangles().size(); ++i) {
    csgcore::stop_point();
    Triangle corners = mesh.triangles()[i];
    std::sort(corners.begin(), corners.end());
    if (!seen.insert(corners).second) continue;
    triangles.push_back(mesh.triangles()[i]);
    if (!mesh.colors().empty()) colors.push_back(mesh.colors()[i]);
  }
  return std::make_shared<const csgcore::TriangleMesh>(
      std::vector<Vec3>(mesh.vertices().begin(), mesh.vertices().end()), std::move(triangles),
      std::move(colors));
}

SharedMesh mesh_of(FaceSet faces) {
  std::vector<std::optional<csgcore::Color>> colors;
  std::vector<Triangle> triangles = triangles_of(faces, colors);
  auto mesh = std::make_shared<const csgcore::TriangleMesh>(
      std::move(faces.points), std::move(triangles), std::move(colors));
  if (mesh->triangles().empty()) return nullptr;
  if (mesh->is_closed()) return mesh;
  // Two sheets that run both ways at one place would leave nothing.
  SharedMesh single = without_twins(*mesh);
  return single->triangles().size() == mesh->triangles().size() ? mesh : single;
}

SharedMesh sheet_mesh(const csgcore::TriangleMesh& closed) {
  std::vector<Triangle> triangles = sheet_of(closed.vertices(), closed.triangles());
  if (triangles.empty()) return nullptr;
  return std::make_shared<const csgcore::TriangleMesh>(
      std::vector<Vec3>(closed.vertices().begin(), closed.vertices().end()), std::move(triangles));
}

/// Returns the triangle with its least corner first.
Triangle rotated(Triangle triangle) {
  std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
  return triangle;
}

double volume_of(const csgcore::TriangleMesh& mesh) {
  double volume = 0;
  const Vec3& origin = mesh.vertices().front();
  for (const Triangle& t : mesh.triangles()) {
    const auto at = [&](size_t i) { return mesh.vertices()[t[i]] - origin; };
    volume += glm::dot(at(0), glm::cross(at(1), at(2))) / 6;
  }
  return volume;
}

/// Tells faces that run the other way apart, once neighbours across edges agree.
void find_inner_faces(const FaceSet& faces, SolidOfFaces& solid) {
  const std::vector<Triangle> triangles = triangles_of(faces);
  const csgcore::TriangleMesh turned(faces.points, triangles);
  if (!turned.is_closed() || turned.triangles().empty()) return;
  std::set<Triangle> outward;  // counterclockwise, seen from outside
  const bool is_inverted = volume_of(turned) < 0;
  for (Triangle triangle : turned.triangles()) {
    csgcore::stop_point();
    if (is_inverted) std::swap(triangle[1], triangle[2]);
    outward.insert(rotated(triangle));
  }
  std::vector<Triangle> outer, inner;
  for (const Triangle& triangle : triangles) {
    csgcore::stop_point();
    (outward.contains(rotated(triangle)) ? outer : inner).push_back(triangle);
  }
  if (outer.empty() || inner.empty()) return;
  solid.outer_faces = std::make_shared<const csgcore::TriangleMesh>(faces.points, outer);
  solid.inner_faces = std::make_shared<const csgcore::TriangleMesh>(faces.points, inner);
}

SharedMesh mesh_of(RevolvedFaces revolved) {
  FaceSet faces;
  for (const std::vector<uint32_t>& face : revolved.mesh.faces) {
    if (revolved.is_cut(face)) {
      for (const size_t i : {0, 1, 3}) faces.corners.push_back(face[i]);
      faces.end_face();
      for (const size_t i : {1, 2, 3}) faces.corners.push_back(face[i]);
    } else {
      faces.corners.insert(faces.corners.end(), face.begin(), face.end());
    }
    faces.end_face();
  }
  faces.points = std::move(revolved.mesh.vertices);
  return mesh_of(std::move(faces));
}

}  // namespace

Primitive SolidOfFaces::under(const Affine& local_to_world) const {
  if (!polyhedron) return under(mesh, local_to_world);
  return csgcore::make_polyhedron(
      polyhedron, resized(local_to_world, Vec3(0.0), Vec3(std::ldexp(1.0, exponent))));
}

Primitive SolidOfFaces::under(SharedMesh faces, const Affine& local_to_world) const {
  return csgcore::make_mesh(std::move(faces),
                            resized(local_to_world, Vec3(0.0), Vec3(std::ldexp(1.0, exponent))));
}

Primitive PolyhedronPool::box(const csgcore::Box& box, const Affine& local_to_world) {
  const Vec3 size = box.size();
  const bool is_finite = std::isfinite(size.x) && std::isfinite(size.y) && std::isfinite(size.z);
  const bool is_solid = is_finite && size.x > 0 && size.y > 0 && size.z > 0;
  if (!is_solid) return csgcore::make_polyhedron(nullptr);
  if (!unit_box_) {
    const csgcore::Box unit{Vec3(0.0), Vec3(1.0)};
    unit_box_ = csgcore::Polyhedron::box(unit);
    if (keeps_meshes_) meshes_of_[unit_box_.get()] = facet_mesh({csgcore::box_mesh(unit)});
  }
  return csgcore::make_polyhedron(unit_box_, resized(local_to_world, box.min, size));
}

PolyhedronPool::FacesKey PolyhedronPool::key_of(const FaceSet& faces, int exponent,
                                                bool closes_gaps) {
  Hashes hashes;
  hashes.add(uint64_t{closes_gaps});
  for (const Vec3& point : faces.points) {
    for (int axis = 0; axis < 3; ++axis) hashes.add(std::bit_cast<uint64_t>(point[axis]));
  }
  for (const uint32_t corner : faces.corners) hashes.add(uint64_t{corner});
  for (const uint32_t end : faces.ends) hashes.add(uint64_t{end});
  for (const std::optional<csgcore::Color>& color : faces.colors) {
    const csgcore::Color given = color.value_or(csgcore::Color{-1, -1, -1, -1});
    for (const float channel : {given.r, given.g, given.b, given.a}) {
      hashes.add(uint64_t{std::bit_cast<uint32_t>(channel)});
    }
  }
  return {faces.points.size(), faces.corners.size(),
          faces.ends.size(),   std::bit_cast<uint64_t>(int64_t{exponent}),
          hashes.first(),      hashes.second()};
}

const SolidOfFaces& PolyhedronPool::solid(FaceSet faces, uint64_t& unfinite_faces,
                                          bool closes_gaps) {
  // Scaled first: what underflows there must be equal afterwards.
  const int exponent = scale_to_unit(faces);
  unfinite_faces += tidy(faces);
  const auto [entry, is_new] = solids_.try_emplace(key_of(faces, exponent, closes_gaps));
  SolidOfFaces& solid = entry->second;
  if (!is_new) return solid;
  solid.exponent = exponent;
  if (faces.face_count() == 0) return solid;
  solid.is_inside_out = enclosed_volume(faces) < 0;
  if (tells_inner_faces_) find_inner_faces(faces, solid);
  // Faces of half-spaces have no colours.
  const bool is_small = faces.face_count() * faces.points.size() <= kMostConvexitySteps;
  if (is_small && faces.colors.empty()) {
    const Mesh mesh = to_mesh(faces);
    solid.polyhedron = csgcore::Polyhedron::from(mesh);
    if (solid.polyhedron && keeps_meshes_) {
      meshes_of_[solid.polyhedron.get()] = facet_mesh({mesh});
    }
  }
  if (!solid.polyhedron) solid.mesh = mesh_of(closes_gaps ? faces : std::move(faces));
  if (closes_gaps && solid.mesh && !solid.mesh->is_closed()) {
    constexpr double kCell = 0x1p-20;  // to which OpenSCAD cuts operands
    weld(faces, std::ldexp(kCell, -exponent));
    tidy(faces);
    SharedMesh closed = mesh_of(std::move(faces));
    if (closed && closed->is_closed()) solid.mesh = std::move(closed);
  }
  if (solid.mesh && solid.mesh->is_closed()) solid.sheet = sheet_mesh(*solid.mesh);
  return solid;
}

bool PolyhedronPool::facet(Primitive& primitive, int fragments) {
  const Faceting faceting = traits_of(primitive.shape()).faceting(primitive, fragments);
  const SolidOfFaces& solid = faceted(faceting, fragments);
  if (solid.is_empty()) return false;
  Primitive faceted =
      solid.under(resized(primitive.local_to_world, faceting.origin, faceting.size));
  // Only where sizes near the ends of double's range meet: not to be drawn in either form.
  if (!csgcore::is_valid(faceted)) return true;
  faceted.color = primitive.color;
  faceted.cut_faces = primitive.cut_faces;
  faceted.id = primitive.id;
  primitive = std::move(faceted);
  return true;
}

const SolidOfFaces& PolyhedronPool::faceted(const Faceting& faceting, int fragments) {
  static const SolidOfFaces kNone;
  const FacetedKey key{fragments, faceting.unit.solid};
  const auto found = faceted_.find(key);
  if (found != faceted_.end()) return found->second;
  if (faceting.faces > kFewFacets) {
    if (facets_ + faceting.faces > kMostFacets) return kNone;
    facets_ += faceting.faces;
  }
  SolidOfFaces& solid = faceted_[key];
  const PrimitiveTraits& traits = traits_of(faceting.unit.shape());
  if (faceting.faces > kMostHalfSpaces) {
    solid.mesh = mesh_of(traits.revolved_faces(faceting.unit, fragments));
    return solid;
  }
  solid.polyhedron = csgcore::faceted_polyhedron(faceting.unit, fragments);
  if (keeps_meshes_) {
    meshes_of_[solid.polyhedron.get()] =
        facet_mesh(traits.revolved_faces(faceting.unit, fragments));
  }
  return solid;
}

}  // namespace frontend
