#include "primitives/profile_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <utility>

namespace csgcore {
namespace {

/// Keeps the control point in the box of the ends, which makes a piece monotone to the last bit.
void append_curve(const LongVec2& start, const LongVec2& control, const LongVec2& end,
                  long double weight, std::vector<LongPiece>& pieces) {
  const LongVec2 within = glm::clamp(control, glm::min(start, end), glm::max(start, end));
  pieces.push_back({start, within, end, weight});
}

/// The quadrant of a direction, which includes its first axis but not the second: 0 for x > 0 and
/// y ≥ 0, and on counterclockwise.
int quadrant_from(const LongVec2& d) {
  if (d.y >= 0 && d.x > 0) return 0;
  if (d.x <= 0 && d.y > 0) return 1;
  if (d.y <= 0 && d.x < 0) return 2;
  return 3;
}
/// The same, but the quadrant includes its second axis and not the first.
int quadrant_to(const LongVec2& d) {
  if (d.x >= 0 && d.y > 0) return 0;
  if (d.x < 0 && d.y >= 0) return 1;
  if (d.y < 0 && d.x <= 0) return 2;
  return 3;
}

/// An arc is divided where the circle meets the axes through its centre.
void append_arc(const LongVec2& start, const ProfileEdge& edge, std::vector<LongPiece>& pieces) {
  const LongVec2 center(edge.control), end(edge.end);
  // A clockwise arc is mirrored.
  const long double up = edge.is_counterclockwise ? 1 : -1;
  const auto from_center = [&](const LongVec2& p) {
    return LongVec2(p.x - center.x, up * (p.y - center.y));
  };
  const LongVec2 first = from_center(start), last = from_center(end);
  const long double radius = glm::length(first), end_radius = glm::length(last);
  if (!(radius > 0) || !(end_radius > 0)) {
    pieces.push_back({start, start, end, 0});
    return;
  }
  const auto append = [&](const LongVec2& from, const LongVec2& to, const LongVec2& to_place) {
    const LongVec2& from_place = pieces.empty() ? start : pieces.back().end;
    if (from == to) return;
    // The tangents at both ends meet above the chord's middle.
    const LongVec2 middle = (from + to) * 0.5L;
    const long double squared = glm::length(from) * glm::length(to);
    const LongVec2 control = middle * (squared / glm::dot(middle, middle));
    append_curve(from_place, {center.x + control.x, center.y + up * control.y}, to_place,
                 std::min(1.0L, glm::length(middle) / std::sqrt(squared)), pieces);
  };
  const LongVec2 axes[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  LongVec2 from = first;
  for (int quadrant = quadrant_from(first); quadrant != quadrant_to(last);
       quadrant = (quadrant + 1) % 4) {
    const LongVec2 to = radius * axes[(quadrant + 1) % 4];
    append(from, to, {center.x + to.x, center.y + up * to.y});
    from = to;
  }
  append(from, last, end);
  pieces.back().end = end;
}

/// A Bézier curve is divided where it runs along an axis.
void append_bezier(const LongVec2& start, const ProfileEdge& edge, std::vector<LongPiece>& pieces) {
  const LongVec2 control(edge.control), end(edge.end);
  long double cuts[2];
  int count = 0;
  for (int axis = 0; axis < 2; ++axis) {
    const long double cut =
        (start[axis] - control[axis]) / (start[axis] - 2 * control[axis] + end[axis]);
    if (cut > 0 && cut < 1) cuts[count++] = cut;
  }
  if (count == 2 && cuts[0] > cuts[1]) std::swap(cuts[0], cuts[1]);
  LongVec2 from = start, middle = control;
  long double done = 0;
  for (int i = 0; i < count; ++i) {
    if (cuts[i] <= done) continue;
    const long double share = (cuts[i] - done) / (1 - done);
    const LongVec2 before = glm::mix(from, middle, share), after = glm::mix(middle, end, share);
    const LongVec2 at = glm::mix(before, after, share);
    append_curve(from, before, at, 1, pieces);
    from = at;
    middle = after;
    done = cuts[i];
  }
  append_curve(from, middle, end, 1, pieces);
}

}  // namespace

void append_pieces(const Vec2& start, const ProfileEdge& edge, std::vector<LongPiece>& pieces) {
  const LongVec2 from(start);
  std::vector<LongPiece> own;
  switch (edge.kind) {
    case ProfileEdge::Kind::kLine:
      own.push_back({from, from, LongVec2(edge.end), 0});
      break;
    case ProfileEdge::Kind::kArc:
      append_arc(from, edge, own);
      break;
    case ProfileEdge::Kind::kBezier:
      append_bezier(from, edge, own);
      break;
  }
  pieces.insert(pieces.end(), own.begin(), own.end());
}

}  // namespace csgcore
