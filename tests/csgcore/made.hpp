// A scene with what was made of it.
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
};

}  // namespace csgcore::checks
