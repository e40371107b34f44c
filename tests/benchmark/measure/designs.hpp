// The files of the designs that are measured.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

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

}  // namespace measure
