#include "kinds/profile_solid.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace csgcore::reference {
namespace {

using test_support::Side;

constexpr Real kInfinity = std::numeric_limits<Real>::infinity();

/// What a box allows for rounding, as a share of its size.
constexpr Real kBoxSlack = Real(1e-9);

struct Range {
  Real low = -kInfinity, high = kInfinity;
};

/// Returns where the line is in the box.
Range within_box(const NearRay& ray, const LongVec3& min, const LongVec3& max) {
  Range range;
  for (int axis = 0; axis < 3; ++axis) {
    const Real slack = kBoxSlack * glm::length(max - min);
    const Real low = min[axis] - slack - ray.origin[axis];
    const Real high = max[axis] + slack - ray.origin[axis];
    const Real d = ray.direction[axis];
    if (d == 0) {
      if (low > 0 || high < 0) return {kInfinity, -kInfinity};
      continue;
    }
    range.low = std::max(range.low, std::min(low / d, high / d));
    range.high = std::min(range.high, std::max(low / d, high / d));
  }
  return range;
}

/// A polynomial of degree 2 or less.
struct Powers {
  Real c[3] = {0, 0, 0};
  friend Powers operator+(const Powers& a, const Powers& b) {
    return {{a.c[0] + b.c[0], a.c[1] + b.c[1], a.c[2] + b.c[2]}};
  }
  friend Powers operator*(Real factor, const Powers& a) {
    return {{factor * a.c[0], factor * a.c[1], factor * a.c[2]}};
  }
};

/// Adds factor·a·b.
void add_product(Real factor, const Powers& a, const Powers& b, Polynomial& sum) {
  for (size_t i = 0; i < 3; ++i) {
    for (size_t j = 0; j < 3; ++j) {
      if (i + j < sum.size()) sum[i + j] += factor * a.c[i] * b.c[j];
    }
  }
}

}  // namespace

void ProfileSolid::add_spans(const NearRay& far_ray, Real, std::vector<Span>& spans) const {
  const Range far = within_box(far_ray, min(), max());
  if (!(far.low < far.high)) return;
  // From far away coefficients would cancel.
  const Real base = (far.low + far.high) / 2;
  const NearRay ray{far_ray.origin + base * far_ray.direction, far_ray.direction};
  const Real low = far.low - base, high = far.high - base;
  std::vector<Real> splits{low, high};
  for (const FigureEdge& edge : figure_.edges()) {
    append_splits(along(ray, edge), 4, low, high, splits);
  }
  for (const Real z : {min().z, max().z}) {
    const Real t = (z - ray.origin.z) / ray.direction.z;
    if (t > low && t < high) splits.push_back(t);
  }
  // A ray that touches the axis passes it.
  const Real lateral2 = ray.direction.x * ray.direction.x + ray.direction.y * ray.direction.y;
  const Real foot = -(ray.origin.x * ray.direction.x + ray.origin.y * ray.direction.y) / lateral2;
  if (foot > low && foot < high) splits.push_back(foot);
  std::sort(splits.begin(), splits.end());
  const size_t first = spans.size();
  // Stretches that are shorter are taken for rounding.
  const Real least = 4 * std::numeric_limits<Real>::epsilon() * (high - low);
  bool is_open = false;
  Real begin = low;
  for (size_t i = 0; i + 1 < splits.size(); ++i) {
    if (!(splits[i + 1] - splits[i] > least)) continue;
    const Real middle = (splits[i] + splits[i + 1]) / 2;
    const bool is_inside = contains(ray.origin + middle * ray.direction);
    if (is_inside && !is_open) begin = splits[i];
    if (!is_inside && is_open) spans.push_back({begin, splits[i]});
    is_open = is_inside;
  }
  if (is_open) spans.push_back({begin, high});
  for (size_t i = first; i < spans.size(); ++i) {
    spans[i].begin_surface = surface_at(ray.origin + spans[i].begin * ray.direction);
    spans[i].end_surface = surface_at(ray.origin + spans[i].end * ray.direction);
    spans[i].begin += base;
    spans[i].end += base;
  }
}

