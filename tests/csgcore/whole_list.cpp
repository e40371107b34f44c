#include "whole_list.hpp"

#include <algorithm>
#include <cstring>
#include <limits>

#include "packets/hit_sink.hpp"
#include "rays/frame_rays.hpp"
#include "rays/packet_blocks.hpp"

namespace csgcore::checks {
namespace {

constexpr double kAnywhere = -std::numeric_limits<double>::max();

template <typename T>
bool equal(const std::vector<T>& a, const std::vector<T>& b) {
  // memcmp takes no null pointer, even for no bytes.
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

}  // namespace

WholeList::WholeList(const Solid& solid, const View& view, Boundary boundary)
    : frame_(frame_rays(view, solid.bounds())) {
  parameters_.thickness_tolerance = thickness_tolerance(solid.bounds());
  parameters_.boundary = boundary;
  list_.primitives = solid.primitives().data();
  list_.list = solid.cell_list();
  list_.earliest_t = kAnywhere;
  if (!list_.list) return;
  nearest_t_.assign(list_.list->count(), kAnywhere);
  list_.nearest_t = nearest_t_.data();
}

PacketHits WholeList::trace(const RayPacket& rays, LaneMask lanes) {
  PacketHits hits;
  if (list_.list) trace_packet(frame_, rays, lanes, list_, parameters_, nullptr, workspace_, hits);
  return hits;
}

Hits WholeList::picture() {
  Hits hits;
  MemorySink sink(frame_, hits);
  for_each_block({0, 0, frame_.view.width_px, frame_.view.height_px},
                 [&](const PacketBlock& block) {
                   RayPacket rays;
                   make_block_rays(frame_, block, rays);
                   sink.store(block, rays, list_, trace(rays, block.lanes));
                 });
  return hits;
}

bool same_bits(const Hits& a, const Hits& b) {
  return a.width_px == b.width_px && a.height_px == b.height_px && equal(a.s, b.s) &&
         equal(a.position, b.position) && equal(a.normal, b.normal) &&
         equal(a.primitive, b.primitive);
}

bool same_bits(const Image& a, const Image& b) {
  return a.width_px == b.width_px && a.height_px == b.height_px && equal(a.rgb, b.rgb) &&
         equal(a.z, b.z) && equal(a.normal, b.normal) && equal(a.position, b.position) &&
         equal(a.id, b.id);
}

Hits trace_by_tiles(const Solid& solid, const View& view, const TraceOptions& options) {
  Hits hits;
  TraceStats stats;
  trace(solid, view, options, hits, stats);
  return hits;
}

Hits trace_by_cells(const Subdivision& subdivision, const View& view, const TraceOptions& options) {
  Hits hits;
  TraceStats stats;
  trace(subdivision, view, options, hits, stats);
  return hits;
}

uint64_t count_hits(const Hits& hits) {
  const auto is_hit = [](uint32_t primitive) { return primitive != Hits::kMiss; };
  return static_cast<uint64_t>(std::count_if(hits.primitive.begin(), hits.primitive.end(), is_hit));
}

}  // namespace csgcore::checks
