// The options of `scadray validate`, without the code that reads them, for frontend/packaging. This
// file does not need CGAL.
#pragma once

#include <span>

#include "command/option_row.hpp"

namespace validation {

std::span<const frontend::OptionRow> option_rows();

}  // namespace validation
