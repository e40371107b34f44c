#pragma once

#include <filesystem>

#include "csgcore/scene.hpp"

namespace stress {

/// Imports a .csg, or a .scad as OpenSCAD exports it.
csgcore::Scene import_design_file(const std::filesystem::path& file);

}  // namespace stress
