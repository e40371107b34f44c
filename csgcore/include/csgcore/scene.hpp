// What a design means: primitives and the trees over them. The input of everything in csgcore.
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

/// All trees index into `primitives`, each of which is valid. Data only.
struct Scene {
  std::vector<Primitive> primitives;
  CsgTree model;  // the solid: what is measured, picked and validated
  /// What the picture is composed of, from the first that is drawn. Where no layer is of the model,
  /// the model itself is drawn before them, opaque.
  std::vector<Layer> layers;
};

}  // namespace csgcore
