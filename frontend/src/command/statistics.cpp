#include "frontend/statistics.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace frontend {

namespace {

/// A leaf that is not drawn may be among the others.
uint64_t exact_leaves(const RunStats& stats) {
  return stats.leaves - std::min(stats.leaves, stats.faceted_leaves);
}

}  // namespace

std::string to_json(const RunStats& stats) {
  const RenderStats& render = stats.render;
  const csgcore::TraceStats& trace = render.trace;
  const nlohmann::ordered_json json = {
      {"file", stats.file},
      {"file_bytes", stats.file_bytes},
      {"width_px", stats.width_px},
      {"height_px", stats.height_px},
      {"renderer", render.renderer},
      {"technique", render.technique},
      {"nodes", stats.nodes},
      {"primitive_nodes", stats.primitive_nodes},
      {"design_leaves",
       {{"total", stats.leaves},
        {"compound", stats.compound_leaves},
        {"exact", exact_leaves(stats)},
        {"faceted", stats.faceted_leaves},
        {"left_out", stats.left_out}}},
      {"layers", stats.layers},
      {"primitives", render.primitives},
      {"cells", render.cells},
      {"leaves",
       {{"total", render.leaves},
        {"empty", render.leaves_empty},
        {"union", render.leaves_union},
        {"pair", render.leaves_pair},
        {"general", render.leaves_general},
        {"full", render.leaves_full},
        {"dropped", render.leaves_dropped},
        {"given_up", render.leaves_given_up}}},
      {"leaf_primitives", render.leaf_primitives},
      {"subdivision_bytes", render.bytes},
      {"draw_calls", render.draw_calls},
      {"cells_drawn", render.cells_drawn},
      {"rays", trace.rays},
      {"intersections", trace.intersections},
      {"resolved_rays", trace.resolved_rays},
      {"edge_pixels", trace.edge_pixels},
      {"tiles", trace.tiles},
      {"times_ms",
       {{"export", stats.export_ms},
        {"read", stats.read_ms},
        {"parse", stats.parse_ms},
        {"import", stats.import_ms},
        {"prepare", render.prepare_ms},
        {"context", render.context_ms},
        {"subdivide", render.subdivide_ms},
        {"traverse", render.traverse_ms},
        {"cull", trace.cull_ms},
        {"trace", trace.trace_ms},
        {"render", render.render_ms},
        {"encode", stats.encode_ms},
        {"total", stats.total_ms}}},
      {"paper_ms",
       {{"S", render.subdivide_ms},
        {"T_S", render.paper_ts_ms},
        {"T_R", render.paper_tr_ms},
        {"S_R", render.paper_sr_ms}}},
  };
  // The name of a file may contain bytes that are not UTF-8; they are replaced.
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n';
}

}  // namespace frontend
