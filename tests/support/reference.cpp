#include "reference.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <span>
#include <thread>

namespace csgcore {
namespace {

using Real = long double;
using LongVec3 = glm::vec<3, Real>;
using LongMat3 = glm::mat<3, 3, Real>;

constexpr Real kInfinity = std::numeric_limits<Real>::infinity();

/// Pixels per side of the blocks for which the tree is first reduced to what their rays can meet.
constexpr uint32_t kBlockPx = 16;

/// Planes cull a primitive only when it is clear of them by this share of its distance from the
/// plane's origin and of its size, far above the rounding of double, so that culling never changes
/// a hit.
constexpr double kCullingSlack = 1e-9;

// --- One primitive against one ray -----------------------------------------------------------

enum class Surface : uint8_t { kSide, kBottom, kTop };

/// Where a ray crosses a primitive's surface.
struct Crossing {
  Real t = 0;
  uint32_t primitive = 0;
  Surface surface = Surface::kSide;
  bool enters_primitive = true;
};

/// A piece of the ray inside a solid.
struct Piece {
  Crossing begin, end;
};

struct Prepared {
  Primitive primitive;
  LongMat3 world_to_local;
  LongVec3 center_local;  // where the ray is recentred: the middle of the local solid
};

struct LocalRay {
  LongVec3 origin, direction;
  Real t_offset;  // the world ray's parameter at the local origin
};

struct Span {
  Real begin, end;
  Surface begin_surface = Surface::kSide, end_surface = Surface::kSide;
  bool empty() const { return !(begin < end); }
};

Prepared prepare(const Primitive& primitive) {
  const bool sphere = primitive.shape == Shape::kSphere;
  const Real middle = sphere ? 0 : (Real(primitive.z_min) + Real(primitive.z_max)) / 2;
  return {primitive, glm::inverse(LongMat3(primitive.local_to_world.linear)),
          LongVec3(0, 0, middle)};
}

/// The ray in local coordinates, its origin moved to the point nearest to the primitive's middle:
/// that is what keeps precision when the eye is far away.
LocalRay localize(const Prepared& prepared, const Ray& ray) {
  const Affine& map = prepared.primitive.local_to_world;
  const LongVec3 direction(ray.direction);
  const LongVec3 middle = LongMat3(map.linear) * prepared.center_local + LongVec3(map.translation);
  const LongVec3 to_origin = LongVec3(ray.origin) - middle;
  const Real t = -glm::dot(to_origin, direction) / glm::dot(direction, direction);
  const LongVec3 from_middle = prepared.world_to_local * (to_origin + t * direction);
  return {from_middle + prepared.center_local, prepared.world_to_local * direction, t};
}

Span cross_sphere(const LocalRay& ray, Real radius) {
  const Real dd = glm::dot(ray.direction, ray.direction);
  const Real closest = -glm::dot(ray.origin, ray.direction) / dd;
  const LongVec3 foot = ray.origin + closest * ray.direction;
  const Real half_squared = (radius * radius - glm::dot(foot, foot)) / dd;
  if (!(half_squared > 0)) return {0, 0};
  const Real half = std::sqrt(half_squared);
  return {closest - half, closest + half};
}

Span cross_slab(const LocalRay& ray, Real z_min, Real z_max) {
  if (ray.direction.z == 0) {
    const bool inside = z_min <= ray.origin.z && ray.origin.z <= z_max;
    return inside ? Span{-kInfinity, kInfinity} : Span{0, 0};
  }
  const Real at_min = (z_min - ray.origin.z) / ray.direction.z;
  const Real at_max = (z_max - ray.origin.z) / ray.direction.z;
  if (at_min < at_max) return {at_min, at_max, Surface::kBottom, Surface::kTop};
  return {at_max, at_min, Surface::kTop, Surface::kBottom};
}

/// The part of the ray with x² + y² ≤ (r + slope·z)² that can lie in the nappe of positive radius.
/// With f(t) = a·t² + 2b·t + c ≤ 0: a > 0 is one segment; a < 0 is two half-lines, one in each
/// nappe, of which the radius's growth along the ray tells ours; a = 0 is one half-line.
Span cross_cone(const LocalRay& ray, Real radius_at_zero, Real slope) {
  const LongVec3 &o = ray.origin, &d = ray.direction;
  const Real radius = radius_at_zero + slope * o.z;
  const Real growth = slope * d.z;
  const Real a = d.x * d.x + d.y * d.y - growth * growth;
  const Real b = o.x * d.x + o.y * d.y - radius * growth;
  const Real c = o.x * o.x + o.y * o.y - radius * radius;
  if (a == 0) {
    if (b == 0) return c <= 0 ? Span{-kInfinity, kInfinity} : Span{0, 0};
    return b > 0 ? Span{-kInfinity, -c / (2 * b)} : Span{-c / (2 * b), kInfinity};
  }
  Real discriminant = b * b - a * c;
  if (discriminant < 0) {
    if (a > 0) return {0, 0};
    discriminant = 0;  // rounding: at the apex's height f ≥ 0, so for a < 0 there are roots
  }
  const Real q = -(b + std::copysign(std::sqrt(discriminant), b));
  if (q == 0) return a > 0 ? Span{0, 0} : growth > 0 ? Span{0, kInfinity} : Span{-kInfinity, 0};
  const Real low = std::min(q / a, c / q), high = std::max(q / a, c / q);
  if (a > 0) return {low, high};
  return growth > 0 ? Span{high, kInfinity} : Span{-kInfinity, low};
}

Real frustum_slope(const Primitive& p) {
  return (Real(p.r_top) - Real(p.r_bottom)) / (Real(p.z_max) - Real(p.z_min));
}

Span cross_frustum(const LocalRay& ray, const Primitive& p) {
  const Real slope = frustum_slope(p);
  Span span = cross_slab(ray, p.z_min, p.z_max);
  const Span side = cross_cone(ray, p.r_bottom - slope * p.z_min, slope);
  if (side.empty()) return side;
  if (side.begin > span.begin) span.begin = side.begin, span.begin_surface = Surface::kSide;
  if (side.end < span.end) span.end = side.end, span.end_surface = Surface::kSide;
  return span;
}

/// Appends the primitive's piece of the ray, if there is one.
void cross(const Prepared& prepared, uint32_t index, const Ray& ray, std::vector<Piece>& out) {
  const Primitive& p = prepared.primitive;
  const LocalRay local = localize(prepared, ray);
  const Span span =
      p.shape == Shape::kSphere ? cross_sphere(local, p.r_bottom) : cross_frustum(local, p);
  if (span.empty()) return;
  out.push_back({{local.t_offset + span.begin, index, span.begin_surface, true},
                 {local.t_offset + span.end, index, span.end_surface, false}});
}

/// The primitive's outward unit normal, in the world, at a crossing.
LongVec3 primitive_normal(const Prepared& prepared, const Crossing& crossing, const Ray& ray) {
  const Primitive& p = prepared.primitive;
  const LocalRay local = localize(prepared, ray);
  const LongVec3 at = local.origin + (crossing.t - local.t_offset) * local.direction;
  LongVec3 normal = at;
  if (crossing.surface == Surface::kBottom) normal = LongVec3(0, 0, -1);
  if (crossing.surface == Surface::kTop) normal = LongVec3(0, 0, 1);
  if (crossing.surface == Surface::kSide && p.shape == Shape::kFrustum) {
    const Real slope = frustum_slope(p);
    normal.z = -slope * std::hypot(at.x, at.y);
    // At the very apex every direction on the cone is as good: the axis.
    if (normal == LongVec3(0)) normal.z = p.r_top == 0 ? 1 : -1;
  }
  return glm::normalize(glm::transpose(prepared.world_to_local) * normal);
}

// --- Set operations on lists of pieces -------------------------------------------------------

struct Event {
  Crossing crossing;
  int inside_change;  // +1 where an operand's piece begins, −1 where it ends
  bool first_operand;
};

/// Combines operands' lists (each sorted and disjoint) by sweeping over all their ends.
class Sweep {
 public:
  /// `lists` holds the operands' pieces one list after the other, operand i from starts[i].
  std::span<const Piece> combine(Op op, std::span<const Piece> lists,
                                 std::span<const uint32_t> starts) {
    collect(lists, starts);
    result_.clear();
    const int operands = int(starts.size());
    int first = 0, others = 0;
    bool inside = false;
    for (const Event& event : events_) {
      (event.first_operand ? first : others) += event.inside_change;
      const bool now = op == Op::kUnion          ? first + others > 0
                       : op == Op::kIntersection ? first + others == operands
                                                 : first > 0 && others == 0;
      if (now && !inside) result_.push_back({event.crossing, {}});
      if (!now && inside) result_.back().end = event.crossing;
      inside = now;
    }
    return result_;
  }

