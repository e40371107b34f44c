// Outputs that the installed openscad writes: those in formats that scadray has not, and those of a
// design that openscad evaluates.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "frontend/file_text.hpp"
#include "frontend/options.hpp"
#include "frontend/run_program.hpp"

namespace frontend {

/// Has openscad write these outputs, for each frame, all or none, with these of its options. Its
/// messages are this program's, and so is its exit code. `writes_rule`: the rule for make is
/// written, too, of the files that openscad names. `text` is what text_in_memory() has given of the
/// design. Throws Error if openscad is missing, or what it has written cannot be.
ExitCode write_by_openscad(const Options& options, std::span<const HandedOutput> outputs,
                           const std::vector<std::string>& arguments,
                           const std::optional<FileText>& text, bool writes_rule);

/// Writes options.handed, and the rule for make where there are no other outputs. Throws Error.
ExitCode write_handed(const Options& options, const std::optional<FileText>& text);

}  // namespace frontend
