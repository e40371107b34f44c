// Scenes and views for the tests of the tracer.
#pragma once

#include <string>
#include <vector>

#include "csgcore/scene.hpp"
#include "csgcore/view.hpp"

namespace csgcore::checks {

struct NamedScene {
  std::string name;
  Scene scene;
};
struct NamedView {
  std::string name;
  View view;
};

/// Returns scenes of many kinds: empty, of one primitive, random, with coincident faces, with
/// pieces and gaps of about the tolerance, with hundreds of parts that are not seen.
std::vector<NamedScene> trace_scenes();
NamedScene trace_scene(const std::string& name);

/// Many small parts in, behind and in front of large ones, some of which cut them away.
Scene crowd(uint32_t seed);

/// Returns views of both projections: from outside, along the axes, from within the bounds, close
/// up.
std::vector<NamedView> trace_views(const Box& bounds, uint32_t width_px, uint32_t height_px);

Affine moved(const Vec3& by);

/// Parses a tree in prefix notation, of primitives below 10: "(- 0 1 (+ 2 3))".
CsgTree tree_of(const std::string& text);

}  // namespace csgcore::checks
