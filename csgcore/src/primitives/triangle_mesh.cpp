#include "csgcore/triangle_mesh.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <numeric>
#include <utility>

#include "base/constants.hpp"
#include "csgcore/stop_scope.hpp"
#include "primitives/mesh_edges.hpp"
#include "primitives/planar_turn.hpp"

namespace csgcore {
namespace {

using Triangle = TriangleMesh::Triangle;

/// Loops are divided into parts of at least so many triangles or vertices.
constexpr size_t kTrianglesAtOnce = 4096;

template <typename Visit>
void for_each_index(size_t count, const Visit& visit) {
  tbb::parallel_for(tbb::blocked_range<size_t>(0, count, kTrianglesAtOnce),
                    [&, stop = stop_of_work](const auto& range) {
                      const StopScope scope(stop);
                      stop_point();
                      for (size_t i = range.begin(); i < range.end(); ++i) visit(i);
                    });
}

/// A box in float, which holds what it is merged with. The fourth coordinates are not its own: with
/// them, boxes are merged by instructions of four lanes.
struct alignas(16) FloatBox {
  std::array<float, 4> min, max;

  static FloatBox empty() {
    constexpr float kNone = std::numeric_limits<float>::infinity();
    return {{kNone, kNone, kNone, kNone}, {-kNone, -kNone, -kNone, -kNone}};
  }
  void merge(const FloatBox& other) {
    for (size_t axis = 0; axis < 4; ++axis) {
      min[axis] = std::min(min[axis], other.min[axis]);
      max[axis] = std::max(max[axis], other.max[axis]);
    }
  }
  /// Half the surface; 0 if the box is empty.
  float area() const {
    const float x = max[0] - min[0], y = max[1] - min[1], z = max[2] - min[2];
    return x < 0 ? 0 : x * y + y * z + z * x;
  }
};

/// Builds a BVH top down, by the surface area heuristic over equal bins of the triangles' middles
/// along the longest side (Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies",
/// 2007).
class MeshBvhBuilder {
 public:
  MeshBvhBuilder(std::span<const Triangle> triangles, std::span<const Vec3> vertices)
      : count_(static_cast<uint32_t>(triangles.size())),
        items_(std::make_unique_for_overwrite<Item[]>(count_)),
        nodes_(std::make_unique_for_overwrite<TriangleMesh::Node[]>(2 * size_t{count_})) {
    for_each_index(count_, [&](size_t i) {
      items_[i] = item_of(triangles[i], static_cast<uint32_t>(i), vertices);
    });
    build(0, 0, count_, bounds_of(0, count_));
  }

  /// Returns the triangles in the order of the leaves.
  std::vector<uint32_t> order() const {
    std::vector<uint32_t> result(count_);
    for (uint32_t i = 0; i < count_; ++i) result[i] = items_[i].triangle();
    return result;
  }

  /// Returns the nodes in an order that does not depend on the threads: those next to the root come
  /// first, so that a ray's first steps stay in few cache lines.
  std::vector<TriangleMesh::Node> nodes() const {
    std::vector<TriangleMesh::Node> result(used_);
    result[0] = nodes_[0];
    uint32_t end = 1;
    for (uint32_t i = 0; i < end; ++i) {
      if (result[i].count > 0) continue;
      const uint32_t children = result[i].first;
      result[i].first = end;
      result[end++] = nodes_[children];
      result[end++] = nodes_[children + 1];
    }
    return result;
  }

 private:
  /// The box of a triangle, larger than need be by kBoxMargin, which covers the rounding to float.
  /// The fourth coordinate of `min` holds the bits of the triangle's number.
  struct Item {
    FloatBox box;

    uint32_t triangle() const { return std::bit_cast<uint32_t>(box.min[3]); }
    /// Twice the middle of the box.
    float middle(size_t axis) const { return box.min[axis] + box.max[axis]; }
  };
  static Item item_of(const Triangle& triangle, uint32_t number, std::span<const Vec3> vertices) {
    Item item;
    for (size_t axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<int>(axis);
      const double a = vertices[triangle[0]][i], b = vertices[triangle[1]][i],
                   c = vertices[triangle[2]][i];
      item.box.min[axis] = static_cast<float>(std::min({a, b, c})) - TriangleMesh::kBoxMargin;
      item.box.max[axis] = static_cast<float>(std::max({a, b, c})) + TriangleMesh::kBoxMargin;
    }
    item.box.min[3] = std::bit_cast<float>(number);
    item.box.max[3] = 0;
    return item;
  }

  /// What some items lie in.
  struct Bounds {
    FloatBox boxes = FloatBox::empty(), middles = FloatBox::empty();
    uint32_t count = 0;

