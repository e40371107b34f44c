#include "section.hpp"

namespace measure {

nlohmann::json measure_error(const Settings&) { return {}; }

}  // namespace measure
