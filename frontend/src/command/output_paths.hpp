// The names of the outputs, frame by frame, and the rule for make that has them as targets.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "frontend/files.hpp"
#include "frontend/options.hpp"

namespace frontend {

/// Returns how many times the design is evaluated: for each frame of an animation, or once.
uint32_t frame_count(const Options& options);

/// Returns the $t of a frame; nothing without an animation.
std::optional<double> frame_time(const Options& options, uint32_t frame);

/// Returns OpenSCAD's name of an output for a frame: of an animation, with five digits before the
/// suffix. Messages have one file for all frames.
std::string path_of(const Output& output, const Options& options, uint32_t frame);
std::string path_of(const TextOutput& output, const Options& options, uint32_t frame);

/// Returns the paths of all texts and pictures, with their role for messages.
std::vector<NamedPath> output_paths(const Options& options);

/// Returns the rule for make: all outputs depend on the files. Throws Error for a name that no rule
/// can contain.
std::string rule_of(const Options& options, std::vector<std::string> files);

}  // namespace frontend