    void add(const Item& item) {
      FloatBox middle;
      for (size_t axis = 0; axis < 4; ++axis) {
        middle.min[axis] = middle.max[axis] = item.middle(axis);
      }
      boxes.merge(item.box);
      middles.merge(middle);
      ++count;
    }
    void merge(const Bounds& other) {
      boxes.merge(other.boxes);
      middles.merge(other.middles);
      count += other.count;
    }
  };
  Bounds bounds_of(uint32_t begin, uint32_t end) const {
    Bounds bounds;
    for (uint32_t i = begin; i < end; ++i) bounds.add(items_[i]);
    return bounds;
  }

  void build(uint32_t node, uint32_t begin, uint32_t end, const Bounds& bounds) {
    const auto& [min, max] = bounds.boxes;
    nodes_[node] = {{min[0], min[1], min[2]}, {max[0], max[1], max[2]}, begin, end - begin};
    if (end - begin <= TriangleMesh::kLeafTriangles) return;
    const Division division = divide(bounds.middles, begin, end);
    const uint32_t split = begin + division.below.count;
    const uint32_t children = used_.fetch_add(2, std::memory_order_relaxed);
    nodes_[node].first = children;
    nodes_[node].count = 0;
    const auto below = [&] { build(children, begin, split, division.below); };
    const auto above = [&] { build(children + 1, split, end, division.above); };
    if (end - begin > kTrianglesAtOnce) {
      const auto stoppable = [stop = stop_of_work](const auto& half) {
        return [&half, stop] {
          const StopScope scope(stop);
          stop_point();
          half();
        };
      };
      tbb::parallel_invoke(stoppable(below), stoppable(above));
    } else {
      below();
      above();
    }
  }

  static constexpr size_t kBins = 16;
  struct Division {
    Bounds below, above;
  };

  /// Divides items into two parts that both have some.
  Division divide(const FloatBox& middles, uint32_t begin, uint32_t end) {
    size_t axis = 0;
    float length = -1;
    for (size_t i = 0; i < 3; ++i) {
      if (middles.max[i] - middles.min[i] > length) {
        length = middles.max[i] - middles.min[i];
        axis = i;
      }
    }
    const auto in_halves = [&]() -> Division {
      const uint32_t half = begin + (end - begin) / 2;
      return {bounds_of(begin, half), bounds_of(half, end)};
    };
    if (!(length > 0)) return in_halves();
    // More bins than items tell little more.
    const size_t bin_count = std::min<size_t>(kBins, end - begin);
    const float scale = static_cast<float>(bin_count) / length;
    const auto bin_of = [&](const Item& item) {
      const auto bin = static_cast<int32_t>((item.middle(axis) - middles.min[axis]) * scale);
      return std::min(static_cast<size_t>(bin), bin_count - 1);
    };
    std::array<Bounds, kBins> bins;
    for (uint32_t i = begin; i < end; ++i) bins[bin_of(items_[i])].add(items_[i]);
    std::array<float, kBins> cost_above{};
    Bounds above;
    for (size_t bin = bin_count; bin-- > 1;) {
      above.boxes.merge(bins[bin].boxes);
      above.count += bins[bin].count;
      cost_above[bin] = above.boxes.area() * static_cast<float>(above.count);
    }
    Bounds below;
    float least = std::numeric_limits<float>::infinity();
    size_t best = 0;
    for (size_t bin = 1; bin < bin_count; ++bin) {
      below.boxes.merge(bins[bin - 1].boxes);
      below.count += bins[bin - 1].count;
      if (below.count == 0 || below.count == end - begin) continue;
      const float cost = below.boxes.area() * static_cast<float>(below.count) + cost_above[bin];
      if (cost < least) least = cost, best = bin;
    }
    if (best == 0) return in_halves();
    // Without a branch: which way an item goes, no processor can foresee.
    for (uint32_t i = begin, split = begin; i < end; ++i) {
      const Item item = items_[i];
      items_[i] = items_[split];
      items_[split] = item;
      split += bin_of(item) < best ? 1 : 0;
    }
    Division division;
    for (size_t bin = 0; bin < bin_count; ++bin) {
      (bin < best ? division.below : division.above).merge(bins[bin]);
    }
    return division;
  }

