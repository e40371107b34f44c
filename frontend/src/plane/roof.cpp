#include "plane/roof.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

#include "plane/roof_edges.hpp"
#include "plane/wavefront.hpp"

namespace frontend {
namespace {

using csgcore::Vec3;

/// Nodes that an arc joins which is no longer are one: some hundred times what rounding makes of
/// events at one place. Coordinates are −1 to 1 here, as below.
constexpr double kSameNode = 1e-11;
/// So far from its plane may a node be.
constexpr double kRoofRounding = 1e-10;

/// The outline moved and scaled so that coordinates are −1 to 1.
struct UnitFrame {
  Vec2 center{0.0};
  double size = 1;  // a power of two

  explicit UnitFrame(const Rectangle& bounds) {
    center = 0.5 * bounds.min + 0.5 * bounds.max;
    const Vec2 half = 0.5 * bounds.max - 0.5 * bounds.min;
    const double reach = std::max(half.x, half.y);
    if (reach > 0) size = std::exp2(std::ceil(std::log2(reach)));
  }
  Vec2 to_unit(const Vec2& point) const { return (point - center) / size; }
  Vec3 from_unit(const Vec2& place, double height) const {
    return {center + size * place, size * height};
  }
};

/// A side of a face.
struct FaceSide {
  uint32_t face, from, to;  // an edge; nodes
  auto operator<=>(const FaceSide&) const = default;
};

/// Returns the sides of all faces, face by face, on the way around each; nothing if those of a face
/// are no single loop.
std::optional<std::vector<FaceSide>> face_sides(const RoofEdges& outline, const Wavefront& wave) {
  std::vector<FaceSide> sides;
  for (uint32_t i = 0; i < outline.edges.size(); ++i) {
    const RoofEdge& edge = outline.edges[i];
    if (edge.start_corner != edge.end_corner) {
      sides.push_back({i, edge.start_corner, edge.end_corner});
    }
  }
  for (const RoofArc& arc : wave.arcs()) {
    sides.push_back({arc.before, arc.from, arc.to});
    sides.push_back({arc.after, arc.to, arc.from});
  }
  std::sort(sides.begin(), sides.end());
  std::vector<FaceSide> ordered;
  ordered.reserve(sides.size());
  for (size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    const uint32_t face = sides[begin].face;
    while (end < sides.size() && sides[end].face == face) ++end;
    const auto first = sides.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto last = sides.begin() + static_cast<std::ptrdiff_t>(end);
    uint32_t node = outline.edges[face].start_corner;
    for (size_t i = begin; i < end; ++i) {
      const auto side = std::lower_bound(first, last, FaceSide{face, node, 0});
      if (side == last || side->from != node) return std::nullopt;
      if (side + 1 != last && side[1].from == node) return std::nullopt;
      ordered.push_back(*side);
      node = side->to;
      if (node == outline.edges[face].start_corner && i + 1 < end) return std::nullopt;
    }
    if (node != outline.edges[face].start_corner) return std::nullopt;
  }
  return ordered;
}

/// Returns whether a face is what a straight skeleton has: its corners lie in its plane, and a line
/// perpendicular to its edge crosses it once at most.
bool is_sound(const RoofEdge& edge, std::span<const FaceSide> sides,
              const std::vector<SkeletonNode>& nodes) {
  std::vector<double> along;
  double twice_area = 0;
  for (const FaceSide& side : sides) {
    const SkeletonNode& from = nodes[side.from];
    if (!(std::abs(edge.ahead(from.place, from.time)) <= kRoofRounding)) return false;
    along.push_back(glm::dot(from.place - edge.start, edge.direction));
    twice_area += cross(from.place - edge.start, nodes[side.to].place - edge.start);
  }
  if (twice_area < -kRoofRounding) return false;
  std::rotate(along.begin(), std::min_element(along.begin(), along.end()), along.end());
  const auto top = std::max_element(along.begin(), along.end());
  double most = along.front();
  for (auto i = along.begin(); i != top; ++i) {
    if (*i < most - kRoofRounding) return false;
    most = std::max(most, *i);
  }
  double least = *top;
  for (auto i = top; i != along.end(); ++i) {
    if (*i > least + kRoofRounding) return false;
    least = std::min(least, *i);
  }
  return true;
}

/// Makes nodes one that are at one place.
class JoinedNodes {
 public:
  explicit JoinedNodes(const Wavefront& wave) : first_(wave.nodes().size()) {
    std::iota(first_.begin(), first_.end(), 0u);
    for (const RoofArc& arc : wave.arcs()) {
      const SkeletonNode& from = wave.nodes()[arc.from];
      const SkeletonNode& to = wave.nodes()[arc.to];
      if (glm::length(to.place - from.place) > kSameNode) continue;
      // A corner of the outline, which comes first, stays where it is.
      const uint32_t a = find(arc.from), b = find(arc.to);
      first_[std::max(a, b)] = std::min(a, b);
    }
  }

