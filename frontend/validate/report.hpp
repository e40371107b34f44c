// What a validation found, as a table for people and as JSON.
#pragma once

#include <string>

#include "validation.hpp"

namespace validation {

/// Ends with a line break. Errors are shares of the design's size; of the volume, of itself.
std::string table_of(const Result& result);

/// With the disagreements of every check; primitives are named by their ids
/// (csgcore/primitive.hpp), /// coordinates are in the design's units times 2^`exponent`.
std::string report_of(const Result& result, const std::string& file, const Settings& settings,
                      int exponent);

}  // namespace validation
