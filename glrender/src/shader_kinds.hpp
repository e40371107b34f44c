// Composes the shaders' code for the kinds of primitives.
#pragma once

#include <string>

#include "kind_set.hpp"

namespace glrender {

/// Returns GLSL that defines the functions that ray.glsl declares: the files of the given kinds
/// alone (shaders/sphere.glsl and so on), and code that calls their functions by a primitive's
/// kind.
///
/// `enclosures` are the kinds of the convex primitives' enclosures, each of which has a segment of
/// its own. `cuts` are the kinds of the primitives whose enclosure is of another kind, which cut
/// its segment. `nonconvex` are the kinds of primitives that are not convex.
std::string kinds_source(KindSet enclosures, KindSet cuts, KindSet nonconvex);

}  // namespace glrender
