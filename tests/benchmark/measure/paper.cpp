#include "section.hpp"

namespace measure {

nlohmann::json measure_paper(const Settings&) { return {}; }

}  // namespace measure
