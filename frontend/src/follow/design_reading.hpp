// One reading of a design, from its file to what can be drawn.
#pragma once

#include <memory>
#include <stop_token>
#include <string>

#include "frontend/design_file.hpp"
#include "frontend/design_version.hpp"

namespace frontend {

/// The last version that could be read; all null or empty before there is one.
struct GoodVersion {
  std::shared_ptr<const FileText> csg;
  std::shared_ptr<const ImportedDesign> design;
  std::size_t nodes = 0;
};

struct DesignReading {
  /// Without its number and the time; `files` are those that it says it has read, none after an
  /// error.
  DesignVersion version;
  GoodVersion good;      // it, or after an error the one before
  bool is_scad = false;  // by what stands in it: its name leaves that open
};

/// Of `options` only `import` and `openscad_arguments` count. Every failure is version.error;
/// throws Stopped (stop.hpp) alone.
DesignReading read_anew(const std::string& path, const DesignFileOptions& options,
                        const GoodVersion& before, const std::stop_token& stop);

}  // namespace frontend