 private:
  void collect(std::span<const Piece> lists, std::span<const uint32_t> starts) {
    events_.clear();
    const uint32_t base = starts.front();
    const uint32_t second = starts.size() > 1 ? starts[1] - base : uint32_t(lists.size());
    for (uint32_t i = 0; i < lists.size(); ++i) {
      events_.push_back({lists[i].begin, +1, i < second});
      events_.push_back({lists[i].end, -1, i < second});
    }
    std::stable_sort(events_.begin(), events_.end(),
                     [](const Event& a, const Event& b) { return a.crossing.t < b.crossing.t; });
  }

  std::vector<Event> events_;
  std::vector<Piece> result_;
};

/// The tree without the primitives that are not alive, which are the empty set here.
std::vector<CsgToken> reduce(std::span<const CsgToken> tokens, const std::vector<uint8_t>& alive) {
  std::vector<CsgToken> out;
  std::vector<size_t> starts;  // where each operand on the stack begins in `out`
  for (const CsgToken& token : tokens) {
    if (token.is_primitive) {
      starts.push_back(out.size());
      if (alive[token.value]) out.push_back(token);
      continue;
    }
    const size_t first = starts.size() - token.value;
    uint32_t operands = 0;
    for (size_t i = first; i < starts.size(); ++i) {
      operands += (i + 1 < starts.size() ? starts[i + 1] : out.size()) > starts[i];
    }
    const bool first_is_empty = starts[first + 1] == starts[first];
    const bool empty = (token.op == Op::kIntersection && operands < token.value) ||
                       (token.op == Op::kDifference && first_is_empty);
    if (empty) out.resize(starts[first]);
    if (!empty && operands > 1) out.push_back({false, token.op, operands});
    starts.resize(first + 1);
  }
  // What is left on the stack is the tree itself.
  return out;
}

// --- Conservative culling by planes ----------------------------------------------------------

/// max over the primitive of dot(x − point, normal); `normal` of any length.
double extent(const Primitive& p, const Vec3& point, const Vec3& normal) {
  const Vec3 local = glm::transpose(p.local_to_world.linear) * normal;
  const double base = glm::dot(p.local_to_world.translation - point, normal);
  if (p.shape == Shape::kSphere) return base + p.r_bottom * glm::length(local);
  const double across = std::hypot(local.x, local.y);
  return base +
         std::max(local.z * p.z_min + across * p.r_bottom, local.z * p.z_max + across * p.r_top);
}

/// A half-space dot(x − point, normal) ≥ 0 that the rays of a block stay in.
struct HalfSpace {
  Vec3 point, normal;
};

bool reaches(const Primitive& p, const HalfSpace& half_space) {
  const double high = extent(p, half_space.point, half_space.normal);
  const double scale =
      glm::length(half_space.normal) * glm::length(p.local_to_world.translation - half_space.point);
  return high >= -kCullingSlack * (scale + std::abs(high));
}

/// The half-space on the side of growing pixel coordinates of the line x = `px` (or y = `px`), or,
/// if `below`, on the other.
HalfSpace half_space(const View& view, bool vertical, double px, bool below) {
  const double size = vertical ? view.height_px : view.width_px;
  const double offset = (2 * px - size) / view.height_px * view.half_height;
  const Vec3 axis = vertical ? -view.up : view.right;
  const double sign = below ? -1 : 1;
  if (view.projection == Projection::kOrthographic) return {view.eye + offset * axis, sign * axis};
  return {view.eye, sign * (axis - offset * view.forward)};
}

struct PixelRange {
  uint32_t begin, end;
};

std::vector<uint32_t> cull(const std::vector<Prepared>& all, std::span<const uint32_t> candidates,
                           const View& view, bool vertical, PixelRange range) {
  const HalfSpace from = half_space(view, vertical, range.begin, false);
  const HalfSpace to = half_space(view, vertical, range.end, true);
  std::vector<uint32_t> kept;
  for (const uint32_t i : candidates) {
    if (reaches(all[i].primitive, from) && reaches(all[i].primitive, to)) kept.push_back(i);
  }
  return kept;
}

// --- The picture -----------------------------------------------------------------------------

class Renderer {
 public:
  Renderer(const Scene& scene, const View& view) : scene_(scene), view_(view) {
    for (const Primitive& p : scene.primitives) prepared_.push_back(prepare(p));
    for (const CsgToken& token : scene.model.tokens()) {
      if (token.is_primitive) used_.push_back(token.value);
    }
    thickness_ = Real(kReferenceThickness) * reference_box(scene).diagonal();
  }

