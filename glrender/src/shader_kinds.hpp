// The shaders' code for each kind of primitive, and the code that calls it.
#pragma once

#include <string>

#include "kind_set.hpp"

namespace glrender {

/// GLSL that defines what ray.glsl declares of the kinds. It holds the files of these kinds alone
/// (shaders/sphere.glsl and so on), and code that calls their functions by the kind of a primitive.
///
/// `enclosures` are the kinds that have a segment of their own, as primitives or as what encloses
/// primitives of another kind; `cuts` are those other kinds, which cut the enclosure's segment.
std::string kinds_source(KindSet enclosures, KindSet cuts);

}  // namespace glrender
