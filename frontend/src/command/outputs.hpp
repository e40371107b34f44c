// The outputs of the command: their names, frame by frame, and the rule for make that has them as
// targets.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "command/message_writer.hpp"
#include "frontend/files.hpp"
#include "frontend/options.hpp"
#include "frontend/text_kind.hpp"

namespace frontend {

/// Returns where the messages of a picture's or a model's design go: to `messages`, or as the
/// options ask, to standard output or nowhere.
DesignMessageSink message_sink(const Options& options, MessageWriter& messages);

/// Returns the kind's word of --export-format.
const char* word_of(TextKind kind);

/// Returns the $t of a frame; nothing without an animation.
std::optional<double> frame_time(const Options& options, uint32_t frame);

/// Returns OpenSCAD's name of an output for a frame: of an animation, with five digits before the
/// suffix. Messages have one file for all frames.
std::string path_of(const Output& output, const Options& options, uint32_t frame);
std::string path_of(const ModelOutput& output, const Options& options, uint32_t frame);
std::string path_of(const TextOutput& output, const Options& options, uint32_t frame);
std::string path_of(const HandedOutput& output, const Options& options, uint32_t frame);

/// Returns the line that begins the messages of each frame of an animation; empty if the format is
/// not that of messages, or without an animation.
std::string exporting_line(const std::string& format, const Options& options);

/// Returns the paths of all files that a run writes, with their role for messages.
std::vector<NamedPath> named_outputs(const Options& options);

/// Throws Error if an output cannot be written, or is another one or the design.
void check_all_outputs(const Options& options);

/// Returns the rule for make: all outputs depend on the files. Throws Error for a name that no rule
/// can contain.
std::string rule_of(const Options& options, std::vector<std::string> files);

}  // namespace frontend
