// The statistics that --stats writes.
#pragma once

#include <cstdint>
#include <string>

#include "frontend/render_stats.hpp"

namespace frontend {

/// One run of the command. Times are in ms.
struct RunStats {
  std::string file;
  uint64_t file_bytes = 0;       // size of the .csg text that is parsed
  uint64_t nodes = 0;            // of the syntax tree
  uint64_t primitive_nodes = 0;  // in the file, empty and invalid ones included
  uint64_t leaves = 0;           // of OpenSCAD's preview
  uint64_t compound_leaves = 0;  // those of them that hold several primitives
  uint64_t faceted_leaves = 0;   // those in which facets stand for what is round
  uint64_t left_out = 0;         // nodes
  uint64_t layers = 0;           // that are drawn one over another; 0: the model alone
  uint32_t width_px = 0;
  uint32_t height_px = 0;
  RenderStats render;
  double export_ms = 0;  // time that openscad took for a .scad
  double read_ms = 0;
  double parse_ms = 0;
  double import_ms = 0;
  double encode_ms = 0;  // overlays and all pictures
  double total_ms = 0;   // from the start to the last encoded picture, without drawing again to
                         // measure the paper's times
};

/// Returns the statistics as JSON. The keys are fixed; frontend/STATISTICS.md lists them.
std::string to_json(const RunStats& stats);

}  // namespace frontend
