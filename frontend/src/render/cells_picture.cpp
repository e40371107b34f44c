#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

#include "csgcore/phong.hpp"
#include "render/scene_subdivision.hpp"
#include "render/solid_renderer.hpp"

namespace frontend {
namespace {

using csgcore::Box;
using csgcore::Image;
using csgcore::KdNode;
using csgcore::Leaf;
using csgcore::LeafKind;
using csgcore::Ray;
using csgcore::Subdivision;
using csgcore::Vec3;
using csgcore::View;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Half the width of the line between two cells; glrender's EDGE_WIDTH_PX.
constexpr double kEdgeWidth_px = 0.75;

/// Parameters of a ray; none if first > last.
struct Range {
  double first;
  double last;
};

/// The part of the range in which min ≤ o + t·d ≤ max.
Range clip(Range range, double origin, double direction, double min, double max) {
  if (direction == 0) {
    return min <= origin && origin <= max ? range : Range{kInfinity, -kInfinity};
  }
  const double a = (min - origin) / direction;
  const double b = (max - origin) / direction;
  return {std::max(range.first, std::min(a, b)), std::min(range.last, std::max(a, b))};
}

Range clip(Range range, const Ray& ray, const Box& box) {
  for (int axis = 0; axis < 3; ++axis) {
    range = clip(range, ray.origin[axis], ray.direction[axis], box.min[axis], box.max[axis]);
  }
  return range;
}

bool has_surface(const Leaf& leaf) {
  return leaf.kind == LeafKind::kUnion || leaf.kind == LeafKind::kPair ||
         leaf.kind == LeafKind::kGeneral || leaf.kind == LeafKind::kFull ||
         leaf.kind == LeafKind::kGivenUp;
}

struct CellHit {
  const Leaf* leaf;
  double s;
};

/// Walks the kd-tree front to back.
class CellFinder {
 public:
  CellFinder(const Subdivision& subdivision, const View& view)
      : subdivision_(subdivision),
        seen_(view.projection == csgcore::Projection::kPerspective ? Range{0, kInfinity}
                                                                   : Range{-kInfinity, kInfinity}) {
  }

  std::optional<CellHit> find(const Ray& ray) {
    if (subdivision_.nodes().empty()) return std::nullopt;  // of a model that is nowhere
    visits_.assign(1, {0, clip(seen_, ray, subdivision_.root_box())});
    while (!visits_.empty()) {
      const Visit visit = visits_.back();
      visits_.pop_back();
      if (!(visit.range.first <= visit.range.last)) continue;
      const KdNode& node = subdivision_.nodes()[visit.node];
      if (node.axis != KdNode::kLeafAxis) {
        push_children(node, visit.range, ray);
      } else if (const auto hit = meet(subdivision_.leaves()[node.below], ray)) {
        return hit;
      }
    }
    return std::nullopt;
  }

 private:
  struct Visit {
    uint32_t node;
    Range range;
  };

  /// The nearer child is pushed last.
  void push_children(const KdNode& node, const Range& range, const Ray& ray) {
    const int axis = static_cast<int>(node.axis);
    const double origin = ray.origin[axis];
    const double direction = ray.direction[axis];
    const Visit below{node.below, clip(range, origin, direction, -kInfinity, node.split)};
    const Visit above{node.above, clip(range, origin, direction, node.split, kInfinity)};
    visits_.push_back(direction > 0 ? above : below);
    visits_.push_back(direction > 0 ? below : above);
  }

  std::optional<CellHit> meet(const Leaf& leaf, const Ray& ray) const {
    if (!has_surface(leaf)) return std::nullopt;
    const Range range = clip({-kInfinity, kInfinity}, ray, leaf.box);
    const double s = range.first >= seen_.first ? range.first : range.last;
    if (!(range.first <= range.last && s >= seen_.first)) return std::nullopt;
    return CellHit{&leaf, s};
  }

