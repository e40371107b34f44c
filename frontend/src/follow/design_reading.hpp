// Reads a design once, from its file to what can be drawn.
#pragma once

#include <memory>
#include <stop_token>
#include <string>

#include "frontend/design_file.hpp"
#include "frontend/design_version.hpp"

namespace frontend {

/// The last version that could be read; null and 0 before there is one.
struct GoodVersion {
  DesignTexts texts;
  std::shared_ptr<const ImportedDesign> design;
  std::size_t nodes = 0;
};

struct DesignReading {
  /// The version without its number and time. `files` are those that it reports; after an error,
  /// none.
  DesignVersion version;
  GoodVersion good;      // this version, or after an error the one before
  bool is_scad = false;  // told by the text, where the name does not tell
};

/// Reads the design. Of `options` only `import`, `evaluator` and `openscad_arguments`
/// are used. Every failure is
/// reported in version.error; only Stopped (stop.hpp) is thrown.
DesignReading read_anew(const std::string& path, const DesignFileOptions& options,
                        const GoodVersion& before, const std::stop_token& stop);

}  // namespace frontend
