// Writes the result of a validation as a table for people and as JSON.
#pragma once

#include <string>

#include "validation.hpp"

namespace validation {

/// Returns the table. It ends with a line break. Errors are shares of the design's size; that of
/// the volume is a share of the volume.
std::string table_of(const Result& result);

/// Returns the JSON with the disagreements of every check. Primitives are named by their ids
/// (csgcore/primitive.hpp), and coordinates are in the design's units times 2^`exponent`.
std::string report_of(const Result& result, const std::string& file, const Settings& settings,
                      int exponent);

}  // namespace validation