  Image render() {
    const size_t pixels = size_t(view_.width_px) * view_.height_px;
    image_.width_px = view_.width_px;
    image_.height_px = view_.height_px;
    image_.rgb.assign(pixels, {0, 0, 0});
    image_.z.assign(pixels, std::numeric_limits<float>::infinity());
    image_.normal.assign(pixels, glm::vec3(0));
    image_.position.assign(pixels, glm::vec3(0));
    image_.id.assign(pixels, kNoPrimitive);
    std::vector<std::thread> threads(std::max(1u, std::thread::hardware_concurrency()));
    for (std::thread& thread : threads) thread = std::thread([this] { Worker(*this).work(); });
    for (std::thread& thread : threads) thread.join();
    return std::move(image_);
  }

 private:
  /// What one thread needs of its own.
  struct Worker {
    explicit Worker(Renderer& renderer) : owner(renderer), alive(owner.prepared_.size(), 0) {}
    void work();
    void draw_block(std::span<const uint32_t> band, PixelRange rows, PixelRange columns);
    void evaluate(std::span<const CsgToken> tokens, const Ray& ray);
    void regularise(const Ray& ray);
    Real thickness(const Crossing& a, const Crossing& b, const Ray& ray) const;
    void draw_pixel(uint32_t x, uint32_t y, const Ray& ray);

