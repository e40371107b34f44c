// Compiled once per instruction set by Highway. Multiplications and additions are never fused, so
// that every instruction set gives the same bits.
#include "screen/screen_slab.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "base/constants.hpp"
#include "base/simd.hpp"
#include "csgcore/polyhedron.hpp"

#define HWY_DISABLED_TARGETS CSGCORE_DISABLED_TARGETS
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "screen/screen_slab.cpp"
#include <hwy/foreach_target.h>  // includes this file again for every instruction set
#include <hwy/highway.h>

#include "rays/lanes-inl.hpp"

#ifndef CSGCORE_SCREEN_SLAB_COMMON
#define CSGCORE_SCREEN_SLAB_COMMON
namespace csgcore {
namespace {

/// The same as kScreenSlack (screen_extents.cpp), for computations with somewhat larger terms.
constexpr double kPlaneSlack = 0x1p-40;

/// The same as kNearestDepth (screen_extents.cpp): primitives nearer to the eye's plane may be
/// anywhere. It is also the least distance of the eye from a wall, in canonical space, at which the
/// wall has a slab.
constexpr double kNearest = 0x1p-20;

/// The rounding in float of a line, and of a point's distance from it, as a share of the
/// coordinates: some ten operations of 2^-24.
constexpr double kLineSlack = 0x1p-20;

/// A line that is further away is dropped. No picture is so large.
constexpr double kFurthestLine_px = 1e9;

/// The largest |x| + |y| of kCornerDirections.
constexpr double kLongestDirection = 3;

constexpr float kNoLimit = std::numeric_limits<float>::infinity();
constexpr ScreenSlab kNoSlab = {{0, 0}, {0, 0}, {kNoLimit, kNoLimit}};

/// The picture's plane, and the maps between u, v and pixels.
struct Picture {
  const View& view;
  bool is_perspective;
  double px_per_unit;  // of u and v
  double middle_px[2];
  double largest_u, largest_v;  // bounds of |u| and |v| in the picture

  explicit Picture(const View& of)
      : view(of),
        is_perspective(of.projection == Projection::kPerspective),
        px_per_unit(0.5 * of.height_px / of.half_height),
        middle_px{0.5 * of.width_px - 0.5, 0.5 * of.height_px - 0.5},
        largest_u(0.5 * of.width_px / px_per_unit),
        largest_v(of.half_height) {}

  /// Sets a line of a slab that does not have it yet; x·p.x + y·p.y > limit is beyond the line.
  void set_line(double x, double y, double limit, int line, ScreenSlab& slab) const {
    const double coordinates_px = middle_px[0] + middle_px[1] + 1 + std::abs(limit);
    if (!(coordinates_px < kFurthestLine_px)) return;  // also dropped if NaN
    slab.x[line] = static_cast<float>(x);
    slab.y[line] = static_cast<float>(y);
    slab.limit[line] = static_cast<float>(limit + kLineSlack * coordinates_px);
  }

  /// Sets the limits of d·p for the i-th of kCornerDirections, d.
  void set_corner(double low, double high, int i, ScreenKDop& corners) const {
    const double coordinates_px =
        kLongestDirection * (middle_px[0] + middle_px[1] + 1) + std::abs(low) + std::abs(high);
    const bool is_near = coordinates_px < kFurthestLine_px;
    const double margin = kLineSlack * coordinates_px;
    corners.low[i] = is_near ? static_cast<float>(low - margin) : -kNoLimit;
    corners.high[i] = is_near ? static_cast<float>(high + margin) : kNoLimit;
  }
};

bool is_large(const Extent& screen) {
  return std::min(screen.half[0], screen.half[1]) >= kCorneredHalf_px;
}

/// Narrows an extent to a rectangle; rounds it to pixels' centres first if options.centers_only.
void narrow(ScreenRectangle to, const Picture& picture, const ScreenOptions& options,
            Extent& screen) {
  if (options.centers_only) {
    to = {std::ceil(to.low_x), std::floor(to.high_x), std::ceil(to.low_y), std::floor(to.high_y)};
  }
  narrow(to, picture.view, screen);
}

}  // namespace
}  // namespace csgcore
#endif

