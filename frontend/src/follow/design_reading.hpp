// Reads a design once, from its file to what can be drawn.
#pragma once

#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "frontend/design_file.hpp"
#include "frontend/design_version.hpp"

namespace frontend {

/// The last version that could be read; null, empty and 0 before there is one.
struct GoodVersion {
  DesignSource source;
  std::shared_ptr<const ImportedDesign> design;
  bool is_exported = false;  // openscad made the text
  bool lacks_files = false;  // a used file has a syntax error
  std::shared_ptr<const DesignParameters> parameters;
  /// What text_in_memory() has given of a design that can be read only once, also of one that could
  /// not be parsed.
  std::optional<FileText> stream;
};

struct DesignReading {
  /// The version without its number and time. `files` are those that it reports; after an error,
  /// none.
  DesignVersion version;
  GoodVersion good;  // this version, or after an error the one before
  /// Absolute paths of what the own evaluator has read or looked for in vain, after an error, too.
  std::vector<std::string> watched;
};

/// Reads the design. Of `options` only `import`, `evaluator`, `inputs`, `openscad_arguments` and
/// `progress`, which may be empty, are used. Every failure is reported in version.error; only
/// Stopped (stop.hpp) is thrown.
DesignReading read_anew(const std::string& path, const DesignFileOptions& options,
                        const GoodVersion& before, const std::stop_token& stop);

}  // namespace frontend
