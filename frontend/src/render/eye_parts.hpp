// What an eye within a solid sees of it. OpenSCAD's preview draws product after product, so that
// from within one the surfaces of others are seen (frontend/OPENSCAD.md, "Leaves").
#pragma once

#include <memory>
#include <vector>

#include "csgcore/blist.hpp"
#include "csgcore/scene.hpp"
#include "csgcore/solid.hpp"
#include "render/layers.hpp"

namespace frontend {

/// The products of a solid, and the layers that show it from within some of them.
class EyeParts {
 public:
  /// `tree` is one of the scene's.
  EyeParts(const csgcore::Scene& scene,
           std::shared_ptr<const csgcore::CanonicalPrimitives> primitives,
           csgcore::Layer::Kind kind, const csgcore::CsgTree& tree);

  using Layers = std::vector<std::unique_ptr<const PreparedLayer>>;
  /// Returns layers which together show the nearest surface of any product, and the last of
  /// coincident ones. None: there are no two products. `on_end` is called before layers of an
  /// earlier call end.
  template <typename OnEnd>
  const Layers& layers(const csgcore::Vec3& eye, const OnEnd& on_end) {
    std::vector<bool> holding = products_that_hold(eye);
    if (holding != holding_) {
      if (!layers_.empty()) on_end();
      make_layers(holding);
      holding_ = std::move(holding);
    }
    return layers_;
  }

 private:
  struct Product {
    csgcore::CsgTree solid;
    csgcore::Blist list;
  };
  std::vector<bool> products_that_hold(const csgcore::Vec3& eye) const;
  void make_layers(const std::vector<bool>& holding);

  std::shared_ptr<const csgcore::CanonicalPrimitives> primitives_;
  csgcore::Layer::Kind kind_;
  std::vector<Product> products_;
  std::vector<bool> holding_;  // by product, whether it holds the eye of layers_
  Layers layers_;
};

}  // namespace frontend
