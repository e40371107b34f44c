#include "csgcore/tile_lists.hpp"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <stop_token>
#include <tuple>
#include <utility>

#include "base/worker_threads.hpp"
#include "tiles/tile_tracer.hpp"

namespace csgcore {
namespace {

/// TileRules::cover_share for renderers in float. They are wrong about a part of an occluder at its
/// ends, which is 2^-20 over this share squared for the shortest ones.
constexpr double kCoverShare = 1.0 / 64;

/// The lists that one thread has collected.
struct Part {
  std::vector<ListedTile> tiles;
  std::vector<BlistTest> tests;
};

class ListVisitor final : public TileVisitor {
 public:
  ListVisitor(double base_s, uint32_t longest_list, std::stop_source stop)
      : base_s_(base_s), longest_list_(longest_list), stop_(std::move(stop)) {}

  void visit_empty(const Tile&) override {}

  void visit(const Tile& tile, TileRays& rays) override {
    const TileRays::Met met = rays.met();
    if (met.list.is_constant()) return;
    if (met.list.count() > longest_list_) {
      stop_.request_stop();
      return;
    }
    Part& part = parts_.local();
    const auto first = static_cast<uint32_t>(part.tests.size());
    append(part.tests, met.list);
    part.tiles.push_back({tile, first, met.list.count(), base_s_ + met.cut_t});
  }

  void collect(TileLists& lists) const {
    struct Entry {
      const Part* part;
      const ListedTile* tile;
    };
    std::vector<Entry> entries;
    size_t tests = 0;
    for (const Part& part : parts_) {
      for (const ListedTile& tile : part.tiles) entries.push_back({&part, &tile});
      tests += part.tests.size();
    }
    // The order must not depend on which thread took which tile.
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
      return std::tie(a.tile->area.y, a.tile->area.x) < std::tie(b.tile->area.y, b.tile->area.x);
    });
    lists.tiles.reserve(entries.size());
    lists.tests.reserve(tests);
    for (const Entry& entry : entries) {
      ListedTile tile = *entry.tile;
      const auto from = entry.part->tests.begin() + tile.first_test;
      tile.first_test = static_cast<uint32_t>(lists.tests.size());
      lists.tests.insert(lists.tests.end(), from, from + tile.test_count);
      lists.tiles.push_back(tile);
    }
  }

 private:
  const double base_s_;
  const uint32_t longest_list_;
  std::stop_source stop_;
  tbb::enumerable_thread_specific<Part> parts_;
};

}  // namespace

bool list_tiles(const Solid& solid, const View& view, const TileListOptions& options,
                TileLists& lists) {
  lists.tiles.clear();
  lists.tests.clear();
  std::stop_source stop;
  with_threads(options.threads, [&] {
    const FrameRays rays = frame_rays(view, solid.bounds());
    TraceParameters parameters;
    parameters.thickness_tolerance = options.thickness_tolerance;
    parameters.boundary = options.boundary;
    parameters.stop = stop.get_token();
    TileRules rules;
    rules.centers_only = options.centers_only;
    rules.tile_list = options.short_list;
    rules.packet_list = options.longest_list;
    rules.cover_share = kCoverShare;
    rules.cuts_by_faces = false;
    TileTracer tracer(solid, rays, parameters, rules);
    ListVisitor visitor(rays.base_s, options.longest_list, stop);
    tracer.visit({0, 0, view.width_px, view.height_px}, visitor);
    if (!stop.stop_requested()) visitor.collect(lists);
  });
  return !stop.stop_requested();
}

}  // namespace csgcore
