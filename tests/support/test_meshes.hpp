// Triangle meshes of many shapes. All are closed and oriented outwards unless a name says
// otherwise.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <memory>
#include <random>
#include <vector>

#include "csgcore/facets.hpp"
#include "csgcore/triangle_mesh.hpp"

namespace test_support {

/// Vertices and triangles from which a mesh is made.
struct MeshParts {
  std::vector<csgcore::Vec3> vertices;
  std::vector<csgcore::TriangleMesh::Triangle> triangles;

  uint32_t add(const csgcore::Vec3& vertex);
  void add(const MeshParts& other);  // as a shell of its own
  MeshParts moved(const csgcore::Vec3& offset) const;
  MeshParts scaled(const csgcore::Vec3& factors) const;  // each > 0
  MeshParts inside_out() const;
  std::shared_ptr<const csgcore::TriangleMesh> mesh() const;
};

/// The same solid, whose faces are cut into triangles from their first vertex.
MeshParts parts_of(const csgcore::Mesh& mesh);
MeshParts tetrahedron_parts(double scale);
MeshParts box_parts(const csgcore::Vec3& min, const csgcore::Vec3& max);
/// A box without its upper side.
MeshParts open_box_parts(const csgcore::Vec3& min, const csgcore::Vec3& max);
/// A square in the xy plane from the origin to (side, side), of so many squares of 1 × 1; it is
/// open.
MeshParts sheet_parts(uint32_t side);
/// Such squares at z = 0 and z = 1, with walls between them.
MeshParts slab_parts(uint32_t side);
/// A box whose sides are divided by `cuts` lines in both directions, some of them so close to
/// others that the triangles between them are slivers.
MeshParts sliced_box_parts(const csgcore::Vec3& half, uint32_t cuts, std::mt19937& random);
/// A prism over an L: two bars of that thickness along the x and y axes, which are `length` long.
MeshParts l_prism_parts(double length, double thickness, double height);
/// A torus about the z axis.
MeshParts torus_parts(double radius, double tube_radius, uint32_t around, uint32_t across);
/// A tube along a helix about the z axis.
MeshParts helix_parts(double radius, double tube_radius, double pitch, double turns,
                      uint32_t per_turn, uint32_t across);
/// An icosahedron whose triangles are divided so often into four, on a sphere.
MeshParts icosphere_parts(double radius, uint32_t divisions);
/// A block over [0, size]² whose top is a height field of cells², with heights in [low, high].
MeshParts height_field_parts(double size, uint32_t cells, double low, double high,
                             std::mt19937& random);
/// A ball of random radii in [low, high], which every ray from the origin leaves once.
MeshParts star_parts(double low, double high, uint32_t divisions, std::mt19937& random);
/// One mesh of several shells.
MeshParts joined(std::initializer_list<MeshParts> shells);
/// The mesh without some of its triangles, at random.
MeshParts with_holes(const MeshParts& parts, double share, std::mt19937& random);

}  // namespace test_support
