// The settings of -O.
#pragma once

#include <string>

#include "frontend/export_settings.hpp"

namespace frontend {

/// Reads a value of -O, SECTION/KEY=VALUE. Returns what is wrong with it, for a warning; then the
/// settings stay as they are. OpenSCAD 2025.07 goes on, too.
std::string read_export_setting(const std::string& text, ExportSettings& settings);

/// Returns the text of --help-export, in OpenSCAD's form, with scadray's defaults.
std::string export_settings_text();

}  // namespace frontend
