// A scene's model, prepared for exact rays.
#pragma once

#include "box_tree.hpp"
#include "csgcore/scene.hpp"
#include "exact_primitive.hpp"
#include "tree_value.hpp"

namespace oracle {

struct PreparedScene {
  explicit PreparedScene(const csgcore::Scene& prepared);

  const csgcore::Scene& scene;
  csgcore::Vec3 pivot;  // near the model's middle, in world space
  double size;          // this and the next two are those of ExactScene
  double thickness;
  double displacement;
  /// The prepared unit, a power of two. Rays, targets and boxes are in world space multiplied by
  /// it, where the model is about 1 across.
  double unit;
  TreeValue outside;  // the tree's value outside of all primitives, where rays begin
  // By primitive:
  std::vector<Target<Exact>> exact;
  std::vector<Target<Interval>> intervals;
  std::vector<uint32_t> first_alike;  // the first primitive with the same shape, numbers and matrix
  BoxTree boxes;                // of the primitives that the model names, relative to the pivot
  std::vector<uint32_t> boxed;  // by item of that tree, the primitive's index
};

}  // namespace oracle
