// Designs whose primitives share faces, where set operations that are not regularised leave skins
// and speckle.
#pragma once

#include <string>
#include <vector>

#include "csgcore/scene.hpp"

namespace gl_test {

struct NamedScene {
  std::string name;
  double face_z;  // height of a face that several primitives share, in the frame
  csgcore::Scene scene;
};

/// Returns the whole family, with every primitive mapped by `frame`. The models are about 10 units
/// in size around its origin, and their shared flat faces are parallel to its xy plane.
std::vector<NamedScene> coincident_scenes(const csgcore::Affine& frame);

}  // namespace gl_test