Vec3 ProfileSolid::core(const Vec3& surface_point) const {
  const Real size = glm::length(max() - min());
  constexpr Real kRounding = Real(1e-13);  // of a surface point, as a share of the size
  constexpr Vec3 kAskew{0.6123, 0.4571, 0.6449};
  Real furthest = 0;
  Vec3 best = surface_point;
  std::vector<Span> spans;
  constexpr Real kEnough = Real(0.03);  // as a share of the size
  for (int i = 0; i < 125 && furthest < kEnough * size; ++i) {
    const Vec3 grid(i % 5 - 2, i / 5 % 5 - 2, i / 25 - 2);
    const Vec3 direction = glm::normalize(grid + 0.3 * kAskew * Vec3(1, -1, 1));
    spans.clear();
    add_spans({LongVec3(surface_point), LongVec3(direction)}, 0, spans);
    Real way = 0;
    bool is_alone = true;
    for (const Span& span : spans) {
      if (std::abs(span.begin) <= kRounding * size) way = span.end / 2;
      if (std::abs(span.end) <= kRounding * size) is_alone = false;
    }
    if (is_alone && way > furthest) {
      furthest = way;
      best = surface_point + double(way) * direction;
    }
  }
  return best;
}

// --- Extrusions ---

ExtrusionSolid::ExtrusionSolid(const Primitive& p)
    : ProfileSolid(*p.profile()),
      z_min_(p.as<ExtrusionShape>().z_min),
      z_max_(p.as<ExtrusionShape>().z_max),
      bottom_scale_(p.as<ExtrusionShape>().scale_bottom),
      top_scale_(p.as<ExtrusionShape>().scale_top),
      growth_((top_scale_ - bottom_scale_) / (z_max_ - z_min_)) {}

LongVec3 ExtrusionSolid::min() const {
  const LongVec2 low = glm::min(bottom_scale_ * figure().min(), top_scale_ * figure().min());
  return {low.x, low.y, z_min_};
}
LongVec3 ExtrusionSolid::max() const {
  const LongVec2 high = glm::max(bottom_scale_ * figure().max(), top_scale_ * figure().max());
  return {high.x, high.y, z_max_};
}

bool ExtrusionSolid::contains(const LongVec3& point) const {
  const Real scale = scale_at(point.z);
  return point.z >= z_min_ && point.z <= z_max_ && scale > 0 &&
         figure().contains(LongVec2(point) / scale);
}

/// The curve's function of (x, y)/scale, times scale².
Polynomial ExtrusionSolid::along(const NearRay& ray, const FigureEdge& edge) const {
  const Powers s{{scale_at(ray.origin.z), growth_ * ray.direction.z, 0}};
  const Powers u = Powers{{ray.origin.x, ray.direction.x, 0}} + -edge.start.x * s;
  const Powers v = Powers{{ray.origin.y, ray.direction.y, 0}} + -edge.start.y * s;
  Polynomial result{};
  if (edge.is_line()) {
    const Powers sum = edge.u * u + edge.v * v;
    return {sum.c[0], sum.c[1], 0, 0, 0};
  }
  add_product(edge.uu, u, u, result);
  add_product(edge.uv, u, v, result);
  add_product(edge.vv, v, v, result);
  add_product(edge.u, u, s, result);
  add_product(edge.v, v, s, result);
  return result;
}

std::vector<Side> ExtrusionSolid::sides(const LongVec3& point) const {
  std::vector<Side> result{{z_min_ - point.z, {0, 0, -1}}, {point.z - z_max_, {0, 0, 1}}};
  const Real scale = scale_at(point.z);
  if (scale > 0) {
    const LongVec2 place = LongVec2(point) / scale;
    const auto [edge, nearest, outside, outwards] = figure().nearest(place, false);
    const Real upwards = growth_ * (outside - glm::dot(outwards, place));
    result.push_back({scale * outside, {outwards.x, outwards.y, upwards}});
  }
  return result;
}

