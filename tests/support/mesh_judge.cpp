#include "mesh_judge.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <unordered_map>

namespace test_support {
namespace {

using csgcore::CsgToken;
using csgcore::Op;
using csgcore::TriangleSet;
using csgcore::Vec3;
using Wide = long double;
using WideVec = glm::tvec3<Wide>;

constexpr Wide kWideEpsilon = std::numeric_limits<Wide>::epsilon();

template <typename... Values>
std::string text(const char* format, Values... values) {
  char buffer[400];
  std::snprintf(buffer, sizeof(buffer), format, values...);
  return buffer;
}

std::string text_of(const Vec3& p) { return text("(%.17g, %.17g, %.17g)", p.x, p.y, p.z); }

std::string text_of(const TriangleSet& surface, size_t triangle) {
  std::string result = text("triangle %zu:", triangle);
  for (const uint32_t corner : surface.triangles[triangle]) {
    result += " " + text_of(surface.vertices[corner]);
  }
  return result;
}

double largest_coordinate(const csgcore::Box& box) {
  double largest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    largest = std::max({largest, std::abs(box.min[axis]), std::abs(box.max[axis])});
  }
  return box.empty() ? 0 : largest;
}

/// Returns how far the rounding of its corners to double may move a face.
double corner_rounding(const csgcore::Box& box) {
  return 16 * std::numeric_limits<double>::epsilon() * largest_coordinate(box);
}

/// Returns the length below which differences are taken for rounding.
double judged_rounding(const csgcore::Box& box) {
  if (box.empty()) return 0;
  const Vec3 size = box.size();
  return 0.5 * kRoundingShare * std::max({size.x, size.y, size.z}) + corner_rounding(box);
}

csgcore::Box box_of(const TriangleSet& surface) {
  csgcore::Box box;
  for (const Vec3& vertex : surface.vertices) box.merge(vertex);
  return box;
}

uint64_t edge_key(uint32_t from, uint32_t to) { return uint64_t(from) << 32 | to; }

// Crossing triangles.

struct Corners {
  WideVec p[3];
  WideVec normal;  // of unit length, or 0
};

Corners corners_of(const TriangleSet& surface, size_t triangle) {
  Corners result;
  for (size_t i = 0; i < 3; ++i) {
    result.p[i] = WideVec(surface.vertices[surface.triangles[triangle][i]]);
  }
  const WideVec normal = glm::cross(result.p[1] - result.p[0], result.p[2] - result.p[0]);
  const Wide length = glm::length(normal);
  result.normal = length > 0 ? normal / length : WideVec(0);
  return result;
}

/// How far the corners of one triangle reach from the plane of another, to both sides.
struct Sides {
  Wide at[3];
  Wide above() const { return std::max({at[0], at[1], at[2]}); }
  Wide below() const { return -std::min({at[0], at[1], at[2]}); }
};

Sides sides_of(const Corners& triangle, const Corners& plane) {
  Sides sides{};
  for (int i = 0; i < 3; ++i) sides.at[i] = glm::dot(triangle.p[i] - plane.p[0], plane.normal);
  return sides;
}

struct Stretch {
  Wide low = std::numeric_limits<Wide>::infinity();
  Wide high = -std::numeric_limits<Wide>::infinity();
  void add(Wide at) {
    low = std::min(low, at);
    high = std::max(high, at);
  }
};

/// Returns how far one has to move until they do not overlap.
Wide overlap(const Stretch& a, const Stretch& b) {
  return std::min(a.high - b.low, b.high - a.low);
}

Stretch stretch_along(const Corners& triangle, const WideVec& direction) {
  Stretch stretch;
  for (const WideVec& p : triangle.p) stretch.add(glm::dot(p, direction));
  return stretch;
}

/// Returns how far both, which lie in one plane, overlap: the least way that separates them.
Wide plane_overlap(const Corners& a, const Corners& b) {
  Wide least = std::numeric_limits<Wide>::infinity();
  for (const Corners* own : {&a, &b}) {
    for (int i = 0; i < 3; ++i) {
      const WideVec edge = own->p[(i + 1) % 3] - own->p[i];
      const Wide length = glm::length(edge);
      if (!(length > 0)) continue;
      const WideVec across = glm::cross(own->normal, edge / length);
      least = std::min(least, overlap(stretch_along(a, across), stretch_along(b, across)));
    }
  }
  return least;
}

/// Returns the shortest way by which one of two triangles that cross has to move until they do not,
/// or a number ≤ `rounding`. It is along a normal of one of them, or across an edge of each (the
/// axes of the separating axis theorem). If both lie in one plane, they do not leave it; but if
/// that is so up to rounding only, and they face opposite sides, they bound something thin.
Wide crossing_size(const Corners& a, const Corners& b, Wide rounding) {
  const Sides a_sides = sides_of(a, b), b_sides = sides_of(b, a);
  const bool a_is_flat = std::max(a_sides.above(), a_sides.below()) <= rounding;
  const bool b_is_flat = std::max(b_sides.above(), b_sides.below()) <= rounding;
  if (a_is_flat && b_is_flat) {
    const bool is_exact = a_sides.above() == 0 && a_sides.below() == 0;
    return is_exact || glm::dot(a.normal, b.normal) > 0 ? plane_overlap(a, b) : 0;
  }
  Wide least = std::min({a_sides.above(), a_sides.below(), b_sides.above(), b_sides.below()});
  const auto try_across = [&](const WideVec& u, const WideVec& v) {
    const WideVec across = glm::cross(u, v);
    const Wide length = glm::length(across);
    if (least <= rounding || !(length > 0)) return;
    least = std::min(least,
                     overlap(stretch_along(a, across / length), stretch_along(b, across / length)));
  };
  for (int i = 0; i < 3; ++i) {
    const WideVec a_edge = a.p[(i + 1) % 3] - a.p[i], b_edge = b.p[(i + 1) % 3] - b.p[i];
    for (int k = 0; k < 3; ++k) try_across(a_edge, b.p[(k + 1) % 3] - b.p[k]);
    // Superfluous but for triangles so narrow that rounding turns them.
    for (const WideVec& normal : {a.normal, b.normal}) {
      try_across(a_edge, normal);
      try_across(b_edge, normal);
    }
  }
  return least;
}

// Lines.

/// The sign of (a − p) × (b − p), with 0 if rounding may have changed it.
struct Turn {
  Wide value;
  Wide error;
  int sign() const { return value > error ? 1 : value < -error ? -1 : 0; }
};

/// What a primitive or an operation is before and after a crossing, and who shows its change.
struct Change {
  bool before, after;
  int64_t shown;  // the operand, or -1
};

Change combined(Op op, std::span<const Change> operands) {
  Change result = operands[0];
  for (size_t i = 1; i < operands.size(); ++i) {
    const Change& next = operands[i];
    if (op == Op::kUnion) {
      result.before |= next.before;
      result.after |= next.after;
    } else if (op == Op::kIntersection) {
      result.before &= next.before;
      result.after &= next.after;
    } else {
      result.before &= !next.before;
      result.after &= !next.after;
    }
  }
  result.shown = -1;
  if (result.before == result.after) return result;
  for (size_t i = 0; i < operands.size(); ++i) {
    const bool is_subtracted = op == Op::kDifference && i > 0;
    const Change& own = operands[i];
    if (own.before != own.after && (own.after == result.after) != is_subtracted) {
      result.shown = std::max(result.shown, own.shown);
    }
  }
  return result;
}

}  // namespace