HWY_BEFORE_NAMESPACE();
namespace csgcore {
namespace HWY_NAMESPACE {

constexpr size_t kMostLanes = 8;

/// The fields of some primitives, side by side. Polyhedra are represented by their enclosures.
struct Columns {
  alignas(64) double to_canonical[9][kMostLanes];  // by column and row
  alignas(64) double to_world[9][kMostLanes];
  alignas(64) double center[3][kMostLanes];
  alignas(64) double mid[kMostLanes], slope[kMostLanes];
  alignas(64) double height[kMostLanes];  // the z of a frustum's ends, 1; 0 for a ball
  alignas(64) double error[kMostLanes];
  alignas(64) double depth_reach[kMostLanes];

  HWY_INLINE Lanes3<Wide> centers() const {
    const Wide d;
    return {hn::Load(d, center[0]), hn::Load(d, center[1]), hn::Load(d, center[2])};
  }
  HWY_INLINE void set(size_t lane, const CanonicalPrimitive& primitive, const Extent& screen) {
    for (int i = 0; i < 9; ++i) {
      to_canonical[i][lane] = primitive.world_to_canonical[i / 3][i % 3];
      to_world[i][lane] = primitive.canonical_to_world[i / 3][i % 3];
    }
    for (int i = 0; i < 3; ++i) center[i][lane] = primitive.center[i];
    const bool is_frustum = primitive.enclosure == Shape::kFrustum;
    mid[lane] = is_frustum ? primitive.radius_mid : 1;
    slope[lane] = is_frustum ? primitive.radius_slope : 0;
    height[lane] = is_frustum ? 1 : 0;
    error[lane] = primitive.canonical_error;
    depth_reach[lane] = screen.half[2];
  }
};

using V3 = Lanes3<Wide>;

HWY_INLINE WideV load(const double (&column)[kMostLanes]) { return hn::Load(Wide(), column); }
HWY_INLINE V3 load_column(const double (&matrix)[9][kMostLanes], int column) {
  return {load(matrix[3 * column]), load(matrix[3 * column + 1]), load(matrix[3 * column + 2])};
}
/// m · v
HWY_INLINE V3 times(const double (&m)[9][kMostLanes], const V3& v) {
  return (scaled(load_column(m, 0), v.x) + scaled(load_column(m, 1), v.y)) +
         scaled(load_column(m, 2), v.z);
}
HWY_INLINE V3 times(const double (&m)[9][kMostLanes], const Vec3& v) {
  return times(m, broadcast(Wide(), v));
}
/// mᵀ · v
HWY_INLINE V3 transposed_times(const double (&m)[9][kMostLanes], const Vec3& v) {
  const Wide d;
  const V3 lanes = broadcast(d, v);
  return {dot(d, load_column(m, 0), lanes), dot(d, load_column(m, 1), lanes),
          dot(d, load_column(m, 2), lanes)};
}
HWY_INLINE WideV sum_of_sizes(const V3& v) {
  return hn::Add(hn::Add(hn::Abs(v.x), hn::Abs(v.y)), hn::Abs(v.z));
}

struct Limits {
  WideV low, high;
};

/// A disc or a ball in one direction of the screen. It has the components of its centre, and of the
/// three vectors that span it, along that direction (`across`) and along the view axis (`depth`).
struct Span {
  WideV center, center_depth;
  V3 across, depth;
};

/// Returns the u (or v) of the two planes through the eye that touch the span: the roots of (center
/// − u·center_depth)² = |across − u·depth|². Clears `is_known` for spans that the eye's plane
/// meets.
HWY_INLINE Limits perspective_limits(const Span& s, WideV slack, WideM& is_known) {
  const Wide d;
  const WideV zero = hn::Zero(d);
  const WideV depth2 = dot(d, s.depth, s.depth);
  const WideV a = hn::Sub(hn::Mul(s.center_depth, s.center_depth), depth2);
  is_known = hn::And(is_known, hn::And(hn::Gt(s.center_depth, zero),
                                       hn::Gt(a, hn::Mul(hn::Set(d, kNearest), depth2))));
  // This form of the discriminant is a difference of two squares of the primitive's own size.
  const V3 lean = scaled(s.across, s.center_depth) - scaled(s.depth, s.center);
  const auto cross = [](WideV a0, WideV b1, WideV a1, WideV b0) {
    return hn::Sub(hn::Mul(a0, b1), hn::Mul(a1, b0));
  };
  const V3 normal = {cross(s.across.y, s.depth.z, s.across.z, s.depth.y),
                     cross(s.across.z, s.depth.x, s.across.x, s.depth.z),
                     cross(s.across.x, s.depth.y, s.across.y, s.depth.x)};
  const WideV discriminant = hn::Sub(dot(d, lean, lean), dot(d, normal, normal));
  const WideV half = hn::Sqrt(hn::Max(zero, discriminant));
  const WideV middle = hn::Sub(hn::Mul(s.center, s.center_depth), dot(d, s.across, s.depth));
  const WideV inverse = hn::Div(hn::Set(d, 1.0), a);
  const WideV margin = hn::Mul(hn::Mul(slack, hn::Add(s.center_depth, hn::Abs(s.center))), inverse);
  return {hn::Sub(hn::Mul(hn::Sub(middle, half), inverse), margin),
          hn::Add(hn::Mul(hn::Add(middle, half), inverse), margin)};
}

HWY_INLINE Limits orthographic_limits(const Span& s, WideV slack) {
  const WideV reach = hn::Add(hn::Sqrt(dot(Wide(), s.across, s.across)), slack);
  return {hn::Sub(s.center, reach), hn::Add(s.center, reach)};
}

/// The limits of quadrics along directions of the screen: those of a frustum's two ends, or those
/// of a ball, computed twice.
class QuadricLimits {
 public:
  HWY_INLINE QuadricLimits(const Columns& columns, const Picture& picture)
      : columns_(columns), picture_(picture) {
    const Wide d;
    const View& view = picture.view;
    from_eye_ = columns.centers() - broadcast(d, view.eye);
    forward_ = transposed_times(columns.to_world, view.forward);
    depth_ = dot(d, from_eye_, broadcast(d, view.forward));
    WideV size =
        hn::Add(sum_of_sizes(from_eye_), hn::Set(d, glm::dot(glm::abs(view.eye), Vec3{1.0})));
    for (int column = 0; column < 3; ++column) {
      size = hn::Add(size, sum_of_sizes(load_column(columns.to_world, column)));
    }
    slack_ = hn::Mul(hn::Set(d, kPlaneSlack), size);
  }

