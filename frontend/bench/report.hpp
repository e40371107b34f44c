// What was measured, as tables for people and as JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "measurement.hpp"

namespace bench {

/// A file's. Ends with a line break.
std::string table_of(const std::string& file, const Result& result);

/// A file's, and a rule's; times in ms. frontend/bench/README.md lists the keys.
nlohmann::ordered_json json_of(const std::string& file, const Result& result);
nlohmann::ordered_json json_of(const RuleTimes& times);

}  // namespace bench
