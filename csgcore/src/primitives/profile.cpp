#include "csgcore/profile.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <limits>
#include <optional>
#include <utility>

#include "base/constants.hpp"
#include "csgcore/geometry.hpp"

namespace csgcore {
namespace {

using LongVec2 = glm::tvec2<long double>;
using ProfilePiece = Profile::Piece;

/// See Profile::Piece. Its coordinates are those of the definition.
struct LongPiece {
  LongVec2 start, control, end;
  long double weight;
};

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

bool has_length(const Vec2& start, const ProfileEdge& edge) {
  return edge.end != start || (edge.kind == ProfileEdge::Kind::kBezier && edge.control != start);
}

void leave_out_points(std::vector<ProfileLoop>& loops) {
  for (ProfileLoop& loop : loops) {
    if (loop.empty()) continue;
    Vec2 start = loop.back().end;
    std::erase_if(loop, [&](const ProfileEdge& edge) {
      const bool is_point = !has_length(start, edge);
      start = edge.end;
      return is_point;
    });
  }
  std::erase_if(loops, [](const ProfileLoop& loop) { return loop.empty(); });
}

struct LongBox {
  LongVec2 min{std::numeric_limits<long double>::infinity()};
  LongVec2 max{-std::numeric_limits<long double>::infinity()};

  LongVec2 middle() const { return 0.5L * min + 0.5L * max; }
};

/// Pieces are monotone, so that their ends bound them.
LongBox box_of(std::span<const LongPiece> pieces) {
  LongBox box;
  for (const LongPiece& piece : pieces) {
    box.min = glm::min(box.min, glm::min(piece.start, piece.end));
    box.max = glm::max(box.max, glm::max(piece.start, piece.end));
  }
  return box;
}

/// A loop, as a range of pieces, and the middle of its box.
struct LoopPieces {
  std::vector<LongPiece> pieces;
  LongVec2 middle;
};

/// Orders the loops so that each half of them is compact, and each half of a half.
void order_by_place(std::span<LoopPieces> loops) {
  if (loops.size() <= 2) return;
  LongBox box;
  for (const LoopPieces& loop : loops) {
    box.min = glm::min(box.min, loop.middle);
    box.max = glm::max(box.max, loop.middle);
  }
  const LongVec2 size = box.max - box.min;
  const int axis = size.x >= size.y ? 0 : 1;
  std::stable_sort(loops.begin(), loops.end(), [&](const LoopPieces& a, const LoopPieces& b) {
    return a.middle[axis] < b.middle[axis];
  });
  order_by_place(loops.first(loops.size() / 2));
  order_by_place(loops.subspan(loops.size() / 2));
}

/// Builds the BVH top down: first loops are divided, then their pieces, each time in the middle.
class ProfileBvhBuilder {
 public:
  /// `loop_begins`: the first piece of each loop, and the number of all pieces.
  ProfileBvhBuilder(std::span<const ProfilePiece> pieces, std::span<const uint32_t> loop_begins)
      : pieces_(pieces), loop_begins_(loop_begins) {
    nodes_.emplace_back();
    build_loops(0, 0, static_cast<uint32_t>(loop_begins.size()) - 1);
  }
  std::vector<Profile::Node> take() { return std::move(nodes_); }

 private:
  void build_loops(uint32_t node, uint32_t first, uint32_t last) {
    if (last - first == 1) {
      build_chain(node, loop_begins_[first], loop_begins_[last]);
      return;
    }
    const uint32_t children = add_children();
    const uint32_t middle = first + (last - first) / 2;
    build_loops(children, first, middle);
    build_loops(children + 1, middle, last);
    merge(node, children, false);
  }

  void build_chain(uint32_t node, uint32_t begin, uint32_t end) {
    if (end - begin > Profile::kLeafPieces) {
      const uint32_t children = add_children();
      const uint32_t middle = begin + (end - begin) / 2;
      build_chain(children, begin, middle);
      build_chain(children + 1, middle, end);
      merge(node, children, true);
      return;
    }
    Profile::Node& leaf = nodes_[node];
    leaf = {{}, {}, begin, end, 0, true};
    for (size_t axis = 0; axis < 2; ++axis) {
      const auto i = static_cast<int>(axis);
      double min = kInfinity, max = -kInfinity;
      for (uint32_t piece = begin; piece < end; ++piece) {
        min = std::min({min, pieces_[piece].start[i], pieces_[piece].end[i]});
        max = std::max({max, pieces_[piece].start[i], pieces_[piece].end[i]});
      }
      leaf.min[axis] = static_cast<float>(min) - Profile::kBoxMargin;
      leaf.max[axis] = static_cast<float>(max) + Profile::kBoxMargin;
    }
  }

  uint32_t add_children() {
    const auto children = static_cast<uint32_t>(nodes_.size());
    nodes_.resize(nodes_.size() + 2);
    return children;
  }

  void merge(uint32_t node, uint32_t children, bool is_chain) {
    const Profile::Node &a = nodes_[children], &b = nodes_[children + 1];
    Profile::Node& merged = nodes_[node];
    merged = {a.min, a.max, a.begin, b.end, children, is_chain};
    for (size_t axis = 0; axis < 2; ++axis) {
      merged.min[axis] = std::min(a.min[axis], b.min[axis]);
      merged.max[axis] = std::max(a.max[axis], b.max[axis]);
    }
  }

