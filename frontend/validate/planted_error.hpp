// A hook for tests: plants an error in the scene that is drawn, but not in the one the oracles
// judge.
#pragma once

#include <string>

#include "csgcore/scene.hpp"

namespace validation {

/// "flip:K" cuts away what the primitive with id K adds, and adds what it cuts away.
/// "move:K:DISTANCE" moves primitive K by DISTANCE along x, in world units. Throws frontend::Error
/// for any other `error`.
csgcore::Scene with_planted_error(const csgcore::Scene& scene, const std::string& error);

/// The environment variable that holds the error; only tests set it.
constexpr const char* kPlantedErrorVariable = "SCADRAY_VALIDATE_PLANTED_ERROR";

}  // namespace validation