std::string manifold_flaw(const TriangleSet& surface) {
  const auto vertices = surface.vertices.size();
  for (const Vec3& p : surface.vertices) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
      return "a vertex is not finite";
    }
  }
  std::unordered_map<uint64_t, uint32_t> edges;  // to the triangle
  std::vector<uint32_t> degree(vertices);
  for (size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto& triangle = surface.triangles[t];
    for (size_t i = 0; i < 3; ++i) {
      const uint32_t from = triangle[i], to = triangle[(i + 1) % 3];
      if (from >= vertices) return text("triangle %zu names a vertex that is not there", t);
      if (from == to) return text("triangle %zu names a vertex twice", t);
      if (!edges.emplace(edge_key(from, to), uint32_t(t)).second) {
        return "two triangles have an edge in the same direction; " + text_of(surface, t);
      }
      ++degree[from];
    }
  }
  for (const auto& [key, triangle] : edges) {
    if (!edges.contains(key << 32 | key >> 32)) {
      return "an edge has no second triangle; " + text_of(surface, triangle);
    }
  }
  // Turning about a vertex from any of its triangles must meet all of them.
  std::vector<bool> is_seen(vertices);
  for (const auto& triangle : surface.triangles) {
    for (size_t i = 0; i < 3; ++i) {
      const uint32_t center = triangle[i];
      if (is_seen[center]) continue;
      is_seen[center] = true;
      uint32_t count = 0;
      uint32_t spoke = triangle[(i + 1) % 3];
      const uint32_t first = spoke;
      do {
        const auto& own = surface.triangles[edges.at(edge_key(center, spoke))];
        for (const uint32_t corner : own) {
          if (corner == center || corner == spoke) continue;
          spoke = corner;
          break;
        }
        ++count;
      } while (spoke != first && count <= degree[center]);
      if (count != degree[center]) {
        return "the triangles of a vertex are not one fan; it is " +
               text_of(surface.vertices[center]);
      }
    }
  }
  return "";
}

