// Lights the parts of a design that a statement makes.
#pragma once

#include <memory>
#include <optional>

#include "frontend/design_tree.hpp"
#include "frontend/imported_design.hpp"
#include "frontend/render_settings.hpp"
#include "text.hpp"

namespace serve {

/// Returns the design's scene in which all is dimmed but what the statement at an offset of a file
/// makes: the leaves whose calls stand in it, or that are made of such. Null: it makes nothing that
/// is seen, or everything.
std::shared_ptr<const csgcore::Scene> lit_scene(const frontend::ImportedDesign& design,
                                                const frontend::DesignTree& tree,
                                                language::FileId file, std::size_t offset,
                                                const frontend::ColorScheme& scheme);

/// Returns the colour of a surface without light, in the scheme's where it has none.
csgcore::Color shown_color(const csgcore::Primitive& primitive,
                           const frontend::ColorScheme& scheme);

}  // namespace serve
