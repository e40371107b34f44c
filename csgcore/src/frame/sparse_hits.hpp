// What a picture's pixels see of a solid, for what is done to the picture afterwards.
#pragma once

#include "packets/hit_sink.hpp"

namespace csgcore {

class Solid;
struct FrameSettings;
struct Image;
struct TraceOptions;
struct TraceStats;
struct View;

/// Stores what the pixels' centres see. `options` may name no area; its samples do not count.
/// Overwrites `stats`.
void trace(const Solid& solid, const View& view, const TraceOptions& options, SparseHits& hits,
           TraceStats& stats);

/// Does that and draws the picture (tracer.hpp), of one ray a pixel, by the same rays.
void draw(const Solid& solid, const View& view, const FrameSettings& settings,
          const TraceOptions& options, Image& image, SparseHits& hits, TraceStats& stats);

}  // namespace csgcore