Surface ExtrusionSolid::surface_at(const LongVec3& point) const {
  const Real scale = scale_at(point.z);
  const Real bottom = std::abs(point.z - z_min_), top = std::abs(point.z - z_max_);
  const Surface cap = bottom < top ? Surface::kBottom : Surface::kTop;
  if (!(scale > 0)) return cap;
  const Figure::Place place = figure().nearest(LongVec2(point) / scale, false);
  if (std::min(bottom, top) < scale * std::abs(place.outside)) return cap;
  return edge_surface(place.edge);
}

LongVec3 ExtrusionSolid::normal(const LongVec3& point, Surface surface) const {
  if (surface == Surface::kBottom) return {0, 0, -1};
  if (surface == Surface::kTop) return {0, 0, 1};
  const LongVec2 place = LongVec2(point) / scale_at(point.z);
  const LongVec2 outwards = figure().nearest(place, false).outwards;
  return {outwards.x, outwards.y, -growth_ * glm::dot(outwards, place)};
}

// --- Revolutions ---

namespace {

LongVec2 place_of(const LongVec3& point) { return {std::hypot(point.x, point.y), point.z}; }

/// Turns a direction of the figure's plane into that of the half-plane through the point.
LongVec3 turned(const LongVec2& direction, const LongVec3& point) {
  const Real radius = std::hypot(point.x, point.y);
  const LongVec2 across = radius > 0 ? LongVec2(point) / radius : LongVec2(1, 0);
  return {direction.x * across.x, direction.x * across.y, direction.y};
}

}  // namespace

LongVec3 RevolutionSolid::min() const {
  return {-figure().max().x, -figure().max().x, figure().min().y};
}
LongVec3 RevolutionSolid::max() const {
  return {figure().max().x, figure().max().x, figure().max().y};
}

bool RevolutionSolid::contains(const LongVec3& point) const {
  return figure().contains(place_of(point));
}

/// The curve's function is m + n·r for the distance r from the axis. This is m² − n²·r².
Polynomial RevolutionSolid::along(const NearRay& ray, const FigureEdge& edge) const {
  const Powers x{{ray.origin.x, ray.direction.x, 0}}, y{{ray.origin.y, ray.direction.y, 0}};
  const Powers v{{ray.origin.z - edge.start.y, ray.direction.z, 0}};
  Polynomial squares{}, rest{};
  add_product(1, x, x, squares);
  add_product(1, y, y, squares);
  const Powers r2{{squares[0], squares[1], squares[2]}};
  const Real u = -edge.start.x;
  add_product(edge.vv, v, v, rest);
  const Powers m = edge.uu * r2 + Powers{{rest[0], rest[1], rest[2]}} + (edge.uv * u + edge.v) * v +
                   Powers{{edge.uu * u * u + edge.u * u, 0, 0}};
  const Powers n = edge.uv * v + Powers{{2 * edge.uu * u + edge.u, 0, 0}};
  Polynomial result{}, n2{};
  add_product(1, m, m, result);
  add_product(1, n, n, n2);
  add_product(-1, {{n2[0], n2[1], n2[2]}}, r2, result);
  return result;
}

std::vector<Side> RevolutionSolid::sides(const LongVec3& point) const {
  const Figure::Place place = figure().nearest(place_of(point), true);
  return {{place.outside, turned(place.outwards, point)}};
}

Surface RevolutionSolid::surface_at(const LongVec3& point) const {
  return edge_surface(figure().nearest(place_of(point), true).edge);
}

LongVec3 RevolutionSolid::normal(const LongVec3& point, Surface) const {
  return turned(figure().nearest(place_of(point), true).outwards, point);
}

}  // namespace csgcore::reference
