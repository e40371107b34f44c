#include "reference.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <span>
#include <thread>

#include "reference_primitive.hpp"
#include "reference_tree.hpp"
#include "reference_walk.hpp"

namespace csgcore {
namespace {

using reference::HalfSpace;
using reference::RaySetup;
using reference::RayWalk;

/// Pixels per side of the blocks for which the tree is reduced to what their rays can meet, and of
/// the blocks within these for which the primitives are culled once more.
constexpr uint32_t kBlockPx = 16;
constexpr uint32_t kSmallBlockPx = 4;

struct PixelRange {
  uint32_t begin, end;
};

/// Returns the half-space of growing pixel coordinates beyond the line x = `px` (or y = `px`), or,
/// if `below`, the opposite one.
HalfSpace half_space(const View& view, bool vertical, double px, bool below) {
  const double size = vertical ? view.height_px : view.width_px;
  const double offset = (2 * px - size) / view.height_px * view.half_height;
  const Vec3 axis = vertical ? -view.up : view.right;
  const double sign = below ? -1 : 1;
  if (view.projection == Projection::kOrthographic) return {view.eye + offset * axis, sign * axis};
  return {view.eye, sign * (axis - offset * view.forward)};
}

/// Returns those items whose primitives the rays of a range of rows or columns can meet.
template <typename PrimitiveOf>
std::vector<uint32_t> cull(std::span<const uint32_t> items, PrimitiveOf&& primitive_of,
                           const View& view, bool vertical, PixelRange range) {
  const HalfSpace from = half_space(view, vertical, range.begin, false);
  const HalfSpace to = half_space(view, vertical, range.end, true);
  std::vector<uint32_t> kept;
  for (const uint32_t item : items) {
    const Primitive& p = primitive_of(item);
    if (reference::reaches(p, from) && reference::reaches(p, to)) kept.push_back(item);
  }
  return kept;
}

}  // namespace

// --- The picture -----------------------------------------------------------------------------

class Reference::Impl {
 public:
  Impl(const Scene& scene, const View& view) : setup_(scene, view) {
    used_ = reference::primitives_of(scene.model.tokens());
  }

  const RaySetup& setup() const { return setup_; }
  const View& view() const { return setup_.view; }

  std::vector<ReferenceHit> render() {
    picture_.assign(size_t{view().width_px} * view().height_px, {});
    next_row_ = 0;
    std::vector<std::thread> threads(std::max(1u, std::thread::hardware_concurrency()));
    for (std::thread& thread : threads) thread = std::thread([this] { draw_bands(); });
    for (std::thread& thread : threads) thread.join();
    return std::move(picture_);
  }

 private:
  const Primitive& primitive(uint32_t index) const { return setup_.scene.primitives[index]; }

  void draw_bands() {
    std::vector<uint8_t> alive(setup_.scene.primitives.size(), 0);
    for (;;) {
      const uint32_t y = next_row_.fetch_add(kBlockPx);
      if (y >= view().height_px) return;
      const PixelRange rows{y, std::min(y + kBlockPx, view().height_px)};
      const auto primitive_of = [this](uint32_t i) -> const Primitive& { return primitive(i); };
      const std::vector<uint32_t> band = cull(used_, primitive_of, view(), true, rows);
      for (uint32_t x = 0; x < view().width_px; x += kBlockPx) {
        const PixelRange columns{x, std::min(x + kBlockPx, view().width_px)};
        draw_block(cull(band, primitive_of, view(), false, columns), rows, columns, alive);
      }
    }
  }

  void draw_block(const std::vector<uint32_t>& kept, PixelRange rows, PixelRange columns,
                  std::vector<uint8_t>& alive) {
    if (kept.empty()) return;
    for (const uint32_t i : kept) alive[i] = 1;
    RayWalk walk(setup_, reference::reduce(setup_.scene.model.tokens(), alive));
    for (const uint32_t i : kept) alive[i] = 0;
    std::vector<uint32_t> slots(walk.slots().size());
    std::iota(slots.begin(), slots.end(), 0u);
    const auto primitive_of = [&](uint32_t slot) -> const Primitive& {
      return primitive(walk.slots()[slot]);
    };
    for (uint32_t y = rows.begin; y < rows.end; y += kSmallBlockPx) {
      const PixelRange some_rows{y, std::min(y + kSmallBlockPx, rows.end)};
      const auto band = cull(slots, primitive_of, view(), true, some_rows);
      for (uint32_t x = columns.begin; x < columns.end; x += kSmallBlockPx) {
        const PixelRange some_columns{x, std::min(x + kSmallBlockPx, columns.end)};
        const auto few = cull(band, primitive_of, view(), false, some_columns);
        draw_pixels(walk, few, some_rows, some_columns);
      }
    }
  }

