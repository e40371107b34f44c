// The wavefront of a straight skeleton: the edges of an outline move into the region at unit speed,
// until nothing is left of it.
//
// O. Aichholzer, F. Aurenhammer, D. Alberts, B. Gärtner, "A Novel Type of Skeleton for Polygons",
// Journal of Universal Computer Science 1 (1995), define the skeleton by what happens to the
// wavefront: an edge shrinks to nothing, or a reflex corner meets an edge and splits the wavefront.
// Such events are taken one by one, in the order of their times, also where several happen at one
// place and time: each leaves closed loops of edges, some of them without a length, which end at
// once. Rounding may exchange events of one time and place. So a caller has to look at the outcome.
#pragma once

#include <cstdint>
#include <functional>
#include <queue>
#include <span>
#include <vector>

#include "plane/edge_search.hpp"
#include "plane/roof_edges.hpp"

namespace frontend {

/// A place where the wavefront has changed, or a corner of the outline.
struct SkeletonNode {
  Vec2 place{0.0};
  double time = 0;  // the height of the roof there
};

/// The way of a corner of the wavefront: it divides the faces of two edges.
struct RoofArc {
  uint32_t from, to;       // nodes
  uint32_t before, after;  // edges, as seen on the way around the region
};

class Wavefront {
 public:
  /// Coordinates are −1 to 1. The first nodes are the corners.
  explicit Wavefront(const RoofEdges& edges);

  /// Returns false if the events contradict each other.
  bool run();

  const std::vector<SkeletonNode>& nodes() const { return nodes_; }
  const std::vector<RoofArc>& arcs() const { return arcs_; }

 private:
  static constexpr uint32_t kNone = 0xFFFFFFFFu;

  /// A corner of the wavefront. It begins the part of the edge `after` that ends at `next`.
  struct WaveCorner {
    MovingCorner way;
    uint32_t before, after;  // edges
    uint32_t previous = kNone, next = kNone;
    uint32_t node = 0;                                  // where it has started
    uint32_t previous_part = kNone, next_part = kNone;  // others that begin parts of `after`
    bool is_alive = true;
    bool is_reflex = false;
    bool is_closing = false;  // its edges run in opposite directions, and meet
  };

  struct Event {
    double time;
    uint32_t corner;
    /// The part from `corner` to this one has no length; or `corner` meets this edge, or none so
    /// far as it has looked ahead.
    uint32_t other;
    bool operator>(const Event& event) const { return time > event.time; }
  };
  using Events = std::priority_queue<Event, std::vector<Event>, std::greater<>>;

  void start();
  uint32_t add_corner(uint32_t before, uint32_t after, uint32_t node);
  void link(uint32_t corner, uint32_t next) {
    corners_[corner].next = next;
    corners_[next].previous = corner;
  }
  void end_corner(uint32_t corner, uint32_t node);
  uint32_t add_node(const Vec2& place, double time);

  void expect_collapse(uint32_t corner, double now);
  void expect_split(uint32_t corner, double now);
  static double rounding(const MovingCorner& way);
  uint32_t part_met(uint32_t corner, uint32_t edge, double time) const;
  /// What a reflex corner meets: a corner, or the part that it begins.
  struct Met {
    uint32_t corner = kNone;
    bool is_corner = false;
  };
  bool is_vanishing(uint32_t corner, double time) const;
  Met first_met(uint32_t corner, double time);
  uint32_t merge(uint32_t corner, const Vec2& place, double time);
  void split(uint32_t corner, uint32_t part, double time);
  /// Goes on with a new corner whose neighbours are linked.
  void go_on(uint32_t corner, double time);

  const std::vector<RoofEdge>& edges_;
  const std::vector<double>& shortest_;  // by corner of the outline: its shortest edge
  EdgeSearch search_;
  std::vector<SkeletonNode> nodes_;
  std::vector<RoofArc> arcs_;
  std::vector<WaveCorner> corners_;
  std::vector<uint32_t> parts_;  // by edge: the corner that begins one of its parts
  Events collapses_, splits_;
  size_t alive_ = 0;
};

}  // namespace frontend
