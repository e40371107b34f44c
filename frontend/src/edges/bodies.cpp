#include "edges/bodies.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <map>
#include <numeric>
#include <utility>

namespace frontend {
namespace {

using csgcore::Box;
using csgcore::Primitive;
using csgcore::Vec3;

/// Points and planes that are computed in double from the same numbers differ by less than this
/// share of the largest coordinate, and parts of a design that do not touch differ by more.
constexpr double kCoincident = 1e-9;
/// With more faces the planes are not moved out to the vertices of other faces: faces × vertices
/// steps would take longer than a second. Only meshes of spheres are so large, and these are exact.
constexpr size_t kMostFacesMoved = 1 << 13;

/// Returns the planes of the mesh's faces in local coordinates, with normals of any length.
std::vector<BodyPlane> local_planes(const csgcore::Mesh& mesh) {
  Vec3 center(0.0);
  for (const Vec3& vertex : mesh.vertices) center += vertex;
  center /= static_cast<double>(mesh.vertices.size());
  std::vector<BodyPlane> planes;
  for (const std::vector<uint32_t>& face : mesh.faces) {
    const Vec3& apex = mesh.vertices[face[0]];
    Vec3 normal(0.0);
    for (size_t i = 2; i < face.size(); ++i) {
      normal += glm::cross(mesh.vertices[face[i - 1]] - apex, mesh.vertices[face[i]] - apex);
    }
    if (glm::dot(normal, apex - center) < 0) normal = -normal;
    const double length = glm::length(normal);
    if (length > 0) normal /= length;
    double offset = glm::dot(normal, apex);
    for (const uint32_t i : face) offset = std::max(offset, glm::dot(normal, mesh.vertices[i]));
    if (mesh.faces.size() <= kMostFacesMoved) {
      for (const Vec3& v : mesh.vertices) offset = std::max(offset, glm::dot(normal, v));
    }
    planes.push_back({normal, offset});
  }
  return planes;
}

class BodyMaker {
 public:
  explicit BodyMaker(const ImportedDesign& design) : design_(design) {}

  Body make(uint32_t index) {
    const Primitive& primitive = design_.scene.primitives[index];
    Body body;
    body.primitive = index;
    const auto found = design_.meshes.find(primitive.polyhedron.get());
    if (found == design_.meshes.end()) {
      body.canonical = csgcore::canonicalize(primitive);
      body.box = body.canonical->bounds;
      return body;
    }
    body.mesh = &found->second;
    for (const Vec3& vertex : body.mesh->mesh.vertices) {
      body.vertices.push_back(primitive.local_to_world.point(vertex));
      body.box.merge(body.vertices.back());
    }
    add_planes(primitive.local_to_world, body);
    std::vector<Box> boxes;
    for (const std::vector<uint32_t>& face : body.mesh->mesh.faces) {
      boxes.emplace_back();
      for (const uint32_t corner : face) boxes.back().merge(body.vertices[corner]);
    }
    body.faces = FaceTree(std::move(boxes));
    if (body.planes.size() > kFewPlanes) body.canonical = csgcore::canonicalize(primitive);
    return body;
  }

 private:
  void add_planes(const csgcore::Affine& map, Body& body) {
    const auto [entry, is_new] = planes_.try_emplace(body.mesh);
    if (is_new) entry->second = local_planes(body.mesh->mesh);
    const csgcore::Mat3 to_normals = glm::transpose(csgcore::inverse(map.linear));
    for (size_t i = 0; i < entry->second.size(); ++i) {
      const BodyPlane& local = entry->second[i];
      Vec3 normal = to_normals * local.normal;
      const double length = glm::length(normal);
      if (length > 0) normal /= length;
      const double offset =
          (length > 0 ? local.offset / length : 0) + glm::dot(normal, map.translation);
      body.planes.push_back({normal, offset});
      // Corners that a file's digits have moved off the plane lie in it all the same.
      for (const uint32_t corner : body.mesh->mesh.faces[i]) {
        const double depth = std::abs(body.planes.back().above(body.vertices[corner]));
        body.tolerance = std::max(body.tolerance, 4 * depth);
      }
    }
  }

  const ImportedDesign& design_;
  std::map<const FacetMesh*, std::vector<BodyPlane>> planes_;
};

/// Sweeps along x.
void find_neighbours(std::vector<Body>& bodies, double margin) {
  std::vector<uint32_t> order(bodies.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](uint32_t a, uint32_t b) { return bodies[a].box.min.x < bodies[b].box.min.x; });
  for (size_t i = 0; i < order.size(); ++i) {
    Body& a = bodies[order[i]];
    for (size_t j = i + 1; j < order.size(); ++j) {
      Body& b = bodies[order[j]];
      if (b.box.min.x > a.box.max.x + margin) break;
      if (!touch(a.box, b.box, margin)) continue;
      a.neighbours.push_back(order[j]);
      b.neighbours.push_back(order[i]);
    }
  }
}

}  // namespace

double BodyPlane::above(const Vec3& point) const { return glm::dot(normal, point) - offset; }

void Body::face(uint32_t index, std::vector<Vec3>& corners) const {
  corners.clear();
  for (const uint32_t corner : mesh->mesh.faces[index]) corners.push_back(vertices[corner]);
}

std::vector<Body> bodies_of(const ImportedDesign& design) {
  std::vector<uint8_t> is_named(design.scene.primitives.size());
  for (const csgcore::CsgToken& token : design.scene.model.tokens()) {
    if (token.is_primitive) is_named[token.value] = 1;
  }
  BodyMaker maker(design);
  std::vector<Body> bodies;
  double largest = 0;
  for (uint32_t i = 0; i < is_named.size(); ++i) {
    if (is_named[i] == 0) continue;
    bodies.push_back(maker.make(i));
    for (int axis = 0; axis < 3; ++axis) {
      largest = std::max(
          {largest, std::abs(bodies.back().box.min[axis]), std::abs(bodies.back().box.max[axis])});
    }
  }
  for (Body& body : bodies) body.tolerance = std::max(body.tolerance, kCoincident * largest);
  find_neighbours(bodies, kCoincident * largest);
  return bodies;
}

}  // namespace frontend