  std::span<const ProfilePiece> pieces_;
  std::span<const uint32_t> loop_begins_;
  std::vector<Profile::Node> nodes_;
};

/// Returns a bound of the squared distance of a piece's points from the origin.
double furthest2(const ProfilePiece& piece) {
  if (piece.is_line()) return glm::dot(piece.end, piece.end);
  // Between two points a curve is within the triangle of their tangents, whose size falls with the
  // square of their distance.
  constexpr double kParts = 32;
  const Vec3 start(piece.start, 1.0), control = piece.weight * Vec3(piece.control, 1.0),
                                      end(piece.end, 1.0);
  double result = 0;
  for (int i = 0; i < kParts; ++i) {
    const double from = i / kParts, to = (i + 1) / kParts;
    // The curve's polar form is that of its control points.
    const Vec3 corner =
        (1 - from) * ((1 - to) * start + to * control) + from * ((1 - to) * control + to * end);
    const Vec3 at =
        (1 - to) * ((1 - to) * start + to * control) + to * ((1 - to) * control + to * end);
    for (const Vec3& p : {corner, at}) {
      result = std::max(result, (p.x * p.x + p.y * p.y) / (p.z * p.z));
    }
  }
  return result;
}

/// Returns the parameter, as the share of `end`, at which a curve is furthest along a direction, if
/// that is not at an end. The heights above the start are those along the direction.
std::optional<double> summit(double control, double end, double weight) {
  // At the summit h the quadratic form of the heights less h has a double root.
  if (!(weight > 0)) return {};
  const double w2 = weight * weight;
  // w²(c − h)² = −h·(e − h), of which the summit is the larger root.
  const double a = w2 - 1, b = w2 * control - 0.5 * end, c = w2 * control * control;
  const double root = std::sqrt(std::max(0.0, b * b - a * c));
  const double q = b + std::copysign(root, b);
  double best = std::max(0.0, end);
  std::optional<double> result;
  for (const double h : {c / q, q / a}) {
    if (!(h > best) || !(h <= control)) continue;
    best = h;
    result = weight * (control - h) / (weight * (control - h) + h - end);
  }
  return result;
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

Profile::Profile(std::vector<ProfileLoop> loops, FillRule fill_rule)
    : loops_(std::move(loops)), fill_rule_(fill_rule) {
  leave_out_points(loops_);
  std::vector<LoopPieces> parts(loops_.size());
  LongBox box;
  for (size_t i = 0; i < loops_.size(); ++i) {
    Vec2 start = loops_[i].back().end;
    for (const ProfileEdge& edge : loops_[i]) {
      append_pieces(start, edge, parts[i].pieces);
      start = edge.end;
    }
    const LongBox own = box_of(parts[i].pieces);
    parts[i].middle = own.middle();
    box.min = glm::min(box.min, own.min);
    box.max = glm::max(box.max, own.max);
  }
  if (loops_.empty()) return;
  min_x_ = static_cast<double>(box.min.x);
  order_by_place(parts);

  center_ = Vec2(box.middle());
  const LongVec2 half = 0.5L * box.max - 0.5L * box.min;
  has_area_ = half.x > 0 && half.y > 0;
  for (int axis = 0; axis < 2; ++axis) {
    half_[axis] = half[axis] > 0 ? static_cast<double>(half[axis]) : 1;
  }
  const double furthest = std::max(std::abs(center_.x) + half_.x, half_.x);
  radii_ = {center_.x / furthest, half_.x / furthest};

  const auto to_canonical = [&](const LongVec2& p) {
    const LongVec2 place = (p - LongVec2(center_)) / LongVec2(half_);
    return glm::clamp(Vec2(place), Vec2(-1.0), Vec2(1.0));
  };
  std::vector<uint32_t> loop_begins;
  double reach2 = 0;
  for (const LoopPieces& loop : parts) {
    loop_begins.push_back(static_cast<uint32_t>(pieces_.size()));
    Vec2 start = to_canonical(loop.pieces.back().end);
    for (const LongPiece& piece : loop.pieces) {
      const Vec2 end = to_canonical(piece.end);
      pieces_.push_back(
          {start, to_canonical(piece.control), end, static_cast<double>(piece.weight)});
      reach2 = std::max(reach2, furthest2(pieces_.back()));
      start = end;
    }
  }
  loop_begins.push_back(static_cast<uint32_t>(pieces_.size()));
  constexpr double kBeyondRounding = 1 + 1e-9;
  reach_ = std::sqrt(reach2) * kBeyondRounding;
  nodes_ = ProfileBvhBuilder(pieces_, loop_begins).take();
}

Vec2 Profile::support(const Vec2& direction) const {
  Vec2 best{0.0};
  double furthest = -kInfinity;
  const auto consider = [&](const Vec2& point) {
    const double along = glm::dot(direction, point);
    if (along > furthest) furthest = along, best = point;
  };
  for (const ProfilePiece& piece : pieces_) {
    consider(piece.end);
    if (piece.is_line() || !(glm::dot(direction, piece.control) > furthest)) continue;
    const auto share = summit(glm::dot(direction, piece.control - piece.start),
                              glm::dot(direction, piece.end - piece.start), piece.weight);
    if (share) consider(curve_point(piece, {1 - *share, *share}));
  }
  return best;
}

bool same_profile(const Profile* a, const Profile* b) {
  if (a == b) return true;
  if (!a || !b || a->fill_rule() != b->fill_rule()) return false;
  const auto same_edge = [](const ProfileEdge& e, const ProfileEdge& f) {
    if (e.kind != f.kind || e.end != f.end) return false;
    if (e.kind == ProfileEdge::Kind::kLine) return true;
    return e.control == f.control &&
           (e.kind != ProfileEdge::Kind::kArc || e.is_counterclockwise == f.is_counterclockwise);
  };
  return std::ranges::equal(a->loops(), b->loops(),
                            [&](const ProfileLoop& p, const ProfileLoop& q) {
                              return std::ranges::equal(p, q, same_edge);
                            });
}

}  // namespace csgcore
