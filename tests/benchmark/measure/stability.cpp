#include "section.hpp"

namespace measure {

nlohmann::json measure_stability(const Settings&) { return {}; }

}  // namespace measure
