// Writes measurements as tables for people and as JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "measurement.hpp"

namespace bench {

/// Returns the table of one file. It ends with a line break.
std::string table_of(const std::string& file, const Result& result);

/// Returns the JSON of one file, or of one rule; times are in ms. frontend/bench/README.md lists
/// the keys.
nlohmann::ordered_json json_of(const std::string& file, const Result& result);
nlohmann::ordered_json json_of(const RuleTimes& times);

}  // namespace bench
