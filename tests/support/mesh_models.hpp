// Triangle meshes made in memory for tests.
#pragma once

#include <initializer_list>
#include <memory>
#include <vector>

#include "csgcore/triangle_mesh.hpp"

namespace test_support {

/// What a mesh is made of. Its triangles are counterclockwise as seen from outside.
struct Shell {
  std::vector<csgcore::Vec3> vertices;
  std::vector<csgcore::TriangleMesh::Triangle> triangles;
};

std::shared_ptr<const csgcore::TriangleMesh> mesh_of(Shell shell);

Shell box_shell(const csgcore::Vec3& min, const csgcore::Vec3& max);
/// A box without its upper side.
Shell open_box_shell(const csgcore::Vec3& min, const csgcore::Vec3& max);
/// A square in the xy plane from the origin to (side, side), of so many squares of 1 × 1; it is
/// open.
Shell sheet_shell(uint32_t side);
/// Such squares at z = 0 and z = 1, with walls between them.
Shell slab_shell(uint32_t side);
/// A square in the xy plane from the origin to (2, 2), without its quarter at (2, 2), from z = 0 up
/// to the height.
Shell l_prism_shell(double height);
/// A torus around the z axis of 2 · around · across triangles.
Shell torus_shell(double ring_radius, double tube_radius, uint32_t around, uint32_t across);
/// A round rod that is wound up around the z axis, from z = 0 on, with so many steps to a turn. Its
/// ends are plane.
Shell coil_shell(double ring_radius, double rod_radius, double pitch, uint32_t turns,
                 uint32_t steps, uint32_t across);
/// A ball of 8 · 4^divisions triangles, of which none is larger than twice another one.
Shell ball_shell(double radius, uint32_t divisions, const csgcore::Vec3& center = {});

/// Turns the shell inside out.
Shell reversed(Shell shell);
/// Returns one shell with the triangles of all.
Shell joined(std::initializer_list<Shell> shells);

}  // namespace test_support