uint64_t flat_triangles(const TriangleSet& surface) {
  uint64_t flat = 0;
  for (const auto& [a, b, c] : surface.triangles) {
    const WideVec u = WideVec(surface.vertices[b]) - WideVec(surface.vertices[a]);
    const WideVec v = WideVec(surface.vertices[c]) - WideVec(surface.vertices[a]);
    flat += glm::cross(u, v) == WideVec(0);
  }
  return flat;
}

std::string crossing_flaw(const TriangleSet& surface) {
  const Wide rounding = judged_rounding(box_of(surface));
  std::vector<Corners> corners;
  std::vector<csgcore::Box> boxes;
  for (size_t t = 0; t < surface.triangles.size(); ++t) {
    corners.push_back(corners_of(surface, t));
    csgcore::Box box;
    for (const uint32_t corner : surface.triangles[t]) box.merge(surface.vertices[corner]);
    boxes.push_back(box);
  }
  std::vector<uint32_t> order(boxes.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](uint32_t a, uint32_t b) { return boxes[a].min.x < boxes[b].min.x; });
  std::vector<uint32_t> open;  // triangles that the sweep along x is in
  for (const uint32_t t : order) {
    std::erase_if(open, [&](uint32_t other) { return boxes[other].max.x < boxes[t].min.x; });
    for (const uint32_t other : open) {
      const csgcore::Box &a = boxes[t], &b = boxes[other];
      if (a.min.y > b.max.y || b.min.y > a.max.y || a.min.z > b.max.z || b.min.z > a.max.z) {
        continue;
      }
      const Wide size = crossing_size(corners[t], corners[other], rounding);
      if (size > rounding) {
        return text("triangles cross by %.3Lg; ", size) + text_of(surface, other) + "; " +
               text_of(surface, t);
      }
    }
    open.push_back(t);
  }
  return "";
}

long double volume_of(const TriangleSet& surface) {
  if (surface.vertices.empty()) return 0;
  const WideVec origin(surface.vertices[0]);
  Wide sum = 0;
  for (const auto& [a, b, c] : surface.triangles) {
    const WideVec u = WideVec(surface.vertices[a]) - origin;
    const WideVec v = WideVec(surface.vertices[b]) - origin;
    sum += glm::dot(glm::cross(u, v), WideVec(surface.vertices[c]) - origin);
  }
  return sum / 6;
}

long double area_of(const TriangleSet& surface) {
  Wide sum = 0;
  for (const auto& [a, b, c] : surface.triangles) {
    const WideVec origin(surface.vertices[a]);
    sum += glm::length(
        glm::cross(WideVec(surface.vertices[b]) - origin, WideVec(surface.vertices[c]) - origin));
  }
  return sum / 2;
}

long double edge_length_of(const TriangleSet& surface) {
  Wide sum = 0;
  for (const auto& triangle : surface.triangles) {
    for (size_t i = 0; i < 3; ++i) {
      sum += glm::length(WideVec(surface.vertices[triangle[i]]) -
                         WideVec(surface.vertices[triangle[(i + 1) % 3]]));
    }
  }
  return sum / 2;
}

/// A line along an axis, through a point of the next two axes.
struct LineJudge::Line {
  int axis = 0;
  double u = 0, v = 0;
};

struct LineJudge::Crossing {
  Wide at, error;
  int turn;         // 1: the line enters
  int64_t operand;  // or -1: the result
  size_t triangle;
  WideVec normal;
};

