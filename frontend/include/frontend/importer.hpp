// Syntax tree, or text, → csgcore::Scene (openscad.md §2, design.md §3).
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

/// Which round primitives become the polyhedra that OpenSCAD makes of them (openscad.md §3); the
/// others are exact quadrics.
enum class Facets : uint8_t {
  kNone,
  kFew,  // those with 0 < $fn ≤ ImportOptions::few_fragments: prisms and pyramids on purpose
  kAll,
};

struct ImportOptions {
  /// Leave out nodes that cannot be drawn, with one warning for each kind and its count, instead of
  /// throwing an Error.
  bool skip_unsupported = false;
  Facets facets = Facets::kFew;
  /// Of kFew. People who choose no more than 8 fragments mean the polygon (openscad.md §3).
  double few_fragments = 8;
  /// In place of the $fn of every round primitive in the file.
  std::optional<double> fn{};
  /// As OpenSCAD's --render: the solid alone. No color() counts, `#` parts are like others, and `%`
  /// parts are left out.
  bool rendered = false;
};

struct ImportedDesign {
  csgcore::Scene scene;
  /// What OpenSCAD's --viewall looks at: the union of the positive leaves' boxes, each the box of
  /// the corners of the (faceted, openscad.md §3) leaf's local box under its matrix, `%` and `#`
  /// parts included (openscad.md §4). Empty for an empty design.
  csgcore::Box view_box;
  /// Primitive nodes in the file, empty, invalid and `%` ones included.
  uint32_t primitive_nodes = 0;
  std::vector<Warning> warnings;
};

/// Where the primitive node stands whose index in file order is `id` (Primitive::id), which must be
/// below ImportedDesign::primitive_nodes.
Location place_of_primitive(const SyntaxTree& tree, uint32_t id);

/// Throws Error for a node that cannot be drawn (it names the first with its place, and says how
/// many there are) and for arguments of the wrong type. A round primitive whose facets would take
/// too much memory stays smooth, with one warning for all. Throws Stopped (stop.hpp) where `stop`
/// asks for it.
ImportedDesign import_design(const SyntaxTree& tree, const ImportOptions& options = {},
                             const std::stop_token& stop = {});

/// import_design(parse(text)) in one pass over the text. Of a node's arguments nothing is kept but
/// what is drawn, so that large designs take a fraction of the time and the memory.
class TextImport {
 public:
  /// Throws what parse() throws (parser.hpp), and nothing that import_design() does.
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
