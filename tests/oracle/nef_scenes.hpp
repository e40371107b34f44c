// Trees of polyhedra for the tests of the Nef oracle.
#pragma once

#include <functional>
#include <random>
#include <string>
#include <vector>

#include "openscad_mesh.hpp"
#include "oracle/nef_solid.hpp"

namespace oracle {

/// A tree and the polyhedra that it indexes into.
struct NefScene {
  csgcore::CsgTree tree;
  std::vector<FacetedSolid> polyhedra;
};

FacetedSolid box(const csgcore::Vec3& min, const csgcore::Vec3& max,
                     const csgcore::Affine& local_to_world = {});
FacetedSolid sphere(double radius, int fragments, const csgcore::Affine& local_to_world = {});
FacetedSolid frustum(double z_min, double z_max, double r_bottom, double r_top, int fragments,
                         const csgcore::Affine& local_to_world = {});
csgcore::Affine shift(const csgcore::Vec3& by);

/// One operation over all polyhedra.
NefScene scene_of(csgcore::Op op, std::vector<FacetedSolid> polyhedra);

/// Builds the solid. On failure it fails the test, and returns an empty solid.
std::unique_ptr<const NefSolid> build(const NefScene& scene);

using test_support::volume_of;

/// A tree over `count` boxes, spheres and frusta of up to 8 fragments under random affine maps,
/// some of which share planes, and the same design for OpenSCAD.
struct RandomScene {
  NefScene scene;
  std::string scad;
};
RandomScene random_scene(uint32_t count, uint32_t seed);

}  // namespace oracle
