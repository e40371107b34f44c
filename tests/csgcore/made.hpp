// A design's state between two saves, with what was made of it.
#pragma once

#include <memory>
#include <utility>

#include "csgcore/solid.hpp"

namespace csgcore::checks {

struct Made {
  Scene scene;
  std::shared_ptr<const CanonicalPrimitives> primitives;
  Solid solid;

  explicit Made(Scene anew)
      : scene(std::move(anew)),
        primitives(canonical_primitives(scene)),
        solid(primitives, scene.model) {}
  /// Makes the later state from the earlier one.
  Made(Scene later, const Made& earlier, const SceneEdit& edit)
      : scene(std::move(later)),
        primitives(canonical_primitives(scene, *earlier.primitives, edit)),
        solid(primitives, scene.model, earlier.solid, edit, edit.model) {}
};

}  // namespace csgcore::checks