  uint32_t find(uint32_t node) {
    while (first_[node] != node) node = first_[node] = first_[first_[node]];
    return node;
  }

 private:
  std::vector<uint32_t> first_;
};

/// Collects the points and faces of the roof.
class RoofBuilder {
 public:
  RoofBuilder(const UnitFrame& frame, std::span<const Vec2> outline_corners, const Wavefront& wave)
      : frame_(frame),
        outline_corners_(outline_corners),
        nodes_(wave.nodes()),
        joined_(wave),
        point_of_(wave.nodes().size(), kNone) {}

  /// A face that touches itself becomes several.
  void add_face(std::span<const FaceSide> sides) {
    std::vector<uint32_t> open;  // the way so far, which passes no point twice
    for (const FaceSide& side : sides) {
      const uint32_t point = this->point(side.from);
      const auto before = std::find(open.begin(), open.end(), point);
      add_ring({before, open.end()}, roof_.corners, roof_.ends);
      open.erase(before, open.end());
      open.push_back(point);
    }
    add_ring(open, roof_.corners, roof_.ends);
  }

  void add_outline(const std::vector<RoofEdge>& edges) {
    std::vector<uint8_t> is_added(edges.size(), 0);
    for (uint32_t i = 0; i < edges.size(); ++i) {
      std::vector<uint32_t> ring;
      for (uint32_t edge = i; is_added[edge] == 0; edge = edges[edge].next) {
        is_added[edge] = 1;
        if (edges[edge].start_corner != edges[edge].end_corner) {
          ring.push_back(point(edges[edge].start_corner));
        }
      }
      add_ring(ring, roof_.outline, roof_.outline_ends);
    }
  }

  Roof take() { return std::move(roof_); }

 private:
  static constexpr uint32_t kNone = 0xFFFFFFFFu;

  uint32_t point(uint32_t node) {
    const uint32_t joined = joined_.find(node);
    uint32_t& point = point_of_[joined];
    if (point != kNone) return point;
    const SkeletonNode& own = nodes_[joined];
    const Vec3 place = joined < outline_corners_.size() ? Vec3(outline_corners_[joined], 0)
                                                        : frame_.from_unit(own.place, own.time);
    const auto [entry, is_new] = number_of_.try_emplace({place.x, place.y, place.z},
                                                        static_cast<uint32_t>(roof_.points.size()));
    if (is_new) roof_.points.push_back(place);
    return point = entry->second;
  }

  static void add_ring(std::span<const uint32_t> ring, std::vector<uint32_t>& corners,
                       std::vector<uint32_t>& ends) {
    if (ring.size() < 3) return;
    corners.insert(corners.end(), ring.begin(), ring.end());
    ends.push_back(static_cast<uint32_t>(corners.size()));
  }

  const UnitFrame& frame_;
  const std::span<const Vec2> outline_corners_;
  const std::vector<SkeletonNode>& nodes_;
  JoinedNodes joined_;
  std::vector<uint32_t> point_of_;  // by node
  std::map<std::tuple<double, double, double>, uint32_t> number_of_;
  Roof roof_;
};

}  // namespace

std::optional<Roof> roof_over(const SimplePolygons& outline, double bevel_step) {
  const UnitFrame frame(bounds_of(outline));
  std::map<std::pair<double, double>, Vec2> places;  // by those in the frame
  SimplePolygons polygons = outline;
  for (Polygon& polygon : polygons) {
    for (Vec2& point : polygon) {
      const Vec2 place = frame.to_unit(point);
      places.try_emplace({place.x, place.y}, point);
      point = place;
    }
  }
  // Where rounding makes events of one place and time contradict each other, they are parted.
  for (const double jitter : {0.0, 1e-11, 1e-10, 1e-9}) {
    const RoofEdges edges = roof_edges(polygons, bevel_step, jitter);
    if (edges.edges.empty()) return Roof{};
    Wavefront wave(edges);
    if (!wave.run()) continue;
    const std::optional<std::vector<FaceSide>> sides = face_sides(edges, wave);
    if (!sides) continue;
    std::vector<Vec2> corners;
    for (const Vec2& corner : edges.corners) corners.push_back(places.at({corner.x, corner.y}));
    RoofBuilder builder(frame, corners, wave);
    bool are_sound = true;
    for (size_t begin = 0, end = 0; begin < sides->size() && are_sound; begin = end) {
      const uint32_t face = (*sides)[begin].face;
      while (end < sides->size() && (*sides)[end].face == face) ++end;
      const std::span<const FaceSide> own(sides->data() + begin, end - begin);
      are_sound = is_sound(edges.edges[face], own, wave.nodes());
      if (are_sound) builder.add_face(own);
    }
    if (!are_sound) continue;
    builder.add_outline(edges.edges);
    Roof roof = builder.take();
    roof.bevel_count = static_cast<size_t>(std::ranges::count_if(
        edges.edges, [](const RoofEdge& edge) { return edge.start_corner == edge.end_corner; }));
    return roof;
  }
  return std::nullopt;
}

}  // namespace frontend