    Renderer& owner;
    Sweep sweep;
    std::vector<uint8_t> alive;
    std::vector<Piece> pieces;     // the stack's lists, one after the other
    std::vector<uint32_t> starts;  // where each list begins
  };

  Ray ray(uint32_t x, uint32_t y) const {
    const double h = view_.height_px;
    const double u = (2 * (x + 0.5) - view_.width_px) / h * view_.half_height;
    const double v = (h - 2 * (y + 0.5)) / h * view_.half_height;
    const Vec3 offset = u * view_.right + v * view_.up;
    if (view_.projection == Projection::kOrthographic) return {view_.eye + offset, view_.forward};
    return {view_.eye, view_.forward + offset};
  }

  const Scene& scene_;
  const View& view_;
  std::vector<Prepared> prepared_;
  std::vector<uint32_t> used_;
  Real thickness_ = 0;
  Image image_;
  std::atomic<uint32_t> next_row_{0};
};

void Renderer::Worker::work() {
  const View& view = owner.view_;
  for (;;) {
    const uint32_t y = owner.next_row_.fetch_add(kBlockPx);
    if (y >= view.height_px) return;
    const PixelRange rows{y, std::min(y + kBlockPx, view.height_px)};
    const std::vector<uint32_t> band = cull(owner.prepared_, owner.used_, view, true, rows);
    for (uint32_t x = 0; x < view.width_px; x += kBlockPx) {
      draw_block(band, rows, {x, std::min(x + kBlockPx, view.width_px)});
    }
  }
}

void Renderer::Worker::draw_block(std::span<const uint32_t> band, PixelRange rows,
                                  PixelRange columns) {
  const std::vector<uint32_t> kept = cull(owner.prepared_, band, owner.view_, false, columns);
  if (kept.empty()) return;
  for (const uint32_t i : kept) alive[i] = 1;
  const std::vector<CsgToken> tokens = reduce(owner.scene_.model.tokens(), alive);
  for (const uint32_t i : kept) alive[i] = 0;
  for (uint32_t y = rows.begin; y < rows.end; ++y) {
    for (uint32_t x = columns.begin; x < columns.end; ++x) {
      const Ray ray = owner.ray(x, y);
      evaluate(tokens, ray);
      regularise(ray);
      draw_pixel(x, y, ray);
    }
  }
}

/// Leaves the solid's pieces along the ray in `pieces`.
void Renderer::Worker::evaluate(std::span<const CsgToken> tokens, const Ray& ray) {
  pieces.clear();
  starts.clear();
  for (const CsgToken& token : tokens) {
    if (token.is_primitive) {
      starts.push_back(uint32_t(pieces.size()));
      cross(owner.prepared_[token.value], token.value, ray, pieces);
      continue;
    }
    const size_t first = starts.size() - token.value;
    const uint32_t begin = starts[first];
    const std::span<const Piece> combined =
        sweep.combine(token.op, std::span(pieces).subspan(begin), std::span(starts).subspan(first));
    pieces.resize(begin);
    pieces.insert(pieces.end(), combined.begin(), combined.end());
    starts.resize(first + 1);
  }
}

/// How far two crossings lie apart along the normal at the end where the ray is more oblique.
Real Renderer::Worker::thickness(const Crossing& a, const Crossing& b, const Ray& ray) const {
  const LongVec3 along = (b.t - a.t) * LongVec3(ray.direction);
  const auto at = [&](const Crossing& c) {
    return std::abs(glm::dot(along, primitive_normal(owner.prepared_[c.primitive], c, ray)));
  };
  return std::min(at(a), at(b));
}

/// Closes gaps and then drops pieces that are too thin to exist.
void Renderer::Worker::regularise(const Ray& ray) {
  size_t kept = 0;
  for (const Piece& piece : pieces) {
    if (kept > 0 && thickness(pieces[kept - 1].end, piece.begin, ray) < owner.thickness_) {
      pieces[kept - 1].end = piece.end;
    } else {
      pieces[kept++] = piece;
    }
  }
  pieces.resize(kept);
  std::erase_if(pieces, [&](const Piece& piece) {
    return thickness(piece.begin, piece.end, ray) < owner.thickness_;
  });
}

void Renderer::Worker::draw_pixel(uint32_t x, uint32_t y, const Ray& ray) {
  const bool orthographic = owner.view_.projection == Projection::kOrthographic;
  const Crossing* hit = nullptr;
  bool leaves = false;  // the ray leaves the solid here: the eye is inside
  for (const Piece& piece : pieces) {
    if (!orthographic && !(piece.end.t > 0)) continue;
    leaves = !orthographic && !(piece.begin.t > 0);
    hit = leaves ? &piece.end : &piece.begin;
    break;
  }
  if (!hit) return;
  // A crossing that enters the primitive where the ray enters the solid shows the primitive's own
  // outside; otherwise the primitive is a subtracted one and the solid's outside is its inside.
  const LongVec3 own = primitive_normal(owner.prepared_[hit->primitive], *hit, ray);
  const LongVec3 normal = hit->enters_primitive != leaves ? own : -own;
  const size_t i = size_t(y) * owner.view_.width_px + x;
  Image& image = owner.image_;
  image.rgb[i] = {255, 255, 255};
  image.z[i] = float(hit->t);
  image.normal[i] = glm::vec3(normal);
  image.position[i] = glm::vec3(LongVec3(ray.origin) + hit->t * LongVec3(ray.direction));
  image.id[i] = owner.prepared_[hit->primitive].primitive.id;
}

Box primitive_box(const Primitive& p) {
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 direction(0.0);
    direction[axis] = 1;
    box.max[axis] = extent(p, Vec3(0.0), direction);
    box.min[axis] = -extent(p, Vec3(0.0), -direction);
  }
  return box;
}

}  // namespace

