// How a design is lowered to primitives, as far as its user chooses.
#pragma once

#include <cstdint>
#include <optional>

namespace frontend {

/// Which round primitives become the polyhedra that OpenSCAD makes of them (frontend/OPENSCAD.md,
/// "Facets"); the others are exact quadrics.
enum class Facets : uint8_t {
  kNone,
  kFew,  // those with 0 < $fn ≤ ImportOptions::few_fragments: prisms and pyramids on purpose
  kAll,
};

struct ImportOptions {
  Facets facets = Facets::kFew;
  /// Of kFew. People who choose no more than 8 fragments mean the polygon.
  double few_fragments = 8;
  /// In place of the $fn of every round primitive in the file.
  std::optional<double> fn{};
  /// As OpenSCAD's --render: the solid alone. No color() counts, `#` parts are like others, and `%`
  /// parts are left out.
  bool rendered = false;
  /// Fill ImportedDesign::places. For TextImport alone: a tree has no offsets.
  bool keeps_places = false;
};

}  // namespace frontend
