#include "subtrees/subtree.hpp"

namespace frontend {
namespace {

const ImportedDrawing* drawing_of(NodeReader& reader, const NodeSources& sources,
                                  FileImports& files) {
  if (!names_drawing(reader.tree(), reader.node())) return nullptr;
  DrawingArguments arguments = read_drawing(reader, sources.options.language);
  arguments.dxf.facets = chosen(sources, arguments.dxf.facets);
  arguments.dxf.is_faceted = keeps_facets(sources.options, arguments.dxf.facets);
  arguments.svg.facets = chosen(sources, arguments.svg.facets);
  // $fn only adds chords to an SVG's curves, if anything: none is meant to be a polygon.
  arguments.svg.is_faceted = sources.options.facets == Facets::kAll;
  const ImportedDrawing& drawing = files.drawing(arguments);
  for (const DrawingProblem& problem : drawing.problems) {
    reader.tell({": " + problem.what, problem.todo});
  }
  return &drawing;
}

}  // namespace

void Subtree::take(uint32_t id, const NodeSources& sources, FileImports& files,
                   NodeProblems& problems) {
  const Node& node = syntax(end());
  // A colour within a leaf of one colour counts for its `%` parts only.
  NodeProblems untold;
  NodeReader reader(tree_, node, node.kind == NodeKind::kColor ? untold : problems);
  NodeData data = read_node(reader, sources);
  nodes_.push_back({id, std::move(data), drawing_of(reader, sources, files)});
}

}  // namespace frontend
