// Designs whose primitives share faces: where set operations that are not regularised leave skins
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

/// The whole family, every primitive mapped by `frame`. Models of about 10 units around its origin,
/// whose shared flat faces are parallel to the frame's xy plane.
std::vector<NamedScene> coincident_scenes(const csgcore::Affine& frame);

}  // namespace gl_test
