// Reads the example designs, and views them as the command does.
#pragma once

#include <string>

#include "csgcore/view.hpp"
#include "frontend/importer.hpp"

namespace gl_test {

/// Returns a design of examples/, by its name without .scad.
frontend::ImportedDesign example(const std::string& name);

/// Returns the command's view without --camera.
csgcore::View default_view(const frontend::ImportedDesign& design, uint32_t width_px,
                           uint32_t height_px);

}  // namespace gl_test
