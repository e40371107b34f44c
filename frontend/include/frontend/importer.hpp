// Syntax tree, or text, → csgcore::Scene (frontend/OPENSCAD.md, "What nodes mean").
#pragma once

#include <cstddef>
#include <memory>
#include <stop_token>
#include <string>
#include <string_view>

#include "frontend/import_options.hpp"
#include "frontend/imported_design.hpp"
#include "frontend/syntax_tree.hpp"

namespace frontend {

/// A node that is not drawn is left out, and an argument of the wrong type counts as missing,
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
  /// Takes a tree instead of a text.
  explicit TextImport(SyntaxTree tree, const ImportOptions& options = {},
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
