// Random designs whose parts touch each other: faces in faces, rims in caps, edges and vertices in
// faces and on edges, from outside and from inside.
#pragma once

#include <cstdint>
#include <string>

namespace validation {

/// Makes a design, both a .csg and a .scad, of 2 to 6 boxes, prisms, pyramids and convex polyhedra
/// on a grid of integers. It depends on the seed alone.
std::string contact_design(uint32_t seed);

}  // namespace validation
