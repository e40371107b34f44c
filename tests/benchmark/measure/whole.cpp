#include "section.hpp"

namespace measure {

nlohmann::json measure_whole(const Settings&) { return {}; }

}  // namespace measure
