// What `openscad -o` writes of a design as text: its tree, its messages, its parameters.
#pragma once

#include <optional>

#include "command/message_writer.hpp"
#include "frontend/file_text.hpp"
#include "frontend/options.hpp"
#include "frontend/run_program.hpp"

namespace frontend {

/// Writes options.texts, the design's tree or its messages, and the rule for make where there are
/// neither models nor pictures. Each is evaluated by itself, as by OpenSCAD, whose exit codes and
/// messages these are. `text` is what text_in_memory() has given of the design. Throws Error for
/// what cannot be read or written.
ExitCode write_texts(const Options& options, const std::optional<FileText>& text,
                     MessageWriter& messages);

}  // namespace frontend
