#include "process/openscad_program.hpp"

#include <cstdlib>

namespace frontend {

std::string openscad_program() {
  const char* name = std::getenv("OPENSCAD");
  return name && *name ? name : "openscad";
}

}  // namespace frontend
