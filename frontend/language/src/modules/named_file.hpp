// The files that nodes name: import(), surface(), and extrusions of files.
#pragma once

#include <cstdint>
#include <string>

#include "modules/builtin_call.hpp"

namespace language {

struct NamedFile {
  std::string path;       // as the .csg names it: relative to the main file's folder
  int64_t timestamp = 0;  // when it was changed last, in whole seconds; 0: it is not there
};

/// Finds the file that a node names: in the folder of the code's unit, else in the main file's. An
/// empty name is no file. Notes what was looked at in the call's environment.
NamedFile find_named_file(const BuiltinCall& call, const std::string& name);

}  // namespace language
