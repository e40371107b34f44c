// A ball of radius 2 contains its centre, and not a point 3 away.
#include "csgcore/scene.hpp"
#include "csgcore/solid.hpp"

int main() {
  csgcore::Scene scene;
  scene.primitives.push_back(csgcore::make_sphere(2));
  csgcore::CsgTreeBuilder builder;
  builder.primitive(0);
  scene.model = builder.finish();
  const csgcore::Solid solid(csgcore::canonical_primitives(scene), scene.model);
  const bool right = solid.contains({0, 0, 0}) && !solid.contains({3, 0, 0});
  return right ? 0 : 1;
}