  /// Returns the limits of by_u·u + by_v·v. Clears `are_known` for lanes whose limits are not
  /// known.
  HWY_INLINE Limits along(double by_u, double by_v, WideM& are_known) const {
    const Wide d;
    const Vec3 direction = by_u * picture_.view.right + by_v * picture_.view.up;
    const V3 across = transposed_times(columns_.to_world, direction);
    const WideV offset = dot(d, from_eye_, broadcast(d, direction));
    const WideV slack = hn::Mul(slack_, hn::Set(d, std::abs(by_u) + std::abs(by_v)));
    const WideV height = load(columns_.height);
    const WideV thickness = hn::Sub(hn::Set(d, 1.0), height);
    Limits limits[2];
    for (const int end : {0, 1}) {
      const WideV z = end == 0 ? height : hn::Neg(height);
      const WideV radius = hn::Add(load(columns_.mid), hn::Mul(load(columns_.slope), z));
      const auto spanning = [&](const V3& axes) {
        return V3{hn::Mul(axes.x, radius), hn::Mul(axes.y, radius), hn::Mul(axes.z, thickness)};
      };
      const Span span{hn::Add(offset, hn::Mul(z, across.z)),
                      hn::Add(depth_, hn::Mul(z, forward_.z)), spanning(across),
                      spanning(forward_)};
      limits[end] = picture_.is_perspective ? perspective_limits(span, slack, are_known)
                                            : orthographic_limits(span, slack);
    }
    return {hn::Min(limits[0].low, limits[1].low), hn::Max(limits[0].high, limits[1].high)};
  }

