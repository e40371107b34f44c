// Compiled once per instruction set by Highway.
#include "screen_shape.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "csgcore/polyhedron.hpp"
#include "simd.hpp"

#define HWY_DISABLED_TARGETS \
  (HWY_SSSE3 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "screen_shape.cpp"
#include <hwy/foreach_target.h>  // includes this file again for every instruction set
#include <hwy/highway.h>

#include "lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace csgcore {
namespace HWY_NAMESPACE {

using Quad = hn::CappedTag<double, 4>;
constexpr size_t kPlanes = 4;

/// The planes through the eye and a tile's edges, in the order of ScreenShape's lanes.
struct TilePlanes {
  double line[kPlanes];  // of u, u, v and v
  double tilt[kPlanes];  // how far the normals lean against the view axis: line or, if parallel, 0
};

HWY_INLINE TilePlanes planes_of(const FrameRays& frame, const Box& tile) {
  const View& view = frame.view;
  const double unit_per_px = 2 * view.half_height / view.height_px;
  const double middle_x = 0.5 * view.width_px - 0.5;
  const double middle_y = 0.5 * view.height_px - 0.5;
  TilePlanes planes{{(tile.min.x - middle_x) * unit_per_px, (tile.max.x - middle_x) * unit_per_px,
                     (middle_y - tile.max.y) * unit_per_px, (middle_y - tile.min.y) * unit_per_px},
                    {}};
  if (view.projection == Projection::kPerspective) {
    std::copy_n(planes.line, kPlanes, planes.tilt);
  }
  return planes;
}

/// All planes at once.
HWY_INLINE bool misses(const ScreenShape& shape, const TilePlanes& planes, bool is_perspective) {
  const Quad d;
  static constexpr double kSign[kPlanes] = {1, -1, 1, -1};
  for (size_t first = 0; first < kPlanes; first += hn::Lanes(d)) {
    const auto sign = hn::LoadU(d, kSign + first);
    const auto line = hn::LoadU(d, planes.line + first);
    const auto tilt = hn::LoadU(d, planes.tilt + first);
    const auto along = is_perspective ? hn::Mul(line, hn::Set(d, shape.offset_forward)) : line;
    const auto distance = hn::Mul(sign, hn::Sub(hn::LoadU(d, shape.offset + first), along));
    const auto component = [&](int i) {
      return hn::Mul(sign, hn::Sub(hn::LoadU(d, shape.across[i] + first),
                                   hn::Mul(tilt, hn::Set(d, shape.forward[i]))));
    };
    const auto x = component(0);
    const auto y = component(1);
    const auto z = component(2);
    const auto lateral2 = hn::Add(hn::Mul(x, x), hn::Mul(y, y));
    auto support = hn::Zero(d);
    if (shape.radius_top >= 0) {
      const auto lateral = hn::Sqrt(lateral2);
      support = hn::Max(hn::Add(z, hn::Mul(lateral, hn::Set(d, shape.radius_top))),
                        hn::Sub(hn::Mul(lateral, hn::Set(d, shape.radius_bottom)), z));
    } else {
      support = hn::Sqrt(hn::Add(lateral2, hn::Mul(z, z)));
    }
    const auto slack = hn::Mul(hn::Set(d, shape.slack), hn::Add(hn::Set(d, 1.0), hn::Abs(line)));
    const auto reach = hn::Add(hn::Add(distance, support), slack);
    if (!hn::AllFalse(d, hn::Lt(reach, hn::Zero(d)))) return true;
  }
  return false;
}

HWY_INLINE bool is_open(const Extent& extent, const Box& tile) {
  bool is_small = true;
  bool is_centered = true;
  for (const int axis : {0, 1}) {
    const double center = extent.center[axis];
    is_small &= tile.max[axis] - tile.min[axis] > 2 * extent.half[axis];
    is_centered &= center >= tile.min[axis] && center <= tile.max[axis];
  }
  return is_small | is_centered;
}

uint64_t find_misses(const ScreenShape* shapes, const Extent* screen, const uint32_t* primitives,
                     uint64_t open, const FrameRays& frame, const Box& tile) {
  // Of a tile of one packet, the rays themselves tell as soon.
  if (tile.max.x - tile.min.x < kPacketWidth_px && tile.max.y - tile.min.y < kPacketHeight_px) {
    return 0;
  }
  const bool is_perspective = frame.view.projection == Projection::kPerspective;
  const TilePlanes planes = planes_of(frame, tile);
  // Shapes lie anywhere in memory: what is asked for is fetched before the first is waited for.
  uint64_t asked = 0;
  for (; open != 0; open &= open - 1) {
    const uint32_t primitive = primitives[std::countr_zero(open)] & kPrimitiveBits;
    if (is_open(screen[primitive], tile)) continue;
    asked |= open & -open;
    __builtin_prefetch(&shapes[primitive]);
    __builtin_prefetch(shapes[primitive].forward);
  }
  uint64_t result = 0;
  for (; asked != 0; asked &= asked - 1) {
    const uint32_t primitive = primitives[std::countr_zero(asked)] & kPrimitiveBits;
    if (misses(shapes[primitive], planes, is_perspective)) result |= asked & -asked;
  }
  return result;
}

}  // namespace HWY_NAMESPACE
}  // namespace csgcore
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace csgcore {

CSGCORE_SIMD_EXPORT(find_misses);

ScreenShape screen_shape(const CanonicalPrimitive& primitive, const FrameRays& frame) {
  // As kScreenSlack, of somewhat larger terms.
  constexpr double kPlaneSlack = 0x1p-40;
  const View& view = frame.view;
  const Vec3 offset = primitive.center - view.eye;
  const Mat3& map = primitive.canonical_to_world;
  const Vec3 right = view.right * map;
  const Vec3 up = view.up * map;
  const Vec3 forward = view.forward * map;
  const double offset_right = glm::dot(offset, view.right);
  const double offset_up = glm::dot(offset, view.up);
  ScreenShape shape{};
  for (int i = 0; i < 3; ++i) {
    shape.across[i][0] = shape.across[i][1] = right[i];
    shape.across[i][2] = shape.across[i][3] = up[i];
    shape.forward[i] = forward[i];
  }
  shape.offset[0] = shape.offset[1] = offset_right;
  shape.offset[2] = shape.offset[3] = offset_up;
  shape.offset_forward = glm::dot(offset, view.forward);
  const bool is_sphere = primitive.enclosure == Shape::kSphere;
  shape.radius_top = is_sphere ? -1 : primitive.radius_mid + primitive.radius_slope;
  shape.radius_bottom = is_sphere ? -1 : primitive.radius_mid - primitive.radius_slope;
  shape.slack = kPlaneSlack * glm::dot(glm::abs(offset) + glm::abs(view.eye) + glm::abs(map[0]) +
                                           glm::abs(map[1]) + glm::abs(map[2]),
                                       Vec3{1.0});
  return shape;
}

uint64_t find_misses(const ScreenShape* shapes, const Extent* screen, const uint32_t* primitives,
                     uint64_t open, const FrameRays& frame, const Box& tile) {
  return CSGCORE_SIMD(find_misses)(shapes, screen, primitives, open, frame, tile);
}

namespace {

/// Polyhedra of so few vertices fill what encloses them badly, others well.
constexpr size_t kFewVertices = 64;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A disc, or a ball, as the screen sees it: its centre and the two (three) vectors that span it,
/// along right or up (`across`) and along the view axis.
struct Span {
  double center, center_depth;
  double across[3], depth[3];
};

/// Spans 0 and 1 are a frustum's ends; a sphere's are the same.
Span span_of(const ScreenShape& shape, int axis, int end) {
  const int lane = 2 * axis;
  Span span;
  const bool is_sphere = shape.radius_top < 0;
  const double radius = is_sphere ? 1 : end == 0 ? shape.radius_top : shape.radius_bottom;
  const double height = is_sphere ? 0 : end == 0 ? 1 : -1;
  span.center = shape.offset[lane] + height * shape.across[2][lane];
  span.center_depth = shape.offset_forward + height * shape.forward[2];
  for (int i = 0; i < 3; ++i) {
    const double used = i < 2 ? radius : is_sphere ? 1 : 0;
    span.across[i] = used * shape.across[i][lane];
    span.depth[i] = used * shape.forward[i];
  }
  return span;
}

/// A point of canonical space is a disc of no size.
Span point_span(const ScreenShape& shape, int axis, const Vec3& point) {
  const int lane = 2 * axis;
  Span span{shape.offset[lane], shape.offset_forward, {}, {}};
  for (int i = 0; i < 3; ++i) {
    span.center += point[i] * shape.across[i][lane];
    span.center_depth += point[i] * shape.forward[i];
  }
  return span;
}

double dot3(const double (&a)[3], const double (&b)[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

struct Limits {
  double low, high;
};

/// The u (or v) of the planes through the eye that touch the span: the roots of
/// (center − u·center_depth)² = |across − u·depth|². Not of a span that the eye's plane meets.
bool perspective_limits(const Span& s, double slack, Limits& limits) {
  const double depth2 = dot3(s.depth, s.depth);
  const double a = s.center_depth * s.center_depth - depth2;
  // As kNearestDepth of the extents: so far out that no picture shows it.
  constexpr double kNearest = 0x1p-20;
  if (!(s.center_depth > 0 && a > kNearest * depth2)) return false;
  // The discriminant is the difference of two squares of the primitive's own size.
  double lean[3];
  for (int i = 0; i < 3; ++i) lean[i] = s.center_depth * s.across[i] - s.center * s.depth[i];
  const double normal[3] = {s.across[1] * s.depth[2] - s.across[2] * s.depth[1],
                            s.across[2] * s.depth[0] - s.across[0] * s.depth[2],
                            s.across[0] * s.depth[1] - s.across[1] * s.depth[0]};
  const double half = std::sqrt(std::max(0.0, dot3(lean, lean) - dot3(normal, normal)));
  const double middle = s.center * s.center_depth - dot3(s.across, s.depth);
  const double inverse = 1 / a;
  const double margin = slack * (s.center_depth + std::abs(s.center)) * inverse;
  limits = {(middle - half) * inverse - margin, (middle + half) * inverse + margin};
  return true;
}

}  // namespace

void narrow_extent(const CanonicalPrimitive& primitive, const ScreenShape& shape,
                   const FrameRays& frame, const ScreenOptions& options, Extent& screen) {
  const View& view = frame.view;
  const bool is_perspective = view.projection == Projection::kPerspective;
  Limits limits[2] = {{kInfinity, -kInfinity}, {kInfinity, -kInfinity}};
  const auto widen = [&](int axis, const Span& span) {
    Limits own;
    if (!is_perspective) {
      const double reach = std::sqrt(dot3(span.across, span.across)) + shape.slack;
      own = {span.center - reach, span.center + reach};
    } else if (!perspective_limits(span, shape.slack, own)) {
      return false;
    }
    limits[axis].low = std::min(limits[axis].low, own.low);
    limits[axis].high = std::max(limits[axis].high, own.high);
    return true;
  };
  const Polyhedron* polyhedron = primitive.polyhedron.get();
  const bool has_few_vertices = polyhedron && polyhedron->vertices().size() <= kFewVertices;
  for (const int axis : {0, 1}) {
    if (has_few_vertices) {
      for (const Vec3& vertex : polyhedron->vertices()) {
        const Polyhedron::Canonical& canonical = polyhedron->canonical();
        const Vec3 point = (vertex - canonical.center) / canonical.scale;
        if (!widen(axis, point_span(shape, axis, point))) return;
      }
    } else {
      for (const int end : {0, 1}) {
        if (!widen(axis, span_of(shape, axis, end))) return;
      }
    }
  }
  const double px_per_unit = 0.5 * view.height_px / view.half_height;
  const double middle_x = 0.5 * view.width_px - 0.5;
  const double middle_y = 0.5 * view.height_px - 0.5;
  Rectangle pixels{middle_x + limits[0].low * px_per_unit, middle_x + limits[0].high * px_per_unit,
                   middle_y - limits[1].high * px_per_unit, middle_y - limits[1].low * px_per_unit};
  if (options.centers_only) {
    pixels = {std::ceil(pixels.low_x), std::floor(pixels.high_x), std::ceil(pixels.low_y),
              std::floor(pixels.high_y)};
  }
  // Never wider than the box was.
  pixels.low_x = std::max(pixels.low_x, screen.center[0] - screen.half[0]);
  pixels.high_x = std::min(pixels.high_x, screen.center[0] + screen.half[0]);
  pixels.low_y = std::max(pixels.low_y, screen.center[1] - screen.half[1]);
  pixels.high_y = std::min(pixels.high_y, screen.center[1] + screen.half[1]);
  set_rectangle(pixels, view, screen);
}

}  // namespace csgcore
#endif  // HWY_ONCE
