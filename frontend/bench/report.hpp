// Writes measurements as tables for people.
#pragma once

#include <string>

#include "measurement.hpp"

namespace bench {

/// Returns the table of what measure() returns of a file. It ends with a line break.
std::string table_of(const std::string& file, const Json& result);

}  // namespace bench