 private:
  const Columns& columns_;
  const Picture& picture_;
  V3 from_eye_, forward_;
  WideV depth_, slack_;
};

HWY_INLINE WideM all_lanes() { return hn::Eq(hn::Zero(Wide()), hn::Zero(Wide())); }

/// Two lines on the screen for each lane; at + u·by_u + v·by_v > slack is beyond a line.
struct QuadricLines {
  WideM are_known;
  WideV at[2], by_u[2], by_v[2], slack;
};

/// Finds the planes that touch the wall and contain the eye or, in orthographic views, are parallel
/// to the view axis. In canonical space they are x·cos φ + y·sin φ − slope·z = mid. For every φ, no
/// point of the frustum lies beyond such a plane; nor does a point of the ball, for which mid is 1
/// and slope 0.
HWY_INLINE QuadricLines find_lines(const Columns& columns, const Picture& picture) {
  QuadricLines lines;
  const Wide d;
  const View& view = picture.view;
  const bool is_perspective = picture.is_perspective;
  const WideV mid = load(columns.mid);
  const WideV slope = load(columns.slope);
  const V3 center = columns.centers();
  const V3 right = times(columns.to_canonical, view.right);
  const V3 up = times(columns.to_canonical, view.up);
  const V3 forward = times(columns.to_canonical, view.forward);
  V3 from_center = broadcast(d, view.eye) - center;
  if (!is_perspective) {
    // The point of the view axis next to the centre replaces the eye.
    const V3 axis = broadcast(d, view.forward);
    from_center = from_center - scaled(axis, dot(d, from_center, axis));
  }
  const V3 eye = times(columns.to_canonical, from_center);
  const V3& held = is_perspective ? eye : forward;
  const WideV tilt = hn::Mul(slope, held.z);
  const WideV level = is_perspective ? hn::Add(mid, tilt) : tilt;
  const WideV across2 = hn::Add(hn::Mul(held.x, held.x), hn::Mul(held.y, held.y));
  const WideV tangent2 = hn::Sub(across2, hn::Mul(level, level));
  const WideV distance = hn::Sub(hn::Sqrt(across2), level);  // of the eye from the wall, at least
  const auto is_far = hn::Gt(distance, hn::Mul(hn::Set(d, kNearest), sum_of_sizes(held)));
  lines.are_known = hn::And(hn::Gt(tangent2, hn::Zero(d)), is_far);
  // The rounding of the map into canonical space, and of the computation there: for a point next to
  // the eye or the centre, and for directions.
  const WideV error = hn::Mul(hn::Set(d, 4.0), load(columns.error));
  const auto rounded = [&](WideV canonical, WideV world) {
    return hn::Add(hn::Mul(hn::Set(d, kCanonicalSlack), canonical), hn::Mul(error, world));
  };
  const WideV one = hn::Set(d, 1.0);
  const WideV largest_u = hn::Set(d, picture.largest_u);
  const WideV largest_v = hn::Set(d, picture.largest_v);
  const WideV lateral =
      hn::Add(hn::Mul(sum_of_sizes(right), largest_u), hn::Mul(sum_of_sizes(up), largest_v));
  const WideV ahead = sum_of_sizes(forward);
  const WideV coordinates =
      hn::Add(sum_of_sizes(center), hn::Set(d, glm::dot(glm::abs(view.eye), Vec3{1.0})));
  const WideV of_point = rounded(hn::Add(sum_of_sizes(eye), one), coordinates);
  const WideV of_lateral = rounded(lateral, hn::Add(largest_u, largest_v));
  const WideV of_forward = rounded(ahead, one);
  // A plane that misses the eye by the rounding turns the ray that it should contain; an
  // orthographic one drifts away from the view axis along the ray.
  const WideV of_plane =
      is_perspective
          ? hn::Add(of_forward, hn::Div(hn::Mul(of_point, hn::Add(ahead, lateral)), distance))
          : hn::Add(of_point, hn::Mul(of_forward, load(columns.depth_reach)));
  lines.slack = hn::Add(of_plane, of_lateral);
  const WideV root = hn::Sqrt(hn::Max(tangent2, hn::Zero(d)));
  const WideV by_across2 = hn::Div(one, across2);
  for (const int line : {0, 1}) {
    const WideV turn = line == 0 ? root : hn::Neg(root);
    const V3 normal = {hn::Mul(hn::Sub(hn::Mul(level, held.x), hn::Mul(turn, held.y)), by_across2),
                       hn::Mul(hn::Add(hn::Mul(level, held.y), hn::Mul(turn, held.x)), by_across2),
                       hn::Neg(slope)};
    lines.at[line] = is_perspective ? dot(d, normal, forward) : hn::Sub(dot(d, normal, eye), mid);
    lines.by_u[line] = dot(d, normal, right);
    lines.by_v[line] = dot(d, normal, up);
  }
  return lines;
}

/// The results for the primitives of one vector. Lanes beyond the number of `indices` are ignored.
struct Found {
  std::span<const uint32_t> indices;
  Extent* screen;
  ScreenSlab* slabs;
  ScreenKDop* corners;
};

HWY_INLINE void narrow_to(const QuadricLimits& limits, const Picture& picture,
                          const ScreenOptions& options, const Found& found) {
  const Wide d;
  alignas(64) double low_x[kMostLanes], high_x[kMostLanes], low_y[kMostLanes], high_y[kMostLanes];
  const auto store = [&](WideV value, double scale, double middle, double(&column)[kMostLanes]) {
    const WideV scaled = hn::Mul(value, hn::Set(d, scale * picture.px_per_unit));
    hn::Store(hn::Add(scaled, hn::Set(d, middle)), d, column);
  };
  WideM are_known = all_lanes();
  const Limits u = limits.along(1, 0, are_known);
  const Limits v = limits.along(0, 1, are_known);
  store(u.low, 1, picture.middle_px[0], low_x);
  store(u.high, 1, picture.middle_px[0], high_x);
  store(v.high, -1, picture.middle_px[1], low_y);
  store(v.low, -1, picture.middle_px[1], high_y);
  const LaneMask known = bits_of(are_known, 0);
  for (size_t lane = 0; lane < found.indices.size(); ++lane) {
    if ((known >> lane & 1) == 0) continue;
    narrow({low_x[lane], high_x[lane], low_y[lane], high_y[lane]}, picture, options,
           found.screen[found.indices[lane]]);
  }
}

HWY_INLINE void set_lines(const QuadricLines& lines, const Picture& picture, const Found& found) {
  const Wide d;
  const LaneMask known = bits_of(lines.are_known, 0);
  alignas(64) double x[2][kMostLanes], y[2][kMostLanes], limit[2][kMostLanes];
  const WideV px_per_unit = hn::Set(d, picture.px_per_unit);
  for (const int line : {0, 1}) {
    const WideV by_u = lines.by_u[line];
    const WideV by_v = hn::Neg(lines.by_v[line]);
    const WideV length2 = hn::Add(hn::Mul(by_u, by_u), hn::Mul(by_v, by_v));
    const WideV by_length = hn::Div(hn::Set(d, 1.0), hn::Sqrt(length2));
    const WideV along_x = hn::Mul(by_u, by_length);
    const WideV along_y = hn::Mul(by_v, by_length);
    const WideV of_middle = hn::Add(hn::Mul(along_x, hn::Set(d, picture.middle_px[0])),
                                    hn::Mul(along_y, hn::Set(d, picture.middle_px[1])));
    const WideV from_middle =
        hn::Mul(hn::Mul(hn::Sub(lines.slack, lines.at[line]), by_length), px_per_unit);
    hn::Store(along_x, d, x[line]);
    hn::Store(along_y, d, y[line]);
    hn::Store(hn::Add(of_middle, from_middle), d, limit[line]);
  }
  for (size_t lane = 0; lane < found.indices.size(); ++lane) {
    ScreenSlab& slab = found.slabs[found.indices[lane]];
    slab = kNoSlab;
    if ((known >> lane & 1) == 0) continue;
    for (const int line : {0, 1}) {
      picture.set_line(x[line][lane], y[line][lane], limit[line][lane], line, slab);
    }
  }
}

/// Sets the k-DOPs of large primitives.
HWY_INLINE void set_corners(const QuadricLimits& limits, const Picture& picture,
                            const Found& found) {
  const Wide d;
  LaneMask large = 0;
  for (size_t lane = 0; lane < found.indices.size(); ++lane) {
    Extent& screen = found.screen[found.indices[lane]];
    if (!is_large(screen)) continue;
    screen.inside2 = kCornered;
    large |= LaneMask{1} << lane;
  }
  if (large == 0) return;
  for (int i = 0; i < ScreenKDop::kCount; ++i) {
    const auto [x, y] = kCornerDirections[i];
    WideM are_known = all_lanes();
    const Limits exact = limits.along(x, -y, are_known);
    const WideV scale = hn::Set(d, picture.px_per_unit);
    const WideV middle = hn::Set(d, x * picture.middle_px[0] + y * picture.middle_px[1]);
    alignas(64) double low[kMostLanes], high[kMostLanes];
    hn::Store(hn::IfThenElse(are_known, hn::Add(hn::Mul(exact.low, scale), middle),
                             hn::Set(d, -kInfinity)),
              d, low);
    hn::Store(hn::IfThenElse(are_known, hn::Add(hn::Mul(exact.high, scale), middle),
                             hn::Set(d, kInfinity)),
              d, high);
    for (LaneMask left = large; left != 0; left &= left - 1) {
      const int lane = std::countr_zero(left);
      picture.set_corner(low[lane], high[lane], i, found.corners[found.indices[lane]]);
    }
  }
}

void find_quadrics_slabs(const CanonicalPrimitive* primitives, std::span<const uint32_t> indices,
                         const Picture& picture, const ScreenOptions& options, Extent* screen,
                         ScreenSlab* slabs, ScreenKDop* corners) {
  Columns columns;
  for (; !indices.empty(); indices = indices.subspan(std::min(indices.size(), kLanes))) {
    const std::span<const uint32_t> some = indices.first(std::min(indices.size(), kLanes));
    for (size_t lane = 0; lane < kLanes; ++lane) {
      const uint32_t index = some[std::min(lane, some.size() - 1)];
      columns.set(lane, primitives[index], screen[index]);
    }
    const QuadricLimits limits(columns, picture);
    const Found found{some, screen, slabs, corners};
    narrow_to(limits, picture, options, found);
    set_lines(find_lines(columns, picture), picture, found);
    set_corners(limits, picture, found);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace csgcore
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace csgcore {

CSGCORE_SIMD_EXPORT(find_quadrics_slabs);

namespace {

/// Polyhedra with at most so many vertices fill their enclosures badly; others fill them well.
constexpr size_t kFewVertices = 64;

/// The number of quadrics in one call of the vectorised function.
constexpr size_t kQuadricsAtOnce = 64;

/// Sets lines parallel to the polyhedron's longest extent on the screen, approximately: from the
/// vertex that is furthest from the first one to the vertex that is furthest from that.
void set_lines_along(std::span<const glm::dvec2> points_px, double margin_px,
                     const Picture& picture, ScreenSlab& slab) {
  const auto furthest_from = [&](const glm::dvec2& from) {
    return *std::ranges::max_element(points_px, {}, [&](const glm::dvec2& point) {
      const glm::dvec2 apart = point - from;
      return glm::dot(apart, apart);
    });
  };
  const glm::dvec2 start = furthest_from(points_px.front());
  const glm::dvec2 along = furthest_from(start) - start;
  const glm::dvec2 across = glm::dvec2{-along.y, along.x} / glm::length(along);
  for (const int line : {0, 1}) {
    const glm::dvec2 normal = line == 0 ? across : -across;
    double limit = -std::numeric_limits<double>::infinity();
    for (const glm::dvec2& point : points_px) limit = std::max(limit, glm::dot(normal, point));
    picture.set_line(normal.x, normal.y, limit + 2 * margin_px, line, slab);
  }
}

/// Finds the bounds of a polyhedron by its vertices.
void find_vertices_slab(const CanonicalPrimitive& primitive, const Picture& picture,
                        const ScreenOptions& options, Extent& screen, ScreenSlab& slab,
                        ScreenKDop& corners) {
  const View& view = picture.view;
  const Mat3& map = primitive.canonical_to_world;
  const Polyhedron::Canonical& canonical = primitive.polyhedron->canonical();
  const Vec3 ones{1.0};
  const Vec3 from_eye = primitive.center - view.eye;
  const double slack =
      kPlaneSlack * glm::dot(glm::abs(from_eye) + glm::abs(view.eye) + glm::abs(map[0]) +
                                 glm::abs(map[1]) + glm::abs(map[2]),
                             ones);
  slab = kNoSlab;
  glm::dvec2 points[kFewVertices] = {};
  size_t count = 0;
  double margin = 0;  // of u and v
  for (const Vec3& vertex : primitive.polyhedron->vertices()) {
    const Vec3 at = from_eye + map * ((vertex - canonical.center) / canonical.scale);
    const glm::dvec2 lateral{glm::dot(at, view.right), glm::dot(at, view.up)};
    const double depth = picture.is_perspective ? glm::dot(at, view.forward) : 1;
    if (!(depth > 0)) return;
    const double by_depth = 1 / depth;
    const double shift = picture.is_perspective ? std::abs(lateral.x) + std::abs(lateral.y) : 0;
    margin = std::max(margin, slack * (1 + shift * by_depth) * by_depth);
    const glm::dvec2 uv = by_depth * lateral;
    points[count++] = {picture.middle_px[0] + uv.x * picture.px_per_unit,
                       picture.middle_px[1] - uv.y * picture.px_per_unit};
  }
  const std::span<const glm::dvec2> points_px{points, count};
  const double margin_px = margin * picture.px_per_unit;
  glm::dvec2 low = points_px.front(), high = low;
  for (const glm::dvec2& point : points_px) {
    low = glm::min(low, point);
    high = glm::max(high, point);
  }
  set_lines_along(points_px, margin_px, picture, slab);
  narrow({low.x - margin_px, high.x + margin_px, low.y - margin_px, high.y + margin_px}, picture,
         options, screen);
  if (!is_large(screen)) return;
  screen.inside2 = kCornered;
  for (int i = 0; i < ScreenKDop::kCount; ++i) {
    const double x = kCornerDirections[i][0];
    const double y = kCornerDirections[i][1];
    const auto along = [x, y](const glm::dvec2& point) { return x * point.x + y * point.y; };
    const auto [least, most] = std::ranges::minmax(points_px, {}, along);
    const double margin_along = kLongestDirection * margin_px;
    picture.set_corner(along(least) - margin_along, along(most) + margin_along, i, corners);
  }
}

}  // namespace

void find_slabs(const CanonicalPrimitive* primitives, std::span<const uint32_t> indices,
                const FrameRays& frame, const ScreenOptions& options, Extent* screen,
                ScreenSlab* slabs, ScreenKDop* corners) {
  const Picture picture(frame.view);
  uint32_t quadrics[kQuadricsAtOnce];
  size_t count = 0;
  const auto flush = [&] {
    CSGCORE_SIMD(find_quadrics_slabs)
    (primitives, {quadrics, count}, picture, options, screen, slabs, corners);
    count = 0;
  };
  for (const uint32_t i : indices) {
    const Polyhedron* const polyhedron = primitives[i].polyhedron.get();
    if (polyhedron && polyhedron->vertices().size() <= kFewVertices) {
      find_vertices_slab(primitives[i], picture, options, screen[i], slabs[i], corners[i]);
      continue;
    }
    quadrics[count++] = i;
    if (count == kQuadricsAtOnce) flush();
  }
  flush();
}

}  // namespace csgcore
#endif  // HWY_ONCE
