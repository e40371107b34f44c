// Compiled once per instruction set by Highway.
#include "screen/screen_extents.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "base/simd.hpp"

#define HWY_DISABLED_TARGETS CSGCORE_DISABLED_TARGETS
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "screen/screen_extents.cpp"
#include <hwy/foreach_target.h>  // includes this file again for every instruction set
#include <hwy/highway.h>

#include "rays/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace csgcore {
namespace HWY_NAMESPACE {

/// A primitive is enlarged by this share of its distance and size, and of the view's own
/// coordinates. It is far above the rounding here (some 20 operations of 2^-53), and far below a
/// pixel.
constexpr double kScreenSlack = 0x1p-44;

/// The view's own coordinates, and those of a group, are rounded only once or twice. This share of
/// kScreenSlack is enough for them.
constexpr double kRoundedOnce = 0x1p-4;

/// A primitive that is nearer to the eye's plane than this share of its own reach in depth is taken
/// to be anywhere on the screen, since quotients by its nearest depth have no bound.
constexpr double kNearestDepth = 0x1p-20;

using WideV = hn::Vec<Wide>;

/// The fields of several extents.
struct ExtentLanes {
  Lanes3<Wide> center, half;
  WideV outside2, inside2;
};

HWY_INLINE ExtentLanes load_extents(const Extent* extents, const uint32_t* indices) {
  const Wide d;
  const hn::Rebind<int64_t, Wide> integers;
  const auto wide =
      hn::PromoteTo(hn::Rebind<uint64_t, Wide>(), hn::LoadU(hn::Rebind<uint32_t, Wide>(), indices));
  const auto offsets = hn::ShiftLeft<3>(hn::BitCast(integers, wide));
  const double* base = reinterpret_cast<const double*>(extents);
  const auto field = [&](int i) { return hn::GatherIndex(d, base + i, offsets); };
  return {{field(0), field(1), field(2)}, {field(3), field(4), field(5)}, field(6), field(7)};
}

struct Range {
  WideV low, high;
};

/// Returns the reach of the extent's box along a direction.
HWY_INLINE WideV reach_along(const ExtentLanes& extent, const Vec3& axis) {
  const Wide d;
  return dot(d, extent.half, broadcast(d, glm::abs(axis)));
}

/// Returns the range of across/depth over a box with depth > 0, from 1/depth at its ends.
HWY_INLINE Range box_range(WideV across, WideV reach, WideV by_nearest, WideV by_furthest) {
  const WideV low = hn::Sub(across, reach);
  const WideV high = hn::Add(across, reach);
  return {hn::Min(hn::Mul(low, by_nearest), hn::Mul(low, by_furthest)),
          hn::Max(hn::Mul(high, by_nearest), hn::Mul(high, by_furthest))};
}

/// Returns this range for a ball, from the two planes through the eye that touch it: (across −
/// u·depth)² = radius²·(1 + u²), with a = depth² − radius² and by_a = 1/a.
HWY_INLINE Range ball_range(WideV across, WideV depth, WideV radius2, WideV a, WideV by_a) {
  const WideV middle = hn::Mul(across, depth);
  const WideV half =
      hn::Sqrt(hn::Mul(radius2, hn::Max(hn::Zero(Wide()), hn::Add(hn::Mul(across, across), a))));
  return {hn::Mul(hn::Sub(middle, half), by_a), hn::Mul(hn::Add(middle, half), by_a)};
}

/// Numbers of the view that are computed once for each frame.
struct Projector {
  const FrameRays& frame;
  bool is_perspective;
  bool centers_only;
  double frame_slack;  // world units
  double px_per_unit;  // of u and v
  double middle_px[2];

