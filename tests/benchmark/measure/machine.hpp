// Describes the machine, and what was measured.
#pragma once

#include <nlohmann/json.hpp>

#include "section.hpp"

namespace measure {

/// Returns "processor", "cores", "instruction_set" (of csgcore's packets), "memory_bytes",
/// "system", "compiler", "commit" (of the working tree; with "+" if it was changed), "date" (UTC),
/// and "versions" of every peer that the machine has, by name.
nlohmann::json describe_machine(const Settings& settings);

}  // namespace measure
