#include "mesh_texels.hpp"

#include <functional>
#include <span>

#include "glrender/context.hpp"

namespace glrender {
namespace {

using csgcore::TriangleMesh;
using csgcore::Vec3;
using Texel = MeshTexels::Texel;

constexpr size_t kNodeTexels = 2, kTriangleTexels = 3;

Texel texel(const std::array<float, 3>& place, size_t number) {
  return {place[0], place[1], place[2], static_cast<float>(number)};
}

size_t texels_of(const TriangleMesh& mesh) {
  return 1 + kNodeTexels * mesh.nodes().size() + kTriangleTexels * mesh.triangles().size();
}

void append_triangle(const TriangleMesh& mesh, uint32_t index, std::vector<Texel>& texels) {
  const Vec3& normal = mesh.planes()[index].normal;
  for (int i = 0; i < 3; ++i) {
    const uint32_t vertex = mesh.triangles()[index][static_cast<size_t>(i)];
    const Vec3& corner = mesh.canonical_vertices()[vertex];
    texels.push_back({static_cast<float>(corner.x), static_cast<float>(corner.y),
                      static_cast<float>(corner.z), static_cast<float>(normal[i])});
  }
}

/// Appends the nodes, depth first, with the triangles of the leaves.
void append_nodes(const TriangleMesh& mesh, std::vector<Texel>& texels) {
  constexpr uint32_t kNone = 0xFFFFFFFFu;
  // A visit either writes a node, or notes in the texel of a branch where its children end.
  struct Visit {
    uint32_t node;
    size_t branch;
  };
  std::vector<Visit> open;
  if (!mesh.nodes().empty()) open.push_back({0, 0});
  while (!open.empty()) {
    const Visit visit = open.back();
    open.pop_back();
    if (visit.node == kNone) {
      texels[visit.branch][3] = static_cast<float>(texels.size() - visit.branch - kNodeTexels);
      continue;
    }
    const TriangleMesh::Node& node = mesh.nodes()[visit.node];
    const size_t place = texels.size();
    texels.push_back(texel(node.min, kTriangleTexels * node.count));
    texels.push_back(texel(node.max, node.count));
    for (uint32_t i = 0; i < node.count; ++i) append_triangle(mesh, node.first + i, texels);
    if (node.count > 0) continue;
    open.push_back({kNone, place});
    open.push_back({node.first + 1, 0});
    open.push_back({node.first, 0});
  }
}

}  // namespace

/// Meshes that differ most often differ in their size or their first vertex.
size_t MeshTexels::Hash::operator()(const Mesh& mesh) const {
  size_t hash = mesh->triangles().size();
  const auto mix = [&](size_t value) { hash = hash * 0x9E3779B97F4A7C15u + value; };
  mix(mesh->vertices().size());
  if (mesh->vertices().empty()) return hash;
  const Vec3& first = mesh->vertices().front();
  for (int axis = 0; axis < 3; ++axis) mix(std::hash<double>()(first[axis]));
  return hash;
}

uint32_t MeshTexels::first_of(const Mesh& mesh) {
  if (!mesh) return 0;
  const auto [place, is_new] = first_.try_emplace(mesh, static_cast<uint32_t>(size_));
  if (!is_new) return place->second;
  const size_t count = texels_of(*mesh);
  if (size_ + count > most_texels_) {
    throw GlError("the meshes have more triangles than OpenGL can number (use coarser meshes)");
  }
  added_.reserve(added_.size() + count);
  added_.push_back({static_cast<float>(count - 1), mesh->is_closed() ? 1.0f : 0.0f, 0.0f, 0.0f});
  append_nodes(*mesh, added_);
  size_ += count;
  return place->second;
}

}  // namespace glrender
