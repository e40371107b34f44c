// Designs as OpenSCAD exports them, with 6 digits to a number. Faces that coincide in the design do
// so again once the importer has healed them.
#include <string>

#include "cases.hpp"
#include "frontend/importer.hpp"
#include "frontend/openscad_export.hpp"
#include "frontend/parser.hpp"

namespace stress {
namespace {

Scene import_scad(const std::string& file) {
  const auto ignore_message = [](const std::string&) {};
  const frontend::FileText csg =
      frontend::export_with_openscad(file, {}, ignore_message, [] {}).csg;
  return frontend::import_design(frontend::parse(csg.view(), file)).scene;
}

}  // namespace

std::vector<Family> design_families() {
  const auto add = [](Family& family, const char* name) {
    const std::string file = std::string(SCADRAY_STRESS_DESIGNS "/") + name + ".scad";
    family.cases.push_back({name, [file] { return import_scad(file); }});
  };
  Family round{"openscad_designs", {}, true};
  for (const char* name : {"turned_plate", "nested_frames", "mirrored_halves", "chain_of_frames",
                           "sleeves", "scaled_frames", "pegs", "sockets"}) {
    add(round, name);
  }
  Family cubes{"openscad_cubes", {}, true};
  for (const char* name : {"turned_cubes", "thirds_of_cubes", "chain_of_cubes"}) add(cubes, name);
  return {round, cubes};
}

}  // namespace stress
