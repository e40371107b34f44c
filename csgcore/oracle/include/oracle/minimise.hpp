// Reduces a scene in which two renderers disagree to a small one.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "csgcore/scene.hpp"

namespace oracle {

/// Returns whether the scene shows the disagreement that is being looked for.
using Shows = std::function<bool(const csgcore::Scene&)>;

/// The default limit of tries. A few hundred are enough for a dozen primitives.
constexpr uint32_t kMostTries = 5000;

/// Returns a scene that `shows` accepts, as it accepts `scene`, and that no single step makes
/// smaller: no operand, operation or primitive can be left out, no polyhedron or mesh can become a
/// simpler one, no number a rounder one. Only the model is kept. Primitives keep their order, and their
/// indices become their ids. After `most_tries` calls of `shows`, returns the smallest scene so
/// far.
csgcore::Scene minimise(const csgcore::Scene& scene, const Shows& shows,
                        uint32_t most_tries = kMostTries);

/// Returns the model as C++ statements that make the same scene, bit for bit, in a variable
/// `scene`. They are meant for a test with `using namespace csgcore`.
std::string as_cpp(const csgcore::Scene& scene);

/// Returns the model as OpenSCAD code, with all digits, except that a polyhedron's vertices are
/// rounded. OpenSCAD gives smooth primitives its default facets.
std::string as_openscad(const csgcore::Scene& scene);

}  // namespace oracle
