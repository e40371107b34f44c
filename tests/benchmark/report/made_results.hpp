// Results that nobody has measured, for the tests of the report.
#pragma once

#include <nlohmann/json.hpp>

namespace made {

/// A Summary of that median; the quartiles at 0.95 and 1.1 times.
nlohmann::json times(double median);
/// A results file of these sections, on a machine of no brand.
nlohmann::json results_of(nlohmann::json sections);
/// The section of that name.
nlohmann::json whole();

}  // namespace made
