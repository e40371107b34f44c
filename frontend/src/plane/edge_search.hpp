// Finds the edge of an outline that a moving corner meets first.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "plane/roof_edges.hpp"

namespace frontend {

/// A corner that has been at `origin` at the time `since`.
struct MovingCorner {
  Vec2 origin{0.0};
  double since = 0;
  Vec2 velocity{0.0};

  Vec2 at(double time) const { return origin + velocity * (time - since); }
};

struct EdgeMeeting {
  static constexpr uint32_t kNone = 0xFFFFFFFFu;

  double time;
  uint32_t edge = kNone;
};

/// A hierarchy of boxes over the edges, which move and grow as the edges do.
class EdgeSearch {
 public:
  /// The edges must outlive this.
  explicit EdgeSearch(std::span<const RoofEdge> edges);

  /// The edge may extend along all of its line from now on.
  void widen(uint32_t edge);
  /// The edge has extended beyond its start, or its end, as far as it will: the corner is gone.
  void end_growth(uint32_t edge, bool is_start, double time);

  /// Returns the first time from `after` on, but for `tolerance`, at which the corner meets an edge
  /// that moves towards it, where that may extend; the time `before`, and no edge, if there is none
  /// before that. Those are left out for which is_met(edge, time) is false.
  template <typename IsMet>
  EdgeMeeting first(const MovingCorner& corner, double after, double before, double tolerance,
                    const IsMet& is_met) {
    EdgeMeeting best{before};
    for (const uint32_t edge : wide_) consider(edge, corner, after, tolerance, is_met, best);
    if (boxes_.empty()) return best;
    open_.assign(1, {0, after});
    while (!open_.empty()) {
      const BoxVisit visit = open_.back();
      open_.pop_back();
      if (visit.time > best.time) continue;
      const SearchBox& box = boxes_[visit.box];
      for (uint32_t i = box.first; i < box.first + box.count; ++i) {
        consider(order_[i], corner, after, tolerance, is_met, best);
      }
      if (box.count > 0) continue;
      BoxVisit near{box.first, boxes_[box.first].entry(corner, after)};
      BoxVisit far{box.first + 1, boxes_[box.first + 1].entry(corner, after)};
      if (far.time < near.time) std::swap(near, far);
      if (std::isfinite(far.time)) open_.push_back(far);
      if (std::isfinite(near.time)) open_.push_back(near);
    }
    return best;
  }

  /// Calls visit(edge) for each edge that may extend to a place at that time.
  template <typename Visit>
  void visit_at(const Vec2& place, double time, const Visit& visit) {
    for (const uint32_t edge : wide_) visit(edge);
    if (boxes_.empty()) return;
    std::vector<uint32_t> open{0};
    while (!open.empty()) {
      const SearchBox& box = boxes_[open.back()];
      open.pop_back();
      if (!box.holds(place, time)) continue;
      for (uint32_t i = box.first; i < box.first + box.count; ++i) {
        if (!growth_[order_[i]].is_wide) visit(order_[i]);
      }
      if (box.count == 0) open.insert(open.end(), {box.first, box.first + 1});
    }
  }

 private:
  /// Far more than rounding: what is met in the end is asked for again.
  static constexpr double kMargin = 1e-6;

  struct SearchBox {
    Vec2 min, max;                    // at the time 0
    Vec2 min_velocity, max_velocity;  // of its sides
    /// A leaf has order_[first] and the next `count`; others, boxes_[first] and the next one.
    uint32_t first, count;

    bool holds(const Vec2& place, double time) const {
      const Vec2 low = place - (min + min_velocity * time);
      const Vec2 high = max + max_velocity * time - place;
      return std::min({low.x, low.y, high.x, high.y}) >= -kMargin;
    }

    /// Returns the first time from `after` on at which the corner may be in the box; infinity: it
    /// never is.
    double entry(const MovingCorner& corner, double after) const {
      constexpr double kNever = std::numeric_limits<double>::infinity();
      double from = after, to = kNever;
      const Vec2 start = corner.at(0);
      const auto limit = [&](double ahead, double growth) {  // ahead + growth · time ≥ 0
        ahead += kMargin;
        if (growth > 0) {
          from = std::max(from, -ahead / growth);
        } else if (growth < 0) {
          to = std::min(to, ahead / -growth);
        } else if (ahead < 0) {
          to = -kNever;
        }
      };
      for (int axis = 0; axis < 2; ++axis) {
        limit(start[axis] - min[axis], corner.velocity[axis] - min_velocity[axis]);
        limit(max[axis] - start[axis], max_velocity[axis] - corner.velocity[axis]);
      }
      return from <= to + kMargin ? from : kNever;
    }
  };
  struct BoxVisit {
    uint32_t box;
    double time;  // no edge in it is met before
  };

  template <typename IsMet>
  void consider(uint32_t index, const MovingCorner& corner, double after, double tolerance,
                const IsMet& is_met, EdgeMeeting& best) const {
    const RoofEdge& edge = edges_[index];
    // What is behind the corner lies on the edge's left when they meet.
    const double approach = 1 - glm::dot(corner.velocity, edge.normal());
    if (approach <= 1) return;
    double time = corner.since + edge.ahead(corner.origin, corner.since) / approach;
    if (time < after - tolerance || time >= best.time) return;
    time = std::max(time, after);
    const Growth& growth = growth_[index];
    if (!growth.is_wide) {
      const double along = glm::dot(corner.at(time) - edge.start, edge.direction);
      const double length = glm::dot(edge.end - edge.start, edge.direction);
      const double margin = kMargin * (1 + edge.start_reach + edge.end_reach);
      if (along < -edge.start_reach * std::min(time, growth.start_until) - margin) return;
      if (along > length + edge.end_reach * std::min(time, growth.end_until) + margin) return;
    }
    if (time < best.time && is_met(index, time)) best = {time, index};
  }

  void build(uint32_t box, uint32_t begin, uint32_t end);

  struct Growth {
    bool is_wide = false;
    double start_until = std::numeric_limits<double>::infinity();
    double end_until = std::numeric_limits<double>::infinity();
  };
  std::span<const RoofEdge> edges_;
  std::vector<Growth> growth_;  // by edge
  std::vector<uint32_t> wide_;
  std::vector<uint32_t> order_;
  std::vector<SearchBox> boxes_;
  std::vector<BoxVisit> open_;  // of first(): the boxes to visit, the nearest one last
};

}  // namespace frontend
