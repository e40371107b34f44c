#include "lower/seen_box.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <optional>
#include <unordered_map>

#include "csgcore/canonical_primitive.hpp"
#include "csgcore/hits.hpp"
#include "csgcore/solid.hpp"
#include "csgcore/tracer.hpp"
#include "csgcore/view.hpp"
#include "lower/faceted_box.hpp"

namespace frontend {
namespace {

using csgcore::Affine;
using csgcore::Box;
using csgcore::Hits;
using csgcore::Mat3;
using csgcore::Primitive;
using csgcore::Solid;
using csgcore::Vec3;
using csgcore::View;

constexpr uint32_t kCloseUp_px = 32;   // a side of the looks at the pixel that comes out farthest
constexpr double kCloseUpReach = 1.5;  // pixels around that one's centre: its neighbours, too
constexpr int kCloseUps = 3;           // each nearer by 32 / 3

/// How far a point is moved towards a primitive's centre before it is asked for, so that rounding
/// does not decide: a share of its distance.
constexpr double kInwards = 1e-6;

/// Looks at the solid from outside along an axis, the nearest point of it being its farthest that
/// way.
View outside_view(const Box& around, int axis, double sign, uint32_t side_px) {
  View view;
  view.projection = csgcore::Projection::kOrthographic;
  view.forward = view.right = view.up = Vec3(0.0);
  view.forward[axis] = -sign;
  view.right[(axis + 1) % 3] = sign;
  view.up[(axis + 2) % 3] = 1;
  const Vec3 half = 0.5 * around.size();
  // With some room, and more than nothing where the box is flat.
  const double reach = 1.01 * std::max({half.x, half.y, half.z});
  view.eye = around.center() - reach * view.forward;
  view.half_height = reach;
  view.width_px = view.height_px = side_px;
  return view;
}

/// The pixel whose hit is nearest the eye.
std::optional<std::size_t> nearest_pixel(const Hits& hits) {
  const auto nearest = std::min_element(hits.s.begin(), hits.s.end());
  if (nearest == hits.s.end() || !std::isfinite(*nearest)) return std::nullopt;
  return static_cast<std::size_t>(nearest - hits.s.begin());
}

/// The solid's farthest coordinate that way.
std::optional<double> farthest(const Solid& solid, int axis, double sign, uint32_t overview_px) {
  View view = outside_view(solid.bounds(), axis, sign, overview_px);
  std::optional<double> result;
  for (int look = 0; look <= kCloseUps; ++look) {
    Hits hits;
    csgcore::TraceStats stats;
    csgcore::TraceOptions options;
    options.threads = 1;  // a look takes less time than to start threads
    csgcore::trace(solid, view, options, hits, stats);
    const std::optional<std::size_t> pixel = nearest_pixel(hits);
    if (!pixel) break;
    const double found = view.eye[axis] - sign * hits.s[*pixel];
    result = !result || sign * found > sign * *result ? found : *result;
    const double x = static_cast<double>(*pixel % view.width_px);
    const double y = static_cast<double>(*pixel / view.width_px);
    view.eye = csgcore::pixel_ray(view, x, y).origin;
    view.half_height *= 2 * kCloseUpReach / view.height_px;
    view.width_px = view.height_px = kCloseUp_px;
  }
  return result;
}

/// Whether a point of a primitive is left that reaches the side of the solid's bounds: most solids
/// keep the corners, or the middles, of the faces that bound their operands.
bool reaches_bounds(const Solid& solid, int axis, double sign) {
  constexpr size_t kMostPrimitives = 64;  // that are asked
  constexpr double kTilt = 1e-3;          // finds the corners of a face that lies in the side
  const double size = solid.bounds().diagonal();
  const auto side_of = [&](const Box& box) { return sign > 0 ? box.max[axis] : box.min[axis]; };
  const double side = side_of(solid.bounds());
  const auto is_left = [&](const Vec3& point, const Vec3& center) {
    const Vec3 within = point + kInwards * (center - point);
    return std::abs(within[axis] - side) <= 2 * kInwards * size && solid.contains(within);
  };
  size_t asked = 0;
  for (const csgcore::CanonicalPrimitive& primitive : solid.primitives()) {
    if (std::abs(side_of(primitive.bounds) - side) > kInwards * size) continue;
    if (++asked > kMostPrimitives) break;
    Vec3 middle(0.0);
    for (const double u : {-kTilt, kTilt}) {
      for (const double v : {-kTilt, kTilt}) {
        Vec3 direction(0.0);
        direction[axis] = sign;
        direction[(axis + 1) % 3] = u;
        direction[(axis + 2) % 3] = v;
        const Vec3 corner = csgcore::furthest_point(primitive, direction);
        if (is_left(corner, primitive.center)) return true;
        middle += 0.25 * corner;
      }
    }
    if (is_left(middle, primitive.center)) return true;
  }
  return false;
}

Box tight_box(const Solid& solid, uint32_t overview_px) {
  Box box;
  if (solid.bounds().empty()) return box;
  Vec3 least, most;
  for (int axis = 0; axis < 3; ++axis) {
    const Box& bounds = solid.bounds();
    const std::optional<double> low =
        reaches_bounds(solid, axis, -1) ? bounds.min[axis] : farthest(solid, axis, -1, overview_px);
    const std::optional<double> high =
        reaches_bounds(solid, axis, 1) ? bounds.max[axis] : farthest(solid, axis, 1, overview_px);
    if (!low || !high) return box;
    least[axis] = *low;
    most[axis] = *high;
  }
  box.merge(least);
  box.merge(most);
  return box;
}

}  // namespace

Box seen_box(std::span<const Primitive> primitives, const csgcore::CsgTree& solid,
             const Affine& frame_to_world, uint32_t overview_px) {
  csgcore::Scene scene;
  std::unordered_map<uint32_t, uint32_t> new_indices;
  scene.model = csgcore::renamed(solid, [&](uint32_t index) {
    const auto next = static_cast<uint32_t>(scene.primitives.size());
    const auto [entry, is_new] = new_indices.try_emplace(index, next);
    if (is_new) scene.primitives.push_back(primitives[index]);
    return entry->second;
  });
  if (scene.model.empty()) return {};
  Affine to_frame;
  to_frame.linear = csgcore::inverse(frame_to_world.linear);
  to_frame.translation = -(to_frame.linear * frame_to_world.translation);
  for (Primitive& primitive : scene.primitives) {
    primitive.local_to_world = csgcore::compose(to_frame, primitive.local_to_world);
    if (!csgcore::is_valid(primitive)) return {};  // beyond what doubles hold
  }
  const Solid in_frame(csgcore::canonical_primitives(scene), scene.model);
  const Box box = tight_box(in_frame, overview_px);
  return box.empty() ? box : mapped(frame_to_world, box);
}

}  // namespace frontend
