// The designs that are measured, as files and as scenes.
#pragma once

#include <filesystem>
#include <string>

#include "csgcore/scene.hpp"
#include "section.hpp"

namespace measure {

/// The .csg of a design of examples/, or of csN or ccN for any N up to 1,000,000: that of
/// examples/, or one that examples/export makes in the work folder, once. Throws
/// std::runtime_error with openscad's words where it cannot be made.
std::filesystem::path csg_of(const std::string& design, const Settings& settings);
/// The .scad that it is exported from, with the -D options that csN and ccN need.
struct Source {
  std::filesystem::path file;
  std::vector<std::string> defines;
};
Source scad_of(const std::string& design, const Settings& settings);

/// The design as scadray reads its .csg; with what is round in so many facets if `facets` ≥ 3.
csgcore::Scene scene_of(const std::string& design, const Settings& settings, uint32_t facets = 0);

}  // namespace measure
