// The programs `scadray`, which draws by the CPU, and `scadray-gl`, which scadray executes where
// OpenGL may draw: OpenGL's loader takes a tenth of a start.
#include "frontend/command.hpp"
#include "frontend/interrupt.hpp"
#include "frontend/render.hpp"

int main(int argc, char** argv) {
  frontend::handle_interrupts();
  const std::vector<std::string> arguments(argv + (argc > 0 ? 1 : 0), argv + argc);
  return static_cast<int>(
      frontend::run_command(arguments, frontend::render, frontend::needs_gl_program));
}
