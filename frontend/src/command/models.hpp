// What `-o` writes of a design's solid or plane figure: .stl, .svg and the like.
#pragma once

#include <optional>

#include "command/message_writer.hpp"
#include "frontend/file_text.hpp"
#include "frontend/options.hpp"

namespace frontend {

/// Writes options.models, all or none, the summary, and the rule for make where there are no
/// pictures. The design is evaluated for them by itself, as for OpenSCAD's final render. `text` is
/// what text_in_memory() has given of the design. Throws Error, in OpenSCAD's words where the
/// design has nothing that a format holds.
void write_models(const Options& options, const std::optional<FileText>& text,
                  MessageWriter& messages);

}  // namespace frontend
