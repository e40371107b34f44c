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
  /// An operand of the solid.
  struct Part {
    CsgTree solid;
    bool is_subtracted = false;
  };
  /// The operands whose surfaces are blended once more wherever the picture shows a surface that
  /// coincides with theirs, though the layer is not seen there.
  std::vector<Part> parts{};
};

/// The trees hold indices into `primitives`, each of which is valid (is_valid).
struct Scene {
  std::vector<Primitive> primitives;
  CsgTree model;  // the solid: what is measured, picked and validated
  /// The layers of the picture, from the first that is drawn. Where no layer is of the model, the
  /// model itself is drawn before them, opaque.
  std::vector<Layer> layers;
  /// Which primitives make one leaf, whose surface is seen as a whole (frontend/OPENSCAD.md,
  /// "Leaves"): by primitive, the index of one of its leaf. Primitives beyond the end of this are
  /// leaves by themselves. It counts only for an eye within the solid.
  std::vector<uint32_t> leaf_of{};
};

}  // namespace csgcore
