#include "named_design.hpp"

#include <utility>

#include "csgcore/solid.hpp"
#include "frame.hpp"
#include "support/models.hpp"
#include "support/read_design.hpp"

namespace frame_benchmark {
namespace {

using csgcore::Scene;

Design import_example(const std::string& name) {
  auto imported = test_support::read_design(std::string(SCADRAY_EXAMPLES_DIR "/") + name + ".scad");
  return {std::move(imported.scene), imported.view_box};
}

}  // namespace

Design make_design(const std::string& name) {
  const std::string kind = name.substr(0, 2);
  if (kind != "CS" && kind != "CC") return import_example(name);
  const auto n = static_cast<uint32_t>(std::stoul(name.substr(2)));
  Scene scene = kind == "CS" ? test_support::cylinder_minus_spheres(n)
                             : test_support::cylinder_minus_cones(n);
  const csgcore::Solid solid(csgcore::canonical_primitives(scene), scene.model);
  return {std::move(scene), solid.bounds()};
}

}  // namespace frame_benchmark
