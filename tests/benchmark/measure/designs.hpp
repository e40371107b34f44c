// Finds or makes the files of the designs that are measured.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "section.hpp"

namespace measure {

/// Returns the .csg of a design of examples/, or of csN or ccN for any N up to 1,000,000: the one
/// in examples/, or one that examples/export makes once, in the work folder. Throws
/// std::runtime_error with openscad's words if it cannot be made.
std::filesystem::path csg_of(const std::string& design, const Settings& settings);
/// The .scad that a design is exported from, with the -D options that csN and ccN need.
struct Source {
  std::filesystem::path file;
  std::vector<std::string> defines;
};
Source scad_of(const std::string& design, const Settings& settings);

}  // namespace measure
