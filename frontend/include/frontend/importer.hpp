// Syntax tree, or text, → csgcore::Scene (frontend/OPENSCAD.md, "What nodes mean").
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "csgcore/geometry.hpp"
#include "csgcore/scene.hpp"
#include "frontend/error.hpp"
#include "frontend/syntax_tree.hpp"

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

/// Where a primitive node stands in its file.
struct PrimitivePlace {
  uint32_t line = 0;    // from 1
  uint32_t offset = 0;  // of its name, in bytes from the text's start
};

struct ImportedDesign {
  csgcore::Scene scene;
  /// What OpenSCAD's --viewall looks at: the union of the positive leaves' boxes, each the box of
  /// the corners of the (faceted) leaf's local box under its matrix, `%` and `#` parts included
  /// (frontend/OPENSCAD.md, "Camera"). Empty for an empty design.
  csgcore::Box view_box;
  /// Primitive nodes in the file, empty, invalid and `%` ones included.
  uint32_t primitive_nodes = 0;
  /// Of all these nodes, by Primitive::id, where ImportOptions::keeps_places asks for it.
  std::vector<PrimitivePlace> places;
  std::vector<Warning> warnings;
};

/// A node that cannot be drawn is left out, and an argument of the wrong type counts as missing,
/// as in OpenSCAD: there is one warning for each kind of node and reason, which names the first
/// with its place and says how many there are. A round primitive whose facets would take too much
/// memory stays smooth, with one warning for all. Throws nothing but Stopped (stop.hpp), where
/// `stop` asks for it.
ImportedDesign import_design(const SyntaxTree& tree, const ImportOptions& options = {},
                             const std::stop_token& stop = {});

/// import_design(parse(text)) in one pass over the text. Of a node's arguments nothing is kept but
/// what is drawn, so that large designs take a fraction of the time and the memory.
class TextImport {
 public:
  /// Throws what parse() throws (parser.hpp).
  TextImport(std::string_view text, std::string file_name, const ImportOptions& options = {},
             const std::stop_token& stop = {});
  TextImport(TextImport&&) noexcept;
  TextImport& operator=(TextImport&&) noexcept;
  ~TextImport();

  /// In the file, of all kinds.
  std::size_t nodes() const;
  /// The rest, which needs the text no more. Throws what import_design() throws. To be called once.
  ImportedDesign finish(const std::stop_token& stop = {});

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace frontend