  uint32_t count_;
  std::unique_ptr<Item[]> items_;
  std::unique_ptr<TriangleMesh::Node[]> nodes_;
  std::atomic<uint32_t> used_ = 1;
};

struct LongVec3 {
  long double x, y, z;
};
LongVec3 operator-(const LongVec3& a, const LongVec3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
LongVec3 cross(const LongVec3& a, const LongVec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
long double dot(const LongVec3& a, const LongVec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// Returns a vector of length 1 that is perpendicular to another one.
LongVec3 perpendicular(const LongVec3& v) {
  const LongVec3 other =
      cross(v, std::abs(v.x) < std::abs(v.y) ? LongVec3{1, 0, 0} : LongVec3{0, 1, 0});
  const long double length = std::sqrt(dot(other, other));
  if (!(length > 0)) return {0, 0, 1};
  return {other.x / length, other.y / length, other.z / length};
}

/// Returns the plane of a triangle. Differences of coordinates may cancel, and are taken in long
/// double.
TriangleMesh::Plane plane_of(const TriangleMesh::Canonical& canonical, const Vec3& a, const Vec3& b,
                             const Vec3& c) {
  const auto to_canonical = [&](const Vec3& v) {
    return LongVec3{(static_cast<long double>(v.x) - canonical.center.x) / canonical.scale.x,
                    (static_cast<long double>(v.y) - canonical.center.y) / canonical.scale.y,
                    (static_cast<long double>(v.z) - canonical.center.z) / canonical.scale.z};
  };
  const LongVec3 corner = to_canonical(a);
  const LongVec3 ab = to_canonical(b) - corner, ac = to_canonical(c) - corner, bc = ac - ab;
  LongVec3 normal = cross(ab, ac);
  const long double length = std::sqrt(dot(normal, normal));
  if (length > 0) {
    normal = {normal.x / length, normal.y / length, normal.z / length};
  } else {
    const long double lengths2[] = {dot(ab, ab), dot(ac, ac), dot(bc, bc)};
    const auto longest = std::max_element(lengths2, lengths2 + 3) - lengths2;
    normal = perpendicular(longest == 0 ? ab : longest == 1 ? ac : bc);
  }
  return {
      {static_cast<double>(normal.x), static_cast<double>(normal.y), static_cast<double>(normal.z)},
      static_cast<double>(dot(normal, corner))};
}

/// Returns the squared distance of a point from the edge from a to b.
double distance2_to(const Vec3& point, const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a;
  const double length2 = glm::dot(along, along);
  const double share = length2 > 0 ? std::clamp(glm::dot(point - a, along) / length2, 0.0, 1.0) : 0;
  const Vec3 off = point - (a + share * along);
  return glm::dot(off, off);
}

/// Returns the squared distance of a point from a triangle.
double distance2_to(const Vec3& point, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = glm::cross(b - a, c - a);
  const auto is_inward = [&](const Vec3& from, const Vec3& to) {
    return glm::dot(glm::cross(to - from, point - from), normal) >= 0;
  };
  const double length2 = glm::dot(normal, normal);
  if (length2 > 0 && is_inward(a, b) && is_inward(b, c) && is_inward(c, a)) {
    const double height = glm::dot(point - a, normal);
    return height * height / length2;
  }
  return std::min(
      {distance2_to(point, a, b), distance2_to(point, b, c), distance2_to(point, c, a)});
}

}  // namespace

TriangleMesh::TriangleMesh(std::vector<Vec3> vertices, std::vector<Triangle> triangles,
                           std::vector<std::optional<Color>> colors)
    : vertices_(std::move(vertices)), triangles_(std::move(triangles)), colors_(std::move(colors)) {
  assert(colors_.empty() || colors_.size() == triangles_.size());
  const auto is_line = [](const Triangle& t) {
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
  };
  // The triangle of each colour is still there.
  const Triangle* next = triangles_.data();
  std::erase_if(colors_, [&](const auto&) { return is_line(*next++); });
  std::erase_if(triangles_, is_line);
  if (!is_balanced(triangles_)) {
    face_alike(triangles_);
    open_edges_ = count_open_edges(triangles_);
  }
  find_canonical();
  build_bvh();
  find_planes();
}

void TriangleMesh::find_canonical() {
  Box box;
  for (const Vec3& vertex : vertices_) box.merge(vertex);
  canonical_.center = box.center();
  Vec3 half = 0.5 * box.max - 0.5 * box.min;
  const double largest = std::max({half.x, half.y, half.z});
  if (!(largest > 0)) half = Vec3(1.0);
  // A flat mesh gets a thickness, so that its space is one.
  constexpr double kLeastHalf = 0x1p-20;
  half = glm::max(half, Vec3(kLeastHalf * largest));
  double radius2 = 0;
  for (const Vec3& vertex : vertices_) {
    const Vec3 place = (vertex - canonical_.center) / half;
    radius2 = std::max(radius2, glm::dot(place, place));
  }
  constexpr double kBeyondRounding = 1 + 1e-9;
  if (radius2 > 0) half *= std::sqrt(radius2) * kBeyondRounding;
  canonical_.scale = half;
  canonical_vertices_.resize(vertices_.size());
  for_each_index(vertices_.size(), [&](size_t i) {
    canonical_vertices_[i] = (vertices_[i] - canonical_.center) / canonical_.scale;
  });
}

void TriangleMesh::build_bvh() {
  if (triangles_.empty()) return;
  const MeshBvhBuilder builder(triangles_, canonical_vertices_);
  nodes_ = builder.nodes();
  const std::vector<uint32_t> order = builder.order();
  std::vector<Triangle> ordered(triangles_.size());
  for_each_index(order.size(), [&](size_t i) { ordered[i] = triangles_[order[i]]; });
  triangles_ = std::move(ordered);
  if (colors_.empty()) return;
  std::vector<std::optional<Color>> ordered_colors;
  for (const uint32_t i : order) ordered_colors.push_back(colors_[i]);
  colors_ = std::move(ordered_colors);
}

void TriangleMesh::find_planes() {
  planes_.resize(triangles_.size());
  for_each_index(triangles_.size(), [&](size_t i) {
    const Triangle& triangle = triangles_[i];
    planes_[i] = plane_of(canonical_, vertices_[triangle[0]], vertices_[triangle[1]],
                          vertices_[triangle[2]]);
  });
}

int TriangleMesh::winding(const Vec3& point) const {
  // The crossings of a ray along the x axis.
  int winding = 0;
  any_near({point, {kInfinity, point.y, point.z}}, [&](uint32_t i) {
    const Vec3 corners[] = {canonical_vertices_[triangles_[i][0]],
                            canonical_vertices_[triangles_[i][1]],
                            canonical_vertices_[triangles_[i][2]]};
    const auto seen = [&](int corner) {
      return PlanarPoint{corners[corner].y - point.y, corners[corner].z - point.z};
    };
    const int turn = winding_of(seen(0), seen(1), seen(2));
    if (turn == 0) return false;
    const auto [nearest, furthest] =
        depth_range({seen(0), seen(1), seen(2)}, {corners[0].x, corners[1].x, corners[2].x});
    const Plane& plane = planes_[i];
    const double gap = (plane.offset - glm::dot(plane.normal, point)) / plane.normal.x;
    const double x = std::isnan(gap) ? nearest : std::clamp(point.x + gap, nearest, furthest);
    if (x > point.x) winding += turn;
    return false;
  });
  return winding;
}

Vec3 TriangleMesh::support(const Vec3& direction) const {
  Vec3 best = canonical_vertices_.front();
  double furthest = -kInfinity;
  const auto reach_of = [&](const TriangleMesh::Node& node) {
    double reach = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<size_t>(axis);
      reach +=
          std::max(direction[axis] * double{node.min[i]}, direction[axis] * double{node.max[i]});
    }
    return reach;
  };
  std::vector<std::pair<double, uint32_t>> open;
  if (!nodes_.empty()) open.emplace_back(reach_of(nodes_[0]), 0u);
  while (!open.empty()) {
    const auto [reach, index] = open.back();
    open.pop_back();
    if (reach <= furthest) continue;
    const TriangleMesh::Node& node = nodes_[index];
    if (node.count == 0) {
      std::pair<double, uint32_t> children[] = {{reach_of(nodes_[node.first]), node.first},
                                                {reach_of(nodes_[node.first + 1]), node.first + 1}};
      if (children[0].first > children[1].first) std::swap(children[0], children[1]);
      open.push_back(children[0]);
      open.push_back(children[1]);
      continue;
    }
    for (uint32_t i = node.first; i < node.first + node.count; ++i) {
      for (const uint32_t vertex : triangles_[i]) {
        const double along = glm::dot(direction, canonical_vertices_[vertex]);
        if (along > furthest) furthest = along, best = canonical_vertices_[vertex];
      }
    }
  }
  return best;
}

std::optional<Color> TriangleMesh::color_at(const Vec3& point) const {
  if (colors_.empty()) return std::nullopt;
  double nearest2 = kInfinity;
  uint32_t face = 0;
  any_near({point, point}, [&](uint32_t i) {
    const double distance2 =
        distance2_to(point, canonical_vertices_[triangles_[i][0]],
                     canonical_vertices_[triangles_[i][1]], canonical_vertices_[triangles_[i][2]]);
    if (distance2 < nearest2 || (distance2 == nearest2 && i < face)) {
      nearest2 = distance2;
      face = i;
    }
    return false;
  });
  return nearest2 < kInfinity ? colors_[face] : std::nullopt;
}

bool same_mesh(const TriangleMesh* a, const TriangleMesh* b) {
  if (a == b) return true;
  if (!a || !b) return false;
  return std::ranges::equal(a->vertices(), b->vertices()) &&
         std::ranges::equal(a->triangles(), b->triangles()) &&
         std::ranges::equal(a->colors(), b->colors());
}

}  // namespace csgcore
