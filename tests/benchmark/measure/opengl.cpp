#include "section.hpp"

namespace measure {

nlohmann::json measure_opengl(const Settings&) { return {}; }

}  // namespace measure
