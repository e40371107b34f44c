// The drawing by the CPU tracer, csgcore/tracer.hpp.
#pragma once

#include <memory>

#include "render/solid_renderer.hpp"

namespace frontend {

std::unique_ptr<SolidRenderer> make_cpu_renderer();

}  // namespace frontend
