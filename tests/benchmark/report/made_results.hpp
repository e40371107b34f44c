// Invented results, for the tests of the report.
#pragma once

#include <nlohmann/json.hpp>

namespace made {

/// A Summary with that median, and quartiles of 0.95 and 1.1 times the median.
nlohmann::json times(double median);
/// A results file with these sections, on an invented machine.
nlohmann::json results_of(nlohmann::json sections);
/// The section "whole".
nlohmann::json whole();

}  // namespace made
