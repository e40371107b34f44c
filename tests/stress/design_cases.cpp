// Designs as OpenSCAD exports them, with 6 digits to a number. Faces that coincide in the design do
// so again once the importer has healed them.
#include <string>

#include "cases.hpp"
#include "designs.hpp"
#include "frontend/files.hpp"
#include "frontend/importer.hpp"
#include "frontend/openscad_export.hpp"
#include "frontend/parser.hpp"

namespace stress {

Scene import_design_file(const std::filesystem::path& file) {
  const auto ignore_message = [](const std::string&) {};
  const frontend::FileText text =
      file.extension() == ".scad"
          ? frontend::export_with_openscad(file.string(), {}, false, ignore_message, [] {}).csg
          : frontend::read_file(file.string());
  return frontend::import_design(frontend::parse(text.view(), file.filename().string())).scene;
}

std::vector<Family> design_families() {
  const auto add = [](Family& family, const char* name) {
    const auto file = std::filesystem::path(SCADRAY_STRESS_DESIGNS) / (std::string(name) + ".scad");
    family.cases.push_back({name, [file] { return import_design_file(file); }});
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
