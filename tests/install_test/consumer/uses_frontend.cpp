// A text becomes a scene of two primitives; a broken one is an error with its place.
#include <string>

#include "frontend/error.hpp"
#include "frontend/importer.hpp"
#include "frontend/parser.hpp"

int main() {
  const auto design = frontend::import_design(
      frontend::parse("difference() { sphere(r = 2); sphere(r = 1); }", "two.csg"));
  if (design.scene.primitives.size() != 2) return 1;
  try {
    frontend::parse("sphere(r = 2", "broken.csg");
  } catch (const frontend::Error& error) {
    return std::string(error.what()).starts_with("broken.csg:1:") ? 0 : 1;
  }
  return 1;
}
