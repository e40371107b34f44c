// Vectors among the values of arguments, and values as messages write them.
#pragma once

#include <optional>
#include <string>

#include "csg/argument_value.hpp"
#include "csgcore/geometry.hpp"
#include "plane/figure.hpp"

namespace frontend {

/// Returns two numbers; nothing where the value is none.
std::optional<Vec2> pair_of(const ArgumentValue& value);
/// Returns a list of `fewest` to three numbers, of which those that are not there are 0.
std::optional<csgcore::Vec3> vector_of(const ArgumentValue& list, size_t fewest);

/// Returns a value as OpenSCAD prints it.
std::string printed_text(const ArgumentValue& value);
/// The same, but for what is long: strings, long lists and lists in lists.
std::string short_text(const ArgumentValue& value);

}  // namespace frontend
