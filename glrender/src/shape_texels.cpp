#include "shape_texels.hpp"

#include <algorithm>
#include <functional>
#include <span>

#include "glrender/gl_error.hpp"

namespace glrender {
namespace {

using csgcore::Polyhedron;
using csgcore::Profile;
using csgcore::TriangleMesh;
using csgcore::Vec2;
using csgcore::Vec3;
using Texel = std::array<float, 4>;

constexpr size_t kNodeTexels = 2, kPieceTexels = 3;

size_t triangle_texels(const TriangleMesh& mesh) { return mesh.colors().empty() ? 3 : 4; }

Texel texel(const std::array<float, 3>& place, size_t number) {
  return {place[0], place[1], place[2], static_cast<float>(number)};
}

size_t texels_of(const TriangleMesh& mesh) {
  return 1 + kNodeTexels * mesh.nodes().size() + triangle_texels(mesh) * mesh.triangles().size();
}

void append_triangle(const TriangleMesh& mesh, uint32_t index, std::vector<Texel>& texels) {
  const Vec3& normal = mesh.planes()[index].normal;
  for (int i = 0; i < 3; ++i) {
    const uint32_t vertex = mesh.triangles()[index][static_cast<size_t>(i)];
    const Vec3& corner = mesh.canonical_vertices()[vertex];
    texels.push_back({static_cast<float>(corner.x), static_cast<float>(corner.y),
                      static_cast<float>(corner.z), static_cast<float>(normal[i])});
  }
  if (mesh.colors().empty()) return;
  const csgcore::Color color = mesh.colors()[index].value_or(csgcore::Color{-1, -1, -1, 1});
  texels.push_back({color.r, color.g, color.b, 0});
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
    texels.push_back(texel(node.min, triangle_texels(mesh) * node.count));
    texels.push_back(texel(node.max, node.count));
    for (uint32_t i = 0; i < node.count; ++i) append_triangle(mesh, node.first + i, texels);
    if (node.count > 0) continue;
    open.push_back({kNone, place});
    open.push_back({node.first + 1, 0});
    open.push_back({node.first, 0});
  }
}

/// Bound on the rounding error of a point's height in canonical space, computed in float as a sum
/// of products of at most 2. A branch's faces are skipped only if they are further away than that.
constexpr double kBranchSlack = 0x1p-19;

PolyhedronTexels::Texel texel(const csgcore::Vec3& normal, uint32_t skip) {
  return {static_cast<float>(normal.x), static_cast<float>(normal.y), static_cast<float>(normal.z),
          static_cast<float>(skip)};
}

Texel texel(const Vec2& first, const Vec2& second) {
  return {static_cast<float>(first.x), static_cast<float>(first.y), static_cast<float>(second.x),
          static_cast<float>(second.y)};
}

size_t texels_of(const Profile& profile) {
  return 1 + kNodeTexels * profile.nodes().size() + kPieceTexels * profile.pieces().size();
}

void append_piece(const Profile::Piece& piece, std::vector<Texel>& texels) {
  // A line has no control point.
  const Vec2 control = piece.is_line() ? piece.start : piece.control;
  texels.push_back(texel(piece.start, control));
  texels.push_back(texel(piece.end, {piece.weight, 0}));
  texels.push_back(texel(piece.end - piece.start, control - piece.start));
}

/// Appends the nodes, depth first, with the pieces of the leaves.
void append_nodes(const Profile& profile, uint32_t index, std::vector<Texel>& texels) {
  const Profile::Node& node = profile.nodes()[index];
  const bool is_leaf = node.children == 0;
  texels.push_back({node.min[0], node.min[1], node.max[0], node.max[1]});
  const size_t place = texels.size();
  texels.push_back({0, is_leaf ? static_cast<float>(node.end - node.begin) : 0.0f, 0, 0});
  if (is_leaf) {
    for (const Profile::Piece& piece :
         profile.pieces().subspan(node.begin, node.end - node.begin)) {
      append_piece(piece, texels);
    }
  } else {
    // The hierarchy is balanced, and so not deep.
    append_nodes(profile, node.children, texels);
    append_nodes(profile, node.children + 1, texels);
  }
  texels[place][0] = static_cast<float>(texels.size() - place - 1);
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
  added_.push_back({static_cast<float>(count - 1), mesh->is_closed() ? 1.0f : 0.0f,
                    static_cast<float>(triangle_texels(*mesh)), 0.0f});
  append_nodes(*mesh, added_);
  size_ += count;
  return place->second;
}

uint32_t PolyhedronTexels::first_of(const Polyhedron* polyhedron) {
  if (!polyhedron) return 0;
  const auto [place, is_new] =
      first_.try_emplace(polyhedron, static_cast<uint32_t>(texels_.size()));
  if (!is_new) return place->second;
  const std::vector<Polyhedron::Entry>& entries = polyhedron->entries();
  // start[i] is the offset of entry i after the polyhedron's header.
  std::vector<uint32_t> start{0};
  for (const Polyhedron::Entry& entry : entries) {
    start.push_back(start.back() + (entry.skip > 0 ? 2 : 1));
  }
  if (texels_.size() + start.back() >= most_texels_) {
    throw GlError("the polyhedra have more faces than OpenGL can number (use a smaller $fn)");
  }
  texels_.push_back({static_cast<float>(start.back())});
  for (size_t i = 0; i < entries.size(); ++i) {
    const Polyhedron::Entry& entry = entries[i];
    texels_.push_back(texel(entry.normal, start[i + 1 + entry.skip] - start[i + 1]));
    if (entry.skip > 0) {
      texels_.push_back({static_cast<float>(entry.limit - kBranchSlack)});
    }
  }
  return place->second;
}

uint64_t face_rounds(const Polyhedron* polyhedron) {
  /// The measured rounds of a polyhedron with thousands of faces; they grow little with the faces.
  constexpr size_t kOfManyFaces = 256;
  return polyhedron ? std::min(polyhedron->entries().size(), kOfManyFaces) : 0;
}

/// Profiles that differ most often differ in their size or their first point.
size_t ProfileTexels::Hash::operator()(const Profile& profile) const {
  size_t hash = profile->pieces().size();
  const auto mix = [&](size_t value) { hash = hash * 0x9E3779B97F4A7C15u + value; };
  mix(static_cast<size_t>(profile->fill_rule()));
  if (profile->loops().empty()) return hash;
  const Vec2& first = profile->loops().front().front().end;
  mix(std::hash<double>()(first.x));
  mix(std::hash<double>()(first.y));
  return hash;
}

uint32_t ProfileTexels::first_of(const Profile& profile) {
  if (!profile) return 0;
  const auto [place, is_new] = first_.try_emplace(profile, static_cast<uint32_t>(size_));
  if (!is_new) return place->second;
  const size_t count = texels_of(*profile);
  if (size_ + count > most_texels_) {
    throw GlError("the profiles have more edges than OpenGL can number (use a smaller $fn)");
  }
  added_.reserve(added_.size() + count);
  const bool is_nonzero = profile->fill_rule() == csgcore::FillRule::kNonZero;
  added_.push_back(texel({static_cast<double>(count - 1), is_nonzero ? 1 : 0}, profile->radii()));
  if (!profile->nodes().empty()) append_nodes(*profile, 0, added_);
  size_ += count;
  return place->second;
}

}  // namespace glrender
