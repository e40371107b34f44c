// textmetrics() and fontmetrics(), measured by the fonts that draw.
#pragma once

#include <memory>

#include "language/text_meter.hpp"

namespace frontend {

/// Returns one for an evaluation: fonts that are installed later are noticed by the next one. It
/// finds no font where the libraries are not installed.
std::shared_ptr<language::TextMeter> make_text_meter();

}  // namespace frontend