  /// Finds the extents of `count` indices. A whole vector of indices is read.
  HWY_INLINE void project(const Extent* world, const uint32_t* indices, uint32_t count,
                          Extent* screen) const;
  HWY_INLINE Range to_pixels(const Range& range, double sign, double middle) const {
    const Wide d;
    const WideV scale = hn::Set(d, sign * px_per_unit);
    const WideV offset = hn::Set(d, middle);
    const WideV a = hn::Add(hn::Mul(range.low, scale), offset);
    const WideV b = hn::Add(hn::Mul(range.high, scale), offset);
    const Range exact = {hn::Min(a, b), hn::Max(a, b)};
    return centers_only ? Range{hn::Ceil(exact.low), hn::Floor(exact.high)} : exact;
  }
};

HWY_INLINE void Projector::project(const Extent* world, const uint32_t* indices, uint32_t count,
                                   Extent* screen) const {
  const Wide d;
  const View& view = frame.view;
  const WideV zero = hn::Zero(d);
  const ExtentLanes extent = load_extents(world, indices);
  const Lanes3<Wide> from_eye = extent.center - broadcast(d, view.eye);
  const Lanes3<Wide> from_pivot = extent.center - broadcast(d, frame.pivot);
  const Vec3 ones{1.0};
  const WideV size =
      hn::Add(reach_along(extent, ones),
              hn::Add(hn::Add(hn::Abs(from_eye.x), hn::Abs(from_eye.y)), hn::Abs(from_eye.z)));
  const WideV slack = hn::Add(hn::Mul(size, hn::Set(d, kScreenSlack)), hn::Set(d, frame_slack));
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const auto is_ball = hn::Lt(extent.outside2, hn::Set(d, kNone));
  const WideV ball_reach = hn::Add(hn::Sqrt(hn::IfThenElseZero(is_ball, extent.outside2)), slack);
  const auto reach = [&](const Vec3& axis) {
    return hn::IfThenElse(is_ball, ball_reach, hn::Add(reach_along(extent, axis), slack));
  };
  const WideV depth = dot(d, from_eye, broadcast(d, view.forward));
  const WideV depth_reach = reach(view.forward);
  const WideV nearest = hn::Sub(depth, depth_reach);
  const WideV furthest = hn::Add(depth, depth_reach);
  auto anywhere = hn::Lt(depth, depth);
  auto behind = anywhere;
  const WideV across[2] = {dot(d, from_eye, broadcast(d, view.right)),
                           dot(d, from_eye, broadcast(d, view.up))};
  const WideV across_reach[2] = {reach(view.right), reach(view.up)};
  Range ranges[2];
  for (int i = 0; i < 2; ++i) {
    ranges[i] = {hn::Sub(across[i], across_reach[i]), hn::Add(across[i], across_reach[i])};
  }
  if (is_perspective) {
    anywhere = hn::Le(nearest, hn::Mul(hn::Set(d, kNearestDepth), depth_reach));
    behind = hn::Le(furthest, zero);
    const WideV one = hn::Set(d, 1.0);
    if (!hn::AllTrue(d, is_ball)) {
      const WideV by_nearest = hn::Div(one, nearest);
      const WideV by_furthest = hn::Div(one, furthest);
      for (int i = 0; i < 2; ++i) {
        ranges[i] = box_range(across[i], across_reach[i], by_nearest, by_furthest);
      }
    }
    if (!hn::AllFalse(d, is_ball)) {
      const WideV radius2 = hn::Mul(ball_reach, ball_reach);
      const WideV a = hn::Sub(hn::Mul(depth, depth), radius2);
      const WideV by_a = hn::Div(one, a);
      for (int i = 0; i < 2; ++i) {
        const Range ball = ball_range(across[i], depth, radius2, a, by_a);
        ranges[i] = {hn::IfThenElse(is_ball, ball.low, ranges[i].low),
                     hn::IfThenElse(is_ball, ball.high, ranges[i].high)};
      }
    }
  }
  const Range x = to_pixels(ranges[0], 1, middle_px[0]);
  const Range y = to_pixels(ranges[1], -1, middle_px[1]);
  const WideV far_off = hn::Set(d, 1e6);  // beyond every picture; its halves are exact
  alignas(64) double low_x[8], high_x[8], low_y[8], high_y[8], t[8], t_reach[8], inside2[8],
      gone[8];
  const auto clamp = [&](WideV v, WideV otherwise) {
    const WideV limited = hn::Max(hn::Min(v, far_off), hn::Neg(far_off));
    return hn::IfThenElse(anywhere, otherwise, limited);
  };
  hn::Store(clamp(x.low, hn::Neg(far_off)), d, low_x);
  hn::Store(clamp(x.high, far_off), d, high_x);
  hn::Store(clamp(y.low, hn::Neg(far_off)), d, low_y);
  hn::Store(clamp(y.high, far_off), d, high_y);
  hn::Store(dot(d, from_pivot, broadcast(d, view.forward)), d, t);
  hn::Store(depth_reach, d, t_reach);
  hn::Store(hn::IfThenElse(hn::Lt(extent.inside2, zero), hn::Set(d, -1.0), zero), d, inside2);
  hn::Store(hn::IfThenElseZero(behind, hn::Set(d, 1.0)), d, gone);
  for (uint32_t i = 0; i < count; ++i) {
    Extent& result = screen[indices[i]];
    result = {{0, 0, t[i]}, {0, 0, t_reach[i]}, kNone, inside2[i]};
    set_rectangle({low_x[i], high_x[i], low_y[i], high_y[i]}, view, result);
    if (gone[i] != 0) result.half[0] = -kNone;
  }
}

void find_screen_extents(const Extent* world, std::span<const uint32_t> indices,
                         const FrameRays& frame, const ScreenOptions& options, Extent* screen) {
  const View& view = frame.view;
  const double scale = glm::dot(glm::abs(view.eye), Vec3{1.0}) +
                       glm::dot(glm::abs(frame.pivot), Vec3{1.0}) + std::abs(frame.base_s);
  const Projector projector{frame,
                            view.projection == Projection::kPerspective,
                            options.centers_only,
                            kScreenSlack * kRoundedOnce * scale,
                            0.5 * view.height_px / view.half_height,
                            {0.5 * view.width_px - 0.5, 0.5 * view.height_px - 0.5}};
  const size_t lanes = hn::Lanes(Wide());
  for (size_t first = 0; first < indices.size(); first += lanes) {
    const uint32_t* group = indices.data() + first;
    const size_t count = std::min(indices.size() - first, lanes);
    uint32_t padded[8];
    if (count < lanes) {
      std::fill(padded, padded + 8, *group);
      std::copy_n(group, count, padded);
      group = padded;
    }
    projector.project(world, group, static_cast<uint32_t>(count), screen);
  }
}

/// The slack of coordinates in float, for some ten operations that round by 2^-24 each; and the
/// slack of bounds in pixels. kFarBeside is in sizes of the picture: a bound further beside the
/// picture stays beside it, however it is rounded.
constexpr double kFloatSlack = 0x1p-19;
constexpr double kFloatSlack_px = 0.125;
constexpr double kFarBeside = 4;

/// The same as kNearestDepth, for a ball's reach in float, which has half the digits.
constexpr double kNearestDepthInFloat = 0x1p-10;

ScreenRectangle find_rectangles(const BallRows& balls, uint32_t count, const Vec3& center,
                                const FrameRays& frame, const ScreenOptions& options,
                                float* const (&rows)[4]) {
  constexpr double kFar = 1e30;
  const hn::CappedTag<float, kRowPadding> d;
  using V = hn::Vec<decltype(d)>;
  const auto set = [&](double value) { return hn::Set(d, static_cast<float>(value)); };
  const View& view = frame.view;
  const bool is_perspective = view.projection == Projection::kPerspective;
  const Vec3 from_eye = center - view.eye;
  const Vec3 axes[3] = {view.right, view.up, view.forward};
  const double sizes_px[2] = {static_cast<double>(view.width_px),
                              static_cast<double>(view.height_px)};
  const double px_per_unit = 0.5 * view.height_px / view.half_height;
  const double slack_px =
      kFloatSlack_px + kFloatSlack * kFarBeside * std::max(sizes_px[0], sizes_px[1]);
  const Vec3 ones{1.0};
  const double double_slack =
      kScreenSlack *
      glm::dot(glm::abs(from_eye) + kRoundedOnce * (glm::abs(center) + glm::abs(view.eye)), ones);
  double middle[3], slack[3];  // of the group's centre, along the view's axes
  for (int i = 0; i < 3; ++i) {
    middle[i] = glm::dot(from_eye, axes[i]);
    slack[i] = double_slack + kFloatSlack * std::abs(middle[i]);
  }
  V all[4] = {set(kFar), set(-kFar), set(kFar), set(-kFar)};
  for (uint32_t first = 0; first < count; first += static_cast<uint32_t>(hn::Lanes(d))) {
    const V offset[3] = {hn::LoadU(d, balls.x + first), hn::LoadU(d, balls.y + first),
                         hn::LoadU(d, balls.z + first)};
    const V radius = hn::LoadU(d, balls.radius + first);
    const V size = hn::Add(hn::Add(hn::Abs(offset[0]), hn::Abs(offset[1])),
                           hn::Add(hn::Abs(offset[2]), radius));
    const V rounded_reach = hn::Add(radius, hn::Mul(size, set(kFloatSlack)));
    V low[3], high[3];
    for (int i = 0; i < 3; ++i) {
      const double unit = i == 0 ? px_per_unit : i == 1 ? -px_per_unit : 1;  // y goes down
      V at = set(unit * middle[i]);
      for (int axis = 0; axis < 3; ++axis) {
        at = hn::Add(at, hn::Mul(offset[axis], set(unit * axes[i][axis])));
      }
      const V reach = hn::Mul(hn::Add(rounded_reach, set(slack[i])), set(std::abs(unit)));
      low[i] = hn::Sub(at, reach);
      high[i] = hn::Add(at, reach);
    }
    const V& nearest = low[2];
    const V& furthest = high[2];
    // Numbers that overflow count as neither behind nor beside.
    const V behind = is_perspective ? furthest : set(1);
    // A ball next to the eye's plane may be anywhere, and so may one whose numbers overflow.
    const V least = is_perspective ? hn::Mul(rounded_reach, set(kNearestDepthInFloat))
                                   : set(-std::numeric_limits<double>::infinity());
    const auto is_ahead = hn::Gt(nearest, least);
    const V by_nearest = is_perspective ? hn::Div(set(1), nearest) : set(1);
    const V by_furthest = is_perspective ? hn::Div(set(1), furthest) : set(1);
    const uint32_t left = count - first;
    auto is_nowhere = hn::Or(hn::Le(behind, hn::Zero(d)), hn::Not(hn::FirstN(d, left)));
    V bounds[4];
    for (int i = 0; i < 2; ++i) {
      const double middle_px = 0.5 * sizes_px[i] - 0.5;
      V from = hn::Add(hn::Min(hn::Mul(low[i], by_nearest), hn::Mul(low[i], by_furthest)),
                       set(middle_px - slack_px));
      V to = hn::Add(hn::Max(hn::Mul(high[i], by_nearest), hn::Mul(high[i], by_furthest)),
                     set(middle_px + slack_px));
      const auto is_number = hn::And(hn::Lt(from, set(kFar)), hn::Gt(to, set(-kFar)));
      const auto is_known = hn::And(is_ahead, is_number);
      from = hn::IfThenElse(is_known, from, set(-kFar));
      to = hn::IfThenElse(is_known, to, set(kFar));
      // The coordinate of a pixel's centre is the pixel's number.
      if (options.centers_only) {
        from = hn::Ceil(from);
        to = hn::Floor(to);
        is_nowhere = hn::Or(is_nowhere, hn::Gt(from, to));
      }
      is_nowhere = hn::Or(is_nowhere, hn::Or(hn::Gt(from, set(sizes_px[i])), hn::Lt(to, set(-1))));
      bounds[2 * i] = from;
      bounds[2 * i + 1] = to;
    }
    for (int i = 0; i < 4; ++i) {
      const bool is_low = i % 2 == 0;
      const V bound = hn::IfThenElse(is_nowhere, set(is_low ? kFar : -kFar), bounds[i]);
      all[i] = is_low ? hn::Min(all[i], bound) : hn::Max(all[i], bound);
      if (left >= hn::Lanes(d)) {
        hn::StoreU(bound, d, rows[i] + first);
        continue;
      }
      float some[kRowPadding];  // the entries that follow belong to another group
      hn::StoreU(bound, d, some);
      std::copy_n(some, left, rows[i] + first);
    }
  }
  const auto lowest = [&](V v) { return hn::GetLane(hn::MinOfLanes(d, v)); };
  const auto highest = [&](V v) { return hn::GetLane(hn::MaxOfLanes(d, v)); };
  return {lowest(all[0]), highest(all[1]), lowest(all[2]), highest(all[3])};
}

}  // namespace HWY_NAMESPACE
}  // namespace csgcore
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace csgcore {

CSGCORE_SIMD_EXPORT(find_screen_extents);
CSGCORE_SIMD_EXPORT(find_rectangles);

ScreenRectangle find_rectangles(const BallRows& balls, uint32_t count, const Vec3& center,
                                const FrameRays& frame, const ScreenOptions& options,
                                float* const (&rows)[4]) {
  return CSGCORE_SIMD(find_rectangles)(balls, count, center, frame, options, rows);
}

void find_screen_extents(const Extent* world, std::span<const uint32_t> indices,
                         const FrameRays& frame, const ScreenOptions& options, Extent* screen) {
  CSGCORE_SIMD(find_screen_extents)(world, indices, frame, options, screen);
}

Extent screen_extent_of(const Box& solid_bounds, const FrameRays& frame,
                        const ScreenOptions& options) {
  // The margin is far larger than the rounding of a ray, and far smaller than a pixel.
  const double margin = cell_overlap(solid_bounds);
  CanonicalPrimitive of_box;
  of_box.bounds = {solid_bounds.min - margin, solid_bounds.max + margin};
  const Extent world = extent_of(of_box);
  constexpr uint32_t kOnlyOne[] = {0};
  Extent screen;
  find_screen_extents(&world, kOnlyOne, frame, options, &screen);
  return screen;
}

PixelArea pixels_of(const Extent& screen, const View& view) {
  if (!is_visible(screen)) return {};
  const uint32_t size[] = {view.width_px, view.height_px};
  uint32_t first[2], end[2];
  for (const int axis : {0, 1}) {
    const auto within = [&](double x) {
      return static_cast<uint32_t>(std::clamp(x, 0.0, double(size[axis])));
    };
    first[axis] = within(std::ceil(screen.center[axis] - screen.half[axis] - 0.5));
    end[axis] = within(std::floor(screen.center[axis] + screen.half[axis] + 0.5) + 1);
    if (first[axis] >= end[axis]) return {};
  }
  return {first[0], first[1], end[0] - first[0], end[1] - first[1]};
}

void set_rectangle(const ScreenRectangle& pixels, const View& view, Extent& screen) {
  const double low[] = {pixels.low_x, pixels.low_y};
  const double high[] = {pixels.high_x, pixels.high_y};
  const double size[] = {double(view.width_px), double(view.height_px)};
  bool is_off = false;
  for (const int axis : {0, 1}) {
    screen.center[axis] = 0.5 * (low[axis] + high[axis]);
    screen.half[axis] = 0.5 * (high[axis] - low[axis]);
    is_off |= high[axis] < -0.5 || low[axis] > size[axis] - 0.5;
  }
  if (is_off) {
    screen.half[0] = -std::numeric_limits<double>::infinity();
  } else if (pixels.is_empty()) {
    screen.outside2 = -1.0;
  }
}

void narrow(const ScreenRectangle& to, const View& view, Extent& screen) {
  const auto low = [&](int axis) { return screen.center[axis] - screen.half[axis]; };
  const auto high = [&](int axis) { return screen.center[axis] + screen.half[axis]; };
  set_rectangle({std::max(to.low_x, low(0)), std::min(to.high_x, high(0)),
                 std::max(to.low_y, low(1)), std::min(to.high_y, high(1))},
                view, screen);
}

}  // namespace csgcore
#endif  // HWY_ONCE
