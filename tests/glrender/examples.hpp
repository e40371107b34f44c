// Reads the example designs, and views them as the command does.
#pragma once

#include <filesystem>

#include "csgcore/view.hpp"
#include "frontend/importer.hpp"

namespace gl_test {

/// Imports a .csg, or a .scad whose .csg is too large to be kept beside it.
frontend::ImportedDesign read_design(const std::filesystem::path& file);

/// Returns the command's view without --camera.
csgcore::View default_view(const frontend::ImportedDesign& design, uint32_t width_px,
                           uint32_t height_px);

}  // namespace gl_test
