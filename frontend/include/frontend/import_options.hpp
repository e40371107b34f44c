// How a design is lowered to primitives, as far as its user chooses.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "csgcore/primitive.hpp"
#include "language/language_version.hpp"

namespace frontend {

class SolidPool;

/// Which round primitives become the polyhedra that OpenSCAD makes of them (frontend/OPENSCAD.md,
/// "Facets"); the others are exact quadrics.
enum class Facets : uint8_t {
  kNone,
  kFew,  // those with 0 < $fn ≤ ImportOptions::few_fragments: prisms and pyramids on purpose
  kAll,
};

/// Which of OpenSCAD's pictures the design is imported for.
enum class PictureKind : uint8_t {
  kPreview,
  /// --render, OpenSCAD's F6: the solid alone. No color() counts (GeometryDialect::keeps_colors),
  /// `#` parts are like others, and `%` parts are left out.
  kRendered,
  /// --preview=throwntogether: every leaf whole, and no operation.
  kThrownTogether,
};

/// The colour that the thrown-together picture gives to faces that are seen from within.
constexpr csgcore::Color kSeenFromWithin{1, 0, 1, 1};

/// The version of the language unless --language or the environment says otherwise.
constexpr language::LanguageVersion kDefaultLanguage = language::LanguageVersion::k2026;

struct ImportOptions {
  /// Whose language a design is evaluated in by the own evaluator, and by whose rules its tree is
  /// drawn (GeometryDialect) and files are imported.
  language::LanguageVersion language = language::LanguageVersion::k2021;
  /// The folder that the files which a design names are in, unless their paths are absolute. Empty:
  /// the working folder.
  std::string folder{};
  /// Returns the font files that the design brings along. Called once, if it has text; may be
  /// empty.
  std::function<std::vector<std::string>()> font_files{};
  Facets facets = Facets::kFew;
  /// Of kFew. People who choose no more than 8 fragments mean the polygon.
  double few_fragments = 8;
  /// In place of the $fn of every round primitive in the file.
  std::optional<double> fn{};
  /// With kAll, unless it is 0: facets are at most so far from the round surface, in the world's
  /// units, in place of OpenSCAD's. What kFew would keep stays what it is.
  double tolerance = 0;
  PictureKind picture = PictureKind::kPreview;
  /// Keep color() in a final render, too. Its layers stay those of an opaque solid.
  bool keeps_colors = false;
  /// Find the boxes of compound leaves for the view box (csgcore/solid.hpp); otherwise it
  /// may be too large there, or too small where a leaf's frame is turned.
  bool measures_leaves = true;
  /// Fill ImportedDesign::places.
  bool keeps_places = false;
  /// Fill ImportedDesign::meshes, which pictures with edges need.
  bool keeps_meshes = false;
  /// Fill ImportedDesign::turned_frames, in which an export evaluates what matrices turn.
  bool keeps_frames = false;
  /// The hulls and the outcomes of operations of the design's last version, of which those that are
  /// the same are not made anew. Null: the design has no version before.
  std::shared_ptr<SolidPool> solids{};
};

}  // namespace frontend