  void draw_pixels(RayWalk& walk, std::span<const uint32_t> slots, PixelRange rows,
                   PixelRange columns) {
    for (uint32_t y = rows.begin; y < rows.end; ++y) {
      for (uint32_t x = columns.begin; x < columns.end; ++x) {
        picture_[size_t{y} * view().width_px + x] =
            walk.hit(reference::near_ray(setup_, x, y), slots);
      }
    }
  }

  const RaySetup setup_;
  std::vector<uint32_t> used_;  // primitives that the model names
  std::vector<ReferenceHit> picture_;
  std::atomic<uint32_t> next_row_{0};
};

Reference::Reference(const Scene& scene, const View& view)
    : impl_(std::make_unique<Impl>(scene, view)) {}
Reference::~Reference() = default;

std::vector<ReferenceHit> Reference::picture() const { return impl_->render(); }

double Reference::model_size() const { return impl_->setup().model_size; }

namespace {

/// Traces all rays of one pixel, without culling.
class Probe {
 public:
  explicit Probe(const RaySetup& setup)
      : setup_(setup), walk_(setup, setup.scene.model.tokens()), slots_(walk_.slots().size()) {
    std::iota(slots_.begin(), slots_.end(), 0u);
  }

  ReferenceHit operator()(double x_px, double y_px, const LongVec3& shift,
                          Boundary boundary = Boundary::kFirst) {
    reference::NearRay ray = reference::near_ray(setup_, x_px, y_px);
    ray.origin += shift;
    return walk_.hit(ray, slots_, boundary);
  }

 private:
  const RaySetup& setup_;
  RayWalk walk_;
  std::vector<uint32_t> slots_;
};

}  // namespace

ReferenceHit Reference::at(double x_px, double y_px, const LongVec3& shift) const {
  return Probe(impl_->setup())(x_px, y_px, shift);
}

ReferenceHit Reference::behind(double x_px, double y_px) const {
  return Probe(impl_->setup())(x_px, y_px, LongVec3(0), Boundary::kBehind);
}

Real Reference::displacement() const { return impl_->setup().displacement; }

bool Reference::undecided(uint32_t x_px, uint32_t y_px) const {
  const View& view = impl_->view();
  Probe probe(impl_->setup());
  const ReferenceHit own = probe(x_px, y_px, LongVec3(0));
  const Real far = Real(kReferencePositionError) * impl_->setup().model_size;
  const auto differs = [&](const LongVec3& shift) {
    const ReferenceHit other = probe(x_px, y_px, impl_->setup().displacement * shift);
    if (other.primitive != own.primitive) return true;
    return own.hit() && (glm::length(other.position - own.position) > far ||
                         glm::length(other.normal - own.normal) > Real(kReferenceNormalError));
  };
  const LongVec3 right(view.right), up(view.up), forward(view.forward);
  constexpr Real kDiagonal = 0.7071067811865475244L;
  for (const Real x : {-1, 0, 1}) {
    for (const Real y : {-1, 0, 1}) {
      const Real scale = x != 0 && y != 0 ? kDiagonal : 1;
      if ((x != 0 || y != 0) && differs(scale * (x * right + y * up))) return true;
    }
  }
  return view.projection == Projection::kPerspective && (differs(forward) || differs(-forward));
}

Image reference_render(const Scene& scene, const View& view) {
  const std::vector<ReferenceHit> hits = Reference(scene, view).picture();
  Image image;
  image.width_px = view.width_px;
  image.height_px = view.height_px;
  image.rgb.assign(hits.size(), {0, 0, 0});
  image.z.assign(hits.size(), std::numeric_limits<float>::infinity());
  image.normal.assign(hits.size(), glm::vec3(0));
  image.position.assign(hits.size(), glm::vec3(0));
  image.id.assign(hits.size(), kNoPrimitive);
  for (size_t i = 0; i < hits.size(); ++i) {
    if (!hits[i].hit()) continue;
    image.rgb[i] = {255, 255, 255};
    image.z[i] = float(hits[i].s);
    image.normal[i] = glm::vec3(hits[i].normal);
    image.position[i] = glm::vec3(hits[i].position);
    image.id[i] = scene.primitives[hits[i].primitive].id;
  }
  return image;
}

}  // namespace csgcore
