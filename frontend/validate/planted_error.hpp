// A hook for tests: an error in the scene that is drawn, but not in the one that the oracles judge.
#pragma once

#include <string>

#include "csgcore/scene.hpp"

namespace validation {

/// "flip:K": what the primitive with id K adds is cut away, and what it cuts away is added.
/// "move:K:DISTANCE": primitive K stands so much further along x, in world units. Throws
/// frontend::Error for anything else.
csgcore::Scene with_planted_error(const csgcore::Scene& scene, const std::string& error);

/// Environment variable that holds one; only tests set it.
constexpr const char* kPlantedErrorVariable = "SCADRAY_VALIDATE_PLANTED_ERROR";

}  // namespace validation
