// The meaning of a design: primitives and the trees over them. All of csgcore works on scenes.
#pragma once

#include <cstdint>
#include <vector>

#include "csgcore/csg_tree.hpp"
#include "csgcore/primitive.hpp"

namespace csgcore {

/// A solid that is drawn over what stands before it in the picture.
struct Layer {
  enum class Kind : uint8_t {
    kModel,       // a part of the model
    kBackground,  // a `%` part
    kHighlight,   // a `#` part
  };
  Kind kind = Kind::kModel;
  /// Its far side is drawn before its near side, which lets it shine through.
  bool shows_behind = false;
  CsgTree solid;
};

/// The trees hold indices into `primitives`, each of which is valid (is_valid).
struct Scene {
  std::vector<Primitive> primitives;
  CsgTree model;  // the solid: what is measured, picked and validated
  /// The layers of the picture, from the first that is drawn. Where no layer is of the model, the
  /// model itself is drawn before them, opaque.
  std::vector<Layer> layers;
};

}  // namespace csgcore
