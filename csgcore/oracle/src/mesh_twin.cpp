// The exact twin of the triangle mesh.
#include <algorithm>
#include <glm/common.hpp>
#include <set>
#include <utility>

#include "csgcore/polyhedron.hpp"
#include "disc_box.hpp"
#include "exact_mesh.hpp"
#include "exact_twin.hpp"
#include "number_text.hpp"

namespace oracle {
namespace {

using csgcore::Primitive;
using csgcore::TriangleMesh;
using csgcore::Vec3;
using Triangle = TriangleMesh::Triangle;

csgcore::Box box_of(const TriangleMesh& mesh) {
  csgcore::Box box;
  for (const Triangle& triangle : mesh.triangles()) {
    for (const uint32_t vertex : triangle) box.merge(mesh.vertices()[vertex]);
  }
  return box;
}

std::string text_of(const Triangle& triangle, std::array<size_t, 3> order) {
  return joined({std::to_string(triangle[order[0]]), std::to_string(triangle[order[1]]),
                 std::to_string(triangle[order[2]])});
}

std::vector<std::string> vertex_texts(const TriangleMesh& mesh) {
  std::vector<std::string> texts;
  for (const Vec3& v : mesh.vertices()) texts.push_back(coordinates(v));
  return texts;
}

/// Returns the mesh with vertex `from` moved onto `to`, without the triangles that vanish. A closed
/// mesh stays closed.
std::shared_ptr<const TriangleMesh> collapsed(const TriangleMesh& mesh, uint32_t from,
                                              uint32_t to) {
  std::vector<Vec3> vertices(mesh.vertices().begin(), mesh.vertices().end());
  vertices.erase(vertices.begin() + from);
  const auto renamed = [&](uint32_t vertex) {
    const uint32_t kept = vertex == from ? to : vertex;
    return kept > from ? kept - 1 : kept;
  };
  std::vector<Triangle> triangles(mesh.triangles().begin(), mesh.triangles().end());
  for (Triangle& triangle : triangles) {
    for (uint32_t& vertex : triangle) vertex = renamed(vertex);
  }
  return std::make_shared<TriangleMesh>(std::move(vertices), std::move(triangles));
}

/// Returns the mesh without some triangles.
std::shared_ptr<const TriangleMesh> without(const TriangleMesh& mesh, size_t first, size_t count) {
  const auto place = [&](size_t i) { return mesh.triangles().begin() + std::ptrdiff_t(i); };
  std::vector<Triangle> triangles(mesh.triangles().begin(), place(first));
  triangles.insert(triangles.end(), place(first + count), mesh.triangles().end());
  return std::make_shared<TriangleMesh>(
      std::vector<Vec3>(mesh.vertices().begin(), mesh.vertices().end()), std::move(triangles));
}

/// Returns meshes of fewer vertices or triangles. Of a large mesh they are a sample; once some of
/// them have been taken, all are tried.
std::vector<std::shared_ptr<const TriangleMesh>> smaller_than(const TriangleMesh& mesh) {
  constexpr size_t kMostEdges = 64;
  std::set<std::pair<uint32_t, uint32_t>> edges;
  for (const Triangle& t : mesh.triangles()) {
    for (size_t k = 0; k < 3; ++k) edges.insert({t[k], t[(k + 1) % 3]});
  }
  std::vector<std::shared_ptr<const TriangleMesh>> result;
  const size_t step = edges.size() / kMostEdges + 1;
  size_t index = 0;
  for (const auto& [from, to] : edges) {
    if (index++ % step == 0) result.push_back(collapsed(mesh, from, to));
  }
  constexpr size_t kMostParts = 16;
  const size_t count = mesh.triangles().size();
  for (size_t parts = 2; parts <= kMostParts && parts <= count; parts *= 2) {
    for (size_t i = 0; i < parts; ++i) {
      const size_t first = count * i / parts;
      result.push_back(without(mesh, first, count * (i + 1) / parts - first));
    }
  }
  return result;
}

class MeshTwin final : public ExactTwin {
 public:
  Vector<Exact> middle(const Primitive& primitive) const override {
    const Vec3 center = box_of(*primitive.mesh()).center();
    return {center.x, center.y, center.z};
  }
  void add_surfaces(const Primitive& primitive, const Exact& magnification,
                    Target<Exact>& target) const override {
    target.mesh = std::make_shared<ExactMesh>(primitive.as<csgcore::MeshShape>().mesh,
                                              middle(primitive), magnification);
    const Vec3 size = box_of(*primitive.mesh()).size();
    const double largest = std::max({size.x, size.y, size.z});
    // A flat mesh is taken for a slender one.
    constexpr double kLeastShare = 0x1p-20;
    const Vec3 shares = glm::max(size / largest, Vec3(kLeastShare));
    const Vec3 slender = std::min({shares.x, shares.y, shares.z}) / shares;
    target.weight = slender * slender;
  }
  void merge_box(const Vec3& point, const Primitive& primitive, csgcore::Box& box) const override {
    const TriangleMesh& mesh = *primitive.mesh();
    for (const Triangle& triangle : mesh.triangles()) {
      for (const uint32_t vertex : triangle) {
        merge_point(point, primitive.local_to_world, mesh.vertices()[vertex], box);
      }
    }
  }
  std::string as_cpp(const Primitive& primitive, const std::string& map) const override {
    std::vector<std::string> vertices, triangles;
    for (const std::string& text : vertex_texts(*primitive.mesh())) {
      vertices.push_back("{" + text + "}");
    }
    for (const Triangle& triangle : primitive.mesh()->triangles()) {
      triangles.push_back("{" + text_of(triangle, {0, 1, 2}) + "}");
    }
    return "make_mesh(std::make_shared<TriangleMesh>(std::vector<Vec3>{" + joined(vertices) +
           "}, std::vector<TriangleMesh::Triangle>{" + joined(triangles) + "}), " + map + ")";
  }
  std::string as_openscad(const Primitive& primitive) const override {
    std::vector<std::string> points, faces;
    for (const std::string& text : vertex_texts(*primitive.mesh()))
      points.push_back("[" + text + "]");
    // OpenSCAD's faces are clockwise as seen from outside.
    for (const Triangle& triangle : primitive.mesh()->triangles()) {
      faces.push_back("[" + text_of(triangle, {0, 2, 1}) + "]");
    }
    return "polyhedron([" + joined(points) + "], [" + joined(faces) + "])";
  }
  std::vector<Primitive> simpler(const Primitive& primitive) const override {
    const csgcore::Affine& map = primitive.local_to_world;
    const csgcore::Box box = box_of(*primitive.mesh());
    std::vector<Primitive> result{csgcore::make_sphere(1, map)};
    const Vec3 size = box.size();
    if (size.x > 0 && size.y > 0 && size.z > 0) {
      result.push_back(csgcore::make_polyhedron(csgcore::Polyhedron::box(box), map));
    }
    for (auto& mesh : smaller_than(*primitive.mesh())) {
      if (!mesh->triangles().empty()) result.push_back(csgcore::make_mesh(std::move(mesh), map));
    }
    return result;
  }
};

constexpr MeshTwin kMeshTwin;

}  // namespace

constinit const ExactTwin& Mesh_twin = kMeshTwin;

}  // namespace oracle
