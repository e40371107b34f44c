// The options of `scadray bench`, without the code that reads them, for frontend/packaging.
#pragma once

#include <span>

#include "command/option_row.hpp"

namespace bench {

std::span<const frontend::OptionRow> option_rows();

}  // namespace bench
