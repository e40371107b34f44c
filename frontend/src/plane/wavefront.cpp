#include "plane/wavefront.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/angles.hpp"
#include "csgcore/stop_scope.hpp"

namespace frontend {
namespace {

/// Events whose times differ by less may come in either order: some hundred times the rounding.
constexpr double kSameTime = 1e-12;
/// Two edges that run in opposite directions up to this meet along all of their length at once:
/// what their angle makes of the time is about as much as the rounding makes of the place.
constexpr double kAntiparallel = 1e-8;
/// Edges at one place whose directions differ by less have the same one.
constexpr double kSameDirection = 1e-9;

}  // namespace

Wavefront::Wavefront(const RoofEdges& edges)
    : edges_(edges.edges),
      shortest_(edges.shortest),
      search_(edges_),
      parts_(edges_.size(), kNone) {
  for (const Vec2& place : edges.corners) add_node(place, 0);
}

uint32_t Wavefront::add_node(const Vec2& place, double time) {
  nodes_.push_back({place, time});
  return static_cast<uint32_t>(nodes_.size() - 1);
}

uint32_t Wavefront::add_corner(uint32_t before, uint32_t after, uint32_t node) {
  const auto index = static_cast<uint32_t>(corners_.size());
  WaveCorner& own = corners_.emplace_back();
  own.before = before;
  own.after = after;
  own.node = node;
  const Vec2& direction_before = edges_[before].direction;
  const Vec2& direction_after = edges_[after].direction;
  own.way = {nodes_[node].place, nodes_[node].time, Vec2(0.0)};
  own.is_reflex = frontend::is_reflex(direction_before, direction_after);
  // Edges that have met along all of their length are left at once.
  own.is_closing = glm::dot(direction_before, direction_after) < 0 &&
                   std::abs(cross(direction_before, direction_after)) < kAntiparallel;
  if (!own.is_closing) own.way.velocity = corner_velocity(direction_before, direction_after);
  own.next_part = parts_[after];
  if (own.next_part != kNone) corners_[own.next_part].previous_part = index;
  parts_[after] = index;
  ++alive_;
  return index;
}

void Wavefront::end_corner(uint32_t corner, uint32_t node) {
  WaveCorner& own = corners_[corner];
  own.is_alive = false;
  --alive_;
  if (corner < edges_.size()) {  // one of the outline, by the edge before it
    search_.end_growth(own.before, false, nodes_[node].time);
    search_.end_growth(own.after, true, nodes_[node].time);
  }
  (own.previous_part == kNone ? parts_[own.after] : corners_[own.previous_part].next_part) =
      own.next_part;
  if (own.next_part != kNone) corners_[own.next_part].previous_part = own.previous_part;
  if (own.node != node) arcs_.push_back({own.node, node, own.before, own.after});
}

void Wavefront::start() {
  const auto count = static_cast<uint32_t>(edges_.size());
  corners_.reserve(4 * edges_.size());
  std::vector<uint32_t> corner_after(count);
  for (uint32_t i = 0; i < count; ++i) {
    const RoofEdge& edge = edges_[i];
    corner_after[i] = add_corner(i, edge.next, edge.end_corner);
    // Which may be jittered; its edges may form a needle.
    corners_[corner_after[i]].way = {edge.end, 0, edge.end_velocity};
  }
  for (uint32_t i = 0; i < count; ++i) link(corner_after[i], corner_after[edges_[i].next]);
  for (uint32_t i = 0; i < count; ++i) {
    expect_collapse(corner_after[i], 0);
    if (corners_[corner_after[i]].is_reflex) expect_split(corner_after[i], 0);
  }
}

/// Finds out when the part that the corner begins has no length.
void Wavefront::expect_collapse(uint32_t corner, double now) {
  const WaveCorner& left = corners_[corner];
  const WaveCorner& right = corners_[left.next];
  const Vec2& direction = edges_[left.after].direction;
  const double length = glm::dot(right.way.at(now) - left.way.at(now), direction);
  const double growth = glm::dot(right.way.velocity - left.way.velocity, direction);
  const double rounding =
      kSameTime * (1 + glm::length(left.way.velocity) + glm::length(right.way.velocity));
  double time = now;
  if (length > rounding) {
    if (growth >= 0) return;
    time = now + length / -growth;
  } else if (growth > rounding) {
    return;
  }
  collapses_.push({time, corner, left.next});
}

/// Finds out which edge a reflex corner meets. Most corners end soon, so that what lies far ahead
/// is none of theirs: a corner looks ahead as far as it has come, at first by its shortest edge,
/// and asks again when it is there.
void Wavefront::expect_split(uint32_t corner, double now) {
  const WaveCorner& own = corners_[corner];
  constexpr double kNearest = 1e-6, kFurthest = 4;  // none meets anything later
  const double shortest = own.node < shortest_.size() ? shortest_[own.node] : kNearest;
  const double ahead = std::max({2 * now, shortest, kNearest});
  const double before = ahead < kFurthest ? ahead : std::numeric_limits<double>::infinity();
  const EdgeMeeting meeting =
      search_.first(own.way, now, before, kSameTime, [&](uint32_t edge, double time) {
        if (edge == own.before || edge == own.after) return false;
        // Where the outline touches itself in corners, they are parted.
        const bool is_start = time <= kSameTime && (edges_[edge].start_corner == own.node ||
                                                    edges_[edge].end_corner == own.node);
        if (is_start) return false;
        return time > now + kSameTime || part_met(corner, edge, time) != kNone;
      });
  if (std::isfinite(meeting.time)) splits_.push({meeting.time, corner, meeting.edge});
}

/// Returns how far a corner may be from where it is thought to be.
double Wavefront::rounding(const MovingCorner& way) {
  return 10 * kSameTime * (1 + glm::length(way.velocity));
}

/// Returns the corner that begins the part of the edge which a reflex corner meets at that time;
/// none if it meets no part.
uint32_t Wavefront::part_met(uint32_t corner, uint32_t edge, double time) const {
  const Vec2 place = corners_[corner].way.at(time);
  // What is behind a reflex corner lies between its edges, about opposite to its velocity.
  const Vec2 behind = -corners_[corner].way.velocity;
  const auto is_left = [&](uint32_t of) { return cross(edges_[of].direction, behind) > 0; };
  /// Returns whether it lies in the region at another corner that is met.
  const auto is_free = [&](const WaveCorner& other) {
    return other.is_reflex ? is_left(other.before) || is_left(other.after)
                           : is_left(other.before) && is_left(other.after);
  };
  const Vec2& direction = edges_[edge].direction;
  uint32_t found = kNone;
  double most = 0;
  for (uint32_t part = parts_[edge]; part != kNone; part = corners_[part].next_part) {
    const WaveCorner& start = corners_[part];
    const WaveCorner& end = corners_[start.next];
    if (part == corner || start.next == corner) continue;
    const double from_start = glm::dot(place - start.way.at(time), direction);
    const double to_end = glm::dot(end.way.at(time) - place, direction);
    const double start_rounding = rounding(start.way), end_rounding = rounding(end.way);
    const double within = std::min(from_start + start_rounding, to_end + end_rounding);
    if (!(within >= most)) continue;
    if (from_start <= start_rounding && !is_free(start)) continue;
    if (to_end <= end_rounding && !is_free(end)) continue;
    most = within;
    found = part;
  }
  return found;
}

bool Wavefront::run() {
  start();
  // Each event ends a corner of the outline, or one of the two that a reflex corner became; more
  // events, and more reflex corners whose edge was gone, are a contradiction.
  const size_t most_corners = 16 * edges_.size() + 64;
  size_t searches_left = 256 * edges_.size() + 1024;
  for (uint32_t steps = 0; alive_ > 0 && !(collapses_.empty() && splits_.empty()); ++steps) {
    if (steps % 256 == 0) csgcore::stop_point();
    if (corners_.size() > most_corners) return false;
    // What has no length at the time of a split goes first, so that only what stays is split.
    const bool is_split =
        collapses_.empty() ||
        (!splits_.empty() && splits_.top().time + kSameTime < collapses_.top().time);
    Events& events = is_split ? splits_ : collapses_;
    const Event event = events.top();
    events.pop();
    const WaveCorner& own = corners_[event.corner];
    if (!own.is_alive) continue;
    if (!is_split) {
      if (own.next != event.other || !corners_[event.other].is_alive) continue;
      // The place of a fast corner is known less well.
      const MovingCorner& other = corners_[event.other].way;
      const bool is_slower = glm::length(own.way.velocity) < glm::length(other.velocity);
      const Vec2 place = (is_slower ? own.way : other).at(event.time);
      go_on(merge(event.corner, place, event.time), event.time);
      continue;
    }
    if (event.other == EdgeMeeting::kNone) {
      expect_split(event.corner, event.time);
      continue;
    }
    const uint32_t part = part_met(event.corner, event.other, event.time);
    if (part != kNone) {
      split(event.corner, part, event.time);
    } else if (searches_left-- > 0) {
      expect_split(event.corner, event.time);
    } else {
      return false;
    }
  }
  return alive_ == 0;
}

/// Ends the part that the corner begins, and returns the corner that is between the edges beside it
/// from now on.
uint32_t Wavefront::merge(uint32_t corner, const Vec2& place, double time) {
  const uint32_t other = corners_[corner].next;
  const uint32_t node = add_node(place, time);
  const uint32_t previous = corners_[corner].previous, next = corners_[other].next;
  end_corner(corner, node);
  end_corner(other, node);
  const uint32_t merged = add_corner(corners_[corner].before, corners_[other].after, node);
  link(previous, merged);
  link(merged, next);
  return merged;
}

/// Returns whether the part that the corner begins has no length, and gets none.
bool Wavefront::is_vanishing(uint32_t corner, double time) const {
  const WaveCorner& own = corners_[corner];
  const MovingCorner& end = corners_[own.next].way;
  const Vec2& direction = edges_[own.after].direction;
  const double slack = rounding(own.way) + rounding(end);
  return glm::dot(end.at(time) - own.way.at(time), direction) <= slack &&
         glm::dot(end.velocity - own.way.velocity, direction) <= slack;
}

/// Returns the way on from a reflex corner that meets others at one place: turning left from the
/// edge after the corner, the first edge that comes to the place. That is the edge before another
/// corner there, or one that passes.
Wavefront::Met Wavefront::first_met(uint32_t corner, double time) {
  const Vec2 place = corners_[corner].way.at(time);
  const double slack = rounding(corners_[corner].way);
  Met first;
  double least = std::numeric_limits<double>::infinity();
  const auto consider = [&](const Met& met, uint32_t edge) {
    const Vec2& after = edges_[corners_[corner].after].direction;
    const Vec2 back = -edges_[edge].direction;
    double angle = std::atan2(cross(after, back), glm::dot(after, back));
    if (angle < -kSameDirection) angle += kTurn;
    if (angle >= least) return;
    least = angle;
    first = met;
  };
  search_.visit_at(place, time, [&](uint32_t edge) {
    const Vec2& direction = edges_[edge].direction;
    for (uint32_t part = parts_[edge]; part != kNone; part = corners_[part].next_part) {
      const uint32_t end = corners_[part].next;
      if (part == corner || end == corner || is_vanishing(part, time)) continue;
      const bool is_neighbour = end == corners_[corner].previous || end == corners_[corner].next;
      const MovingCorner& end_way = corners_[end].way;
      const Vec2 to_end = end_way.at(time) - place;
      const double start_slack = slack + rounding(corners_[part].way);
      const double end_slack = slack + rounding(end_way);
      if (glm::length(to_end) <= end_slack) {
        if (!is_neighbour && !is_vanishing(end, time)) consider({end, true}, edge);
      } else if (std::abs(edges_[edge].ahead(place, time)) <= slack &&
                 glm::dot(to_end, direction) > end_slack &&
                 glm::dot(place - corners_[part].way.at(time), direction) > start_slack) {
        consider({part, false}, edge);
      }
    }
  });
  return first;
}

/// Divides the wavefront where a reflex corner meets a part of an edge, or a corner at its end.
void Wavefront::split(uint32_t corner, uint32_t part, double time) {
  const Vec2 place = corners_[corner].way.at(time);
  const uint32_t previous = corners_[corner].previous, next = corners_[corner].next;
  const uint32_t before = corners_[corner].before, after = corners_[corner].after;
  const auto is_met = [&](uint32_t other) {
    const MovingCorner& way = corners_[other].way;
    return glm::length(way.at(time) - place) <= rounding(way) + rounding(corners_[corner].way);
  };
  Met met{part, false};
  if (is_met(part) || is_met(corners_[part].next)) {
    const Met first = first_met(corner, time);
    if (first.corner != kNone) met = first;
  }
  const uint32_t node = add_node(place, time);
  end_corner(corner, node);
  // What the edges after and before the corner meet.
  const uint32_t edge_before =
      met.is_corner ? corners_[met.corner].before : corners_[met.corner].after;
  const uint32_t edge_after = corners_[met.corner].after;
  const uint32_t corner_before = met.is_corner ? corners_[met.corner].previous : met.corner;
  const uint32_t corner_after = corners_[met.corner].next;
  if (met.is_corner) end_corner(met.corner, node);
  const uint32_t left = add_corner(before, edge_after, node);
  const uint32_t right = add_corner(edge_before, after, node);
  link(previous, left);
  link(left, corner_after);
  link(corner_before, right);
  link(right, next);
  go_on(left, time);
  go_on(right, time);
}

void Wavefront::go_on(uint32_t corner, double time) {
  uint32_t previous = corners_[corner].previous, next = corners_[corner].next;
  for (; previous != next && corners_[corner].is_closing;
       previous = corners_[corner].previous, next = corners_[corner].next) {
    // The gap between the edges closes up to the nearer one of their ends.
    const Vec2& place = nodes_[corners_[corner].node].place;
    const Vec2& direction = edges_[corners_[corner].after].direction;
    const Vec2 before = corners_[previous].way.at(time), after = corners_[next].way.at(time);
    const bool is_before = glm::dot(before - place, direction) < glm::dot(after - place, direction);
    corner = merge(is_before ? previous : corner, is_before ? before : after, time);
  }
  if (previous == next) {
    // Two edges are left, which have met.
    const uint32_t node = corners_[corner].node;
    end_corner(previous, node);
    end_corner(corner, node);
    return;
  }
  expect_collapse(previous, time);
  expect_collapse(corner, time);
  if (corners_[corner].is_reflex) {
    search_.widen(corners_[corner].before);
    search_.widen(corners_[corner].after);
    expect_split(corner, time);
  }
}

}  // namespace frontend
