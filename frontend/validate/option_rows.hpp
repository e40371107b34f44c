// The options of `scadray validate`. Apart from what reads them, for frontend/packaging: no CGAL
// here.
#pragma once

#include <span>

#include "command/option_row.hpp"

namespace validation {

std::span<const frontend::OptionRow> option_rows();

}  // namespace validation