LineJudge::LineJudge(std::span<const TriangleSet> operands, const csgcore::CsgTree& tree,
                     const csgcore::BoundaryMesh& result, double input_rounding)
    : operands_(operands), tree_(tree), result_(result), input_rounding_(input_rounding) {
  for (const TriangleSet& operand : operands) box_.merge(box_of(operand));
  rounding_ = std::max(judged_rounding(box_), input_rounding);
}

LineJudge::Line LineJudge::random_line(std::mt19937& random) const {
  std::uniform_real_distribution<double> uniform(-0.05, 1.05);
  Vec3 point = box_.min + box_.size() * Vec3(uniform(random), uniform(random), uniform(random));
  const TriangleSet& surface = random() % 2 ? operands_[random() % operands_.size()]
                                            : static_cast<const TriangleSet&>(result_);
  if (random() % 2 && !surface.vertices.empty()) {
    // By a random step that is now small and now large.
    const double step =
        std::exp2((input_rounding_ > 0 ? -20.0 : -40.0) * std::abs(uniform(random)));
    point = surface.vertices[random() % surface.vertices.size()] + step * (point - box_.center());
  }
  const int axis = static_cast<int>(random() % 3);
  return {axis, point[(axis + 1) % 3], point[(axis + 2) % 3]};
}

std::string LineJudge::flaw(uint32_t lines, uint32_t seed, LineTotals& totals) const {
  if (box_.empty()) return "";
  std::mt19937 random(seed);
  for (uint32_t i = 0; i < lines; ++i) {
    const std::string found = flaw_along(random_line(random), totals);
    if (!found.empty()) return found;
  }
  return "";
}

