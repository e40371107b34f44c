// What a .scad is evaluated with, besides its files and OpenSCAD's options.
#pragma once

#include <optional>

#include "language/parameter_value.hpp"

namespace frontend {

struct DesignInputs {
  /// In place of the parameter set that -p and -P name.
  std::optional<language::ParameterSet> parameters;
  /// $t. Openscad takes it by -D, behind the assignments of the design's own top level.
  std::optional<double> time;

  bool operator==(const DesignInputs&) const = default;
};

}  // namespace frontend
