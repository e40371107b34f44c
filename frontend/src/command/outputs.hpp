// The outputs of the command: their names, frame by frame, the rule for make that has them as
// targets, and what `openscad -o` writes of a design as text.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "frontend/file_text.hpp"
#include "frontend/files.hpp"
#include "frontend/options.hpp"
#include "frontend/run_program.hpp"

namespace frontend {

/// Returns how many times the design is evaluated: for each frame of an animation, or once.
uint32_t frame_count(const Options& options);

/// Returns the $t of a frame; nothing without an animation.
std::optional<double> frame_time(const Options& options, uint32_t frame);

/// Returns OpenSCAD's name of an output for a frame: of an animation, with five digits before the
/// suffix. Messages have one file for all frames.
std::string path_of(const Output& output, const Options& options, uint32_t frame);
std::string path_of(const ModelOutput& output, const Options& options, uint32_t frame);
std::string path_of(const TextOutput& output, const Options& options, uint32_t frame);

/// Returns the paths of all texts, models and pictures, with their role for messages.
std::vector<NamedPath> output_paths(const Options& options);

/// Returns the rule for make: all outputs depend on the files. Throws Error for a name that no rule
/// can contain.
std::string rule_of(const Options& options, std::vector<std::string> files);

/// Writes options.texts, the design's tree or its messages, and the rule for make where there are
/// neither models nor pictures. Each is evaluated by itself, as by OpenSCAD, whose exit codes and
/// messages these are. `text` is what text_in_memory() has given of the design. Throws Error for
/// what cannot be read or written.
ExitCode write_texts(const Options& options, const std::optional<FileText>& text);

}  // namespace frontend
