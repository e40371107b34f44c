#include "designs.hpp"

#include <stdexcept>

#include "process.hpp"

namespace measure {
namespace {

/// openscad takes minutes for a million spheres.
constexpr double kExportLimit_s = 1800;

}  // namespace

std::filesystem::path csg_of(const std::string& design, const Settings& settings) {
  const std::string file = design + ".csg";
  const std::filesystem::path ready = settings.examples / file;
  if (std::filesystem::exists(ready)) return ready;
  const std::filesystem::path made = settings.work_folder / file;
  if (std::filesystem::exists(made)) return made;
  say("exporting " + design + " by openscad");
  const ProcessResult result = run_process(
      {settings.examples / "export", "-o", settings.work_folder, design}, {kExportLimit_s});
  if (!result.succeeded()) throw std::runtime_error(design + ".csg: " + result.output);
  return made;
}

Source scad_of(const std::string& design, const Settings& settings) {
  const std::filesystem::path file = settings.examples / (design + ".scad");
  if (std::filesystem::exists(file)) return {file, {}};
  const std::string cutter = design.starts_with("cc") ? "cone" : "sphere";
  return {settings.examples / "cut_cylinder.scad",
          {"-Dn=" + design.substr(2), "-Dcutter=\"" + cutter + "\""}};
}

}  // namespace measure