std::string LineJudge::flaw_along(const Line& line, LineTotals& totals) const {
  ++totals.lines;
  const int axis = line.axis, u = (axis + 1) % 3, v = (axis + 2) % 3;
  std::vector<Crossing> crossings;
  bool is_decided = true;
  const auto collect = [&](const TriangleSet& surface, int64_t operand) {
    for (size_t t = 0; t < surface.triangles.size(); ++t) {
      Vec3 p[3];
      for (size_t i = 0; i < 3; ++i) p[i] = surface.vertices[surface.triangles[t][i]];
      if (std::max({p[0][u], p[1][u], p[2][u]}) < line.u ||
          std::min({p[0][u], p[1][u], p[2][u]}) > line.u ||
          std::max({p[0][v], p[1][v], p[2][v]}) < line.v ||
          std::min({p[0][v], p[1][v], p[2][v]}) > line.v) {
        continue;
      }
      // The differences have relative errors of one unit, and the products of some more.
      Turn turns[3];
      for (int i = 0; i < 3; ++i) {
        const Vec3 &a = p[(i + 1) % 3], &b = p[(i + 2) % 3];
        const Wide left = (Wide(a[u]) - line.u) * (Wide(b[v]) - line.v);
        const Wide right = (Wide(a[v]) - line.v) * (Wide(b[u]) - line.u);
        turns[i] = {left - right, 8 * kWideEpsilon * (std::abs(left) + std::abs(right))};
      }
      const bool is_left = turns[0].sign() < 0 || turns[1].sign() < 0 || turns[2].sign() < 0;
      const bool is_right = turns[0].sign() > 0 || turns[1].sign() > 0 || turns[2].sign() > 0;
      if (is_left && is_right) continue;
      if (turns[0].sign() == 0 || turns[1].sign() == 0 || turns[2].sign() == 0) {
        is_decided = false;
        return;
      }
      const Wide sum = turns[0].value + turns[1].value + turns[2].value;
      Wide at = 0;
      for (int i = 0; i < 3; ++i) at += turns[i].value / sum * p[i][axis];
      const WideVec normal =
          glm::cross(WideVec(p[1]) - WideVec(p[0]), WideVec(p[2]) - WideVec(p[0]));
      const Wide length = glm::length(normal), steepness = std::abs(normal[axis]) / length;
      // Of a needle a billionth wide the corners' shares are known to as many digits less.
      const auto [least, most] = std::minmax({p[0][axis], p[1][axis], p[2][axis]});
      const Wide unsure = (turns[0].error + turns[1].error + turns[2].error) / std::abs(sum);
      crossings.push_back({at, rounding_ / steepness + unsure * (Wide(most) - least),
                           is_left ? 1 : -1, operand, t, normal / length});
    }
  };
  for (size_t i = 0; i < operands_.size() && is_decided; ++i) {
    collect(operands_[i], static_cast<int64_t>(i));
  }
  if (is_decided) collect(result_, -1);
  if (!is_decided) {
    ++totals.undecided;
    return "";
  }
  std::sort(crossings.begin(), crossings.end(),
            [](const Crossing& a, const Crossing& b) { return a.at - a.error < b.at - b.error; });

  const auto where = [&](Wide at) {
    Vec3 point(0.0);
    point[axis] = double(at);
    point[u] = line.u;
    point[v] = line.v;
    return text_of(point) + text(" on a line along axis %d", axis);
  };
  std::vector<int> winding(operands_.size()), winding_before;
  int result_winding = 0;
  std::vector<Change> stack;
  // Returns the change of the tree between the two windings.
  const auto change = [&](const std::vector<int>& before, const std::vector<int>& after) {
    stack.clear();
    for (const CsgToken& token : tree_.tokens()) {
      if (token.is_primitive) {
        const bool is_before = before[token.value] != 0, is_after = after[token.value] != 0;
        stack.push_back({is_before, is_after, is_before != is_after ? int64_t(token.value) : -1});
        continue;
      }
      const size_t first = stack.size() - token.value;
      const Change own = combined(token.op, std::span(stack).subspan(first));
      stack.resize(first);
      stack.push_back(own);
    }
    return stack.empty() ? Change{false, false, -1} : stack.back();
  };
  for (size_t i = 0; i < crossings.size();) {
    // A cluster: crossings that rounding may have ordered.
    winding_before = winding;
    const int result_before = result_winding;
    const size_t first = i;
    Wide end = crossings[i].at + crossings[i].error;
    const Crossing* of_result = nullptr;
    size_t result_crossings = 0;
    for (; i < crossings.size() && crossings[i].at - crossings[i].error <= end; ++i) {
      const Crossing& crossing = crossings[i];
      end = std::max(end, crossing.at + crossing.error);
      if (crossing.operand < 0) {
        result_winding += crossing.turn;
        of_result = &crossing;
        ++result_crossings;
      } else {
        winding[static_cast<size_t>(crossing.operand)] += crossing.turn;
      }
    }
    const Change turned = change(winding_before, winding);
    const Wide next = i < crossings.size() ? crossings[i].at - crossings[i].error : end + 1;
    ++totals.points;
    totals.points_inside += turned.after;
    if (result_winding != (turned.after ? 1 : 0)) {
      return text("the winding number is %d and should be %d at ", result_winding,
                  turned.after ? 1 : 0) +
             where((end + next) / 2);
    }
    if (result_crossings != 1 || result_before == result_winding) continue;
    // Faces that are nearly coincident, or meet in an edge nearby, are no business of this.
    constexpr Wide kOneNormal = 1e-9L;
    const Wide least = corner_rounding(box_) / rounding_;
    const bool is_one_face = std::all_of(
        crossings.begin() + std::ptrdiff_t(first), crossings.begin() + std::ptrdiff_t(i),
        [&](const Crossing& crossing) {
          return std::abs(crossing.at - of_result->at) <=
                     least * std::max(crossing.error, of_result->error) &&
                 glm::length(glm::cross(crossing.normal, of_result->normal)) <= kOneNormal;
        });
    if (!is_one_face) continue;
    ++totals.faces;
    uint32_t last = 0, changed = 0;
    for (uint32_t k = 0; k < winding.size(); ++k) {
      if ((winding_before[k] != 0) == (winding[k] != 0)) continue;
      last = k;
      ++changed;
    }
    totals.coincident += changed > 1;
    totals.not_last += turned.shown != int64_t(last);
    const uint32_t named = result_.operands[of_result->triangle];
    if (int64_t(named) != turned.shown) {
      const bool has_face =
          named < winding.size() && (winding_before[named] != 0) != (winding[named] != 0);
      return text(
                 "a face names operand %u, which has %s face there, instead of %d (last with one: "
                 "%u) at ",
                 named, has_face ? "a" : "no", int(turned.shown), last) +
             where(crossings[first].at);
    }
  }
  if (result_winding != 0) return "the result is open along a line at " + where(0);
  return "";
}

}  // namespace test_support