  const Subdivision& subdivision_;
  Range seen_;
  std::vector<Visit> visits_;
};

/// Where a point of a box's surface lies: the face, and whether it is on an edge.
struct BoxPoint {
  Vec3 normal;
  bool on_edge;
};

BoxPoint locate(const Box& box, const Vec3& point, const Vec3& direction, double pixel_size) {
  Vec3 gap;
  for (int axis = 0; axis < 3; ++axis) {
    gap[axis] =
        std::min(std::abs(point[axis] - box.min[axis]), std::abs(box.max[axis] - point[axis]));
  }
  std::array<int, 3> order{0, 1, 2};
  std::sort(order.begin(), order.end(), [&](int a, int b) { return gap[a] < gap[b]; });
  Vec3 normal(0.0);
  normal[order[0]] = direction[order[0]] > 0 ? -1 : 1;
  return {normal, gap[order[1]] < kEdgeWidth_px * pixel_size};
}

class CellsPicture {
 public:
  CellsPicture(const Subdivision& subdivision, const View& view,
               const csgcore::FrameSettings& frame, const glm::vec3& edge)
      : view_(view),
        frame_(frame),
        edge_(edge),
        finder_(subdivision, view),
        light_(csgcore::phong_light(
            view, frame.scene_box.empty() ? subdivision.solid().bounds() : frame.scene_box)) {}

  Image draw() {
    const size_t pixels = size_t{view_.width_px} * view_.height_px;
    image_.width_px = view_.width_px;
    image_.height_px = view_.height_px;
    fill_background(frame_, image_);
    if (frame_.measured_channels) {
      image_.z.assign(pixels, std::numeric_limits<float>::infinity());
      image_.normal.assign(pixels, glm::vec3(0.0f));
      image_.position.assign(pixels, glm::vec3(0.0f));
      image_.id.assign(pixels, csgcore::kNoPrimitive);
    }
    for (uint32_t y = 0; y < view_.height_px; ++y) {
      for (uint32_t x = 0; x < view_.width_px; ++x) draw_pixel(x, y);
    }
    return std::move(image_);
  }

 private:
  static std::array<uint8_t, 3> bytes(const Vec3& color) {
    std::array<uint8_t, 3> result;
    for (int i = 0; i < 3; ++i) {
      result[static_cast<size_t>(i)] =
          static_cast<uint8_t>(std::lround(255 * std::clamp(color[i], 0.0, 1.0)));
    }
    return result;
  }

  void draw_pixel(uint32_t x, uint32_t y) {
    const Ray ray = csgcore::pixel_ray(view_, x, y);
    const std::optional<CellHit> hit = finder_.find(ray);
    if (!hit) return;
    const Vec3 position = ray.origin + hit->s * ray.direction;
    const bool perspective = view_.projection == csgcore::Projection::kPerspective;
    const double pixel_size = 2 * view_.half_height / view_.height_px * (perspective ? hit->s : 1);
    const BoxPoint point = locate(hit->leaf->box, position, ray.direction, pixel_size);
    const size_t pixel = size_t{y} * view_.width_px + x;
    image_.rgb[pixel] =
        bytes(point.on_edge ? Vec3(edge_) : shade(position, point.normal, ray.direction));
    if (!frame_.measured_channels) return;
    image_.z[pixel] = static_cast<float>(hit->s);
    image_.normal[pixel] = point.normal;
    image_.position[pixel] = position;
  }

  Vec3 shade(const Vec3& position, const Vec3& normal, const Vec3& direction) const {
    const Vec3 color(frame_.front);
    if (frame_.shading == csgcore::Shading::kPhong) {
      return csgcore::phong_color(color, position, normal, direction, light_);
    }
    // OpenSCAD's light (frontend/OPENSCAD.md, "Light and colours").
    const Vec3 in_eye_space(glm::dot(normal, view_.right), glm::dot(normal, view_.up),
                            -glm::dot(normal, view_.forward));
    return color * (0.2 + std::abs(glm::dot(in_eye_space, Vec3(-1, 1, 1))) / std::sqrt(3.0));
  }

  const View& view_;
  const csgcore::FrameSettings& frame_;
  glm::vec3 edge_;
  CellFinder finder_;
  csgcore::PhongLight light_;
  Image image_;
};

}  // namespace

Image cells_picture(const Subdivision& subdivision, const View& view,
                    const csgcore::FrameSettings& frame, const glm::vec3& edge) {
  return CellsPicture(subdivision, view, frame, edge).draw();
}

}  // namespace frontend
