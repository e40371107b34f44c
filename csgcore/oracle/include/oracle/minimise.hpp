// Small scenes from large ones: what a disagreement between two renderers comes down to.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "csgcore/scene.hpp"

namespace oracle {

/// Whether the scene shows what is looked for.
using Shows = std::function<bool(const csgcore::Scene&)>;

/// How often a scene may be tried: a few hundred times do for a dozen primitives.
constexpr uint32_t kMostTries = 5000;

/// A scene that still `shows`, as `scene` does, and that no single step makes smaller: no operand,
/// operation or primitive can be left out, no polyhedron become a simpler one, no number a rounder
/// one. Only the model is kept; primitives stay in order, their ids become their indices. Gives up
/// after `most_tries` calls of `shows`, with the smallest scene so far.
csgcore::Scene minimise(const csgcore::Scene& scene, const Shows& shows,
                        uint32_t most_tries = kMostTries);

/// The model as statements of C++ that make the same scene, bit for bit, in a variable `scene`: for
/// a test that is `using namespace csgcore`.
std::string as_cpp(const csgcore::Scene& scene);

/// The model for OpenSCAD, whose smooth primitives have its default facets. All digits, but a
/// polyhedron's vertices are rounded.
std::string as_openscad(const csgcore::Scene& scene);

}  // namespace oracle