Image reference_render(const Scene& scene, const View& view) {
  return Renderer(scene, view).render();
}

Box reference_box(const Scene& scene) {
  std::vector<Box> stack;
  for (const CsgToken& token : scene.model.tokens()) {
    if (token.is_primitive) {
      stack.push_back(primitive_box(scene.primitives[token.value]));
      continue;
    }
    const size_t first = stack.size() - token.value;
    Box box = stack[first];
    for (size_t i = first + 1; i < stack.size(); ++i) {
      if (token.op == Op::kUnion) box.merge(stack[i]);
      if (token.op == Op::kIntersection) {
        box.min = glm::max(box.min, stack[i].min);
        box.max = glm::min(box.max, stack[i].max);
      }
    }
    stack.resize(first);
    stack.push_back(box.empty() ? Box{} : box);
  }
  return stack.empty() ? Box{} : stack.front();
}

std::vector<bool> subtracted_primitives(const Scene& scene) {
  // From the last token backwards a postfix tree is met from the root down, last operand first, so
  // a stack of what each open operation still expects gives every primitive's depth.
  struct Open {
    uint32_t operands_left;
    bool difference, subtracted;
  };
  std::vector<bool> result(scene.primitives.size(), false);
  std::vector<Open> open;
  const auto tokens = scene.model.tokens();
  for (size_t i = tokens.size(); i-- > 0;) {
    bool subtracted = false;
    if (!open.empty()) {
      Open& parent = open.back();
      subtracted = parent.subtracted != (parent.difference && parent.operands_left > 1);
      if (--parent.operands_left == 0) open.pop_back();
    }
    if (tokens[i].is_primitive) {
      result[tokens[i].value] = subtracted;
    } else {
      open.push_back({tokens[i].value, tokens[i].op == Op::kDifference, subtracted});
    }
  }
  return result;
}

void reference_shade_phong(Image& image, const Scene& scene, const View& view,
                           const PhongLight& light, const ReferenceColors& colors) {
  const std::vector<bool> subtracted = subtracted_primitives(scene);
  uint32_t ids = 0;
  for (const Primitive& p : scene.primitives) ids = std::max(ids, p.id + 1);
  std::vector<Vec3> base(ids, Vec3(0.0));
  for (size_t i = 0; i < scene.primitives.size(); ++i) {
    const Primitive& p = scene.primitives[i];
    base[p.id] = p.color ? Vec3(p.color->r, p.color->g, p.color->b)
                         : (subtracted[i] ? colors.back : colors.front);
  }
  const bool orthographic = view.projection == Projection::kOrthographic;
  for (size_t i = 0; i < image.rgb.size(); ++i) {
    Vec3 color = colors.background;
    if (image.id[i] != kNoPrimitive) {
      const Vec3 position(image.position[i]);
      const Vec3 direction = orthographic ? view.forward : position - view.eye;
      color = phong_color(base[image.id[i]], position, Vec3(image.normal[i]), direction, light);
    }
    for (int c = 0; c < 3; ++c) image.rgb[i][c] = uint8_t(std::lround(255 * color[c]));
  }
}

}  // namespace csgcore
