// Exports a design: the surface of its solid, or the outlines of its plane figure, as a file that
// other programs read (frontend/OPTIONS.md).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "csgcore/csg_tree.hpp"
#include "csgcore/solid.hpp"
#include "csgcore/triangle_set.hpp"
#include "frontend/design_tree.hpp"
#include "frontend/error.hpp"
#include "frontend/export_settings.hpp"
#include "frontend/exported_part.hpp"
#include "frontend/import_options.hpp"
#include "frontend/imported_design.hpp"
#include "frontend/model_format.hpp"

namespace frontend {

/// Returns the options by which a design is imported for its export: as OpenSCAD's final render,
/// with OpenSCAD's facets, and with the colours that 3MF holds.
ImportOptions options_for_export(ImportOptions options);

/// Figures of a design's solid or plane figure. Lengths are in the design's units.
struct ModelFigures {
  bool is_plane = false;
  csgcore::Box box{};
  double area = 0;            // of the plane figure, or the solid's surface
  std::size_t outlines = 0;   // of a plane figure
  bool is_convex = false;     // the plane figure
  std::size_t vertices = 0;   // of the solid's surface
  std::size_t triangles = 0;  // of the solid's surface
  bool is_closed = false;     // the solid's surface
};

class ModelExport {
 public:
  /// `design` was imported by options_for_export() from `tree`. Both must outlive this. `threads`
  /// is the most that work; 0: as many as there are processors.
  ModelExport(const ImportedDesign& design, const DesignTree& tree, unsigned threads = 0,
              ExportSettings settings = {});

  /// Throws Error if the design has nothing that the format holds, in OpenSCAD's words.
  void check(ModelFormat format) const;

  /// Returns the bytes of the file: the same for the same design, on one processor. A call for a
  /// solid takes the time of csgcore::boundary_mesh(), once for all formats but 3MF, which has the
  /// solid by its colours. Throws what check() does; Error if the format cannot hold the solid; and
  /// Stopped (stop.hpp).
  std::string encode(ModelFormat format);

  /// Returns nothing for a design without a solid or plane figure. Takes the time of encode().
  std::optional<ModelFigures> figures();

  /// What encode() has said about parts that it has left out.
  const std::vector<Warning>& warnings() const { return warnings_; }

 private:
  [[noreturn]] void fail_as_too_small() const;
  void find_operands();
  csgcore::TriangleSet boundary_of(const csgcore::CsgTree& tree);
  const csgcore::TriangleSet& surface_or_nothing();
  const csgcore::TriangleSet& surface();
  const std::vector<ExportedPart>& parts();
  /// Returns the parts of 3MF, which are one without the design's colours.
  std::vector<ExportedPart> colored_parts();

  const ImportedDesign& design_;
  const DesignTree& tree_;
  const unsigned threads_;
  const ExportSettings settings_;
  bool has_operands_ = false;
  std::vector<csgcore::TriangleSet> operands_;  // by primitive; empty if the solid has it not
  csgcore::CsgTree solid_;                      // over the operands
  std::shared_ptr<const csgcore::CanonicalPrimitives> primitives_;  // null until they are needed
  std::optional<csgcore::TriangleSet> surface_;
  std::optional<std::vector<ExportedPart>> parts_;
  std::vector<Warning> warnings_;
};

}  // namespace frontend
