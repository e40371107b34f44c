#include "reference_walk.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

namespace csgcore::reference {

namespace {

/// See Reference::displacement. Each coordinate of a point near the model is rounded to the spacing
/// of the doubles there; so are the middle of a primitive and the point of a ray that is compared
/// with it.
Real displacement_of(const Box& box) {
  constexpr Real kSpacing = std::numeric_limits<double>::epsilon();
  Real coordinates = 0;
  for (int i = 0; i < 3 && !box.empty(); ++i) {
    coordinates = std::max({coordinates, Real(std::abs(box.min[i])), Real(std::abs(box.max[i]))});
  }
  return Real(kReferenceDisplacement) * box.diagonal() + 2 * kSpacing * coordinates;
}

}  // namespace

RaySetup::RaySetup(const Scene& rays_scene, const View& rays_view)
    : scene(rays_scene), view(rays_view), subtracted(subtracted_primitives(rays_scene)) {
  const Box box = reference_box(scene);
  model_size = box.diagonal();
  thickness = Real(kReferenceThickness) * model_size;
  displacement = displacement_of(box);
  if (!box.empty()) pivot = box.center();
  pivot_s = glm::dot(pivot - view.eye, view.forward);
  first_t = view.projection == Projection::kOrthographic ? -std::numeric_limits<Real>::infinity()
                                                         : thickness - Real(pivot_s);
  for (const Primitive& p : scene.primitives) targets.emplace_back(p, pivot);
}

NearRay near_ray(const RaySetup& setup, double x_px, double y_px) {
  const View& view = setup.view;
  const double h = view.height_px;
  const double u = (2 * (x_px + 0.5) - view.width_px) / h * view.half_height;
  const double v = (h - 2 * (y_px + 0.5)) / h * view.half_height;
  const Vec3 lateral = u * view.right + v * view.up;
  const bool orthographic = view.projection == Projection::kOrthographic;
  const Vec3 origin = orthographic ? view.eye + lateral : view.eye;
  const Vec3 direction = orthographic ? view.forward : view.forward + lateral;
  return {exact_offset(origin, setup.pivot_s, direction, setup.pivot), LongVec3(direction)};
}

ReferenceHit RayWalk::hit(const NearRay& ray, std::span<const uint32_t> candidates,
                          Boundary boundary) {
  ray_ = &ray;
  collect(candidates);
  passed_ = 0;
  while (passed_ < crossings_.size() && !(crossings_[passed_].t > setup_.first_t)) pass();
  ReferenceHit result;
  int turns_before = boundary == Boundary::kFirst ? 0 : 1;
  size_t begin = passed_;
  for (size_t first = next_boundary(begin); first < crossings_.size();) {
    const Coincidence coincidence = cluster_of(begin, first);
    if (coincidence.turns && turns_before-- == 0) {
      result = describe(shown(coincidence));
      break;
    }
    begin = coincidence.last + 1;
    first = coincidence.end;
  }
  pass_until(0);
  return result;
}

void RayWalk::collect(std::span<const uint32_t> candidates) {
  crossings_.clear();
  for (const uint32_t slot : candidates) {
    spans_.clear();
    setup_.targets[slots()[slot]].add_spans(*ray_, setup_.thickness, spans_);
    for (const Span& span : spans_) {
      crossings_.push_back({span.begin, slot, span.begin_surface, true});
      crossings_.push_back({span.end, slot, span.end_surface, false});
    }
  }
  std::sort(crossings_.begin(), crossings_.end(), [](const Crossing& a, const Crossing& b) {
    return a.t != b.t ? a.t < b.t : a.slot < b.slot;
  });
}

void RayWalk::pass() { tree_.flip(crossings_[passed_++].slot); }

void RayWalk::pass_until(size_t count) {
  while (passed_ < count) pass();
  while (passed_ > count) tree_.flip(crossings_[--passed_].slot);
}

/// Returns the first crossing from `from` on that changes the solid's value.
size_t RayWalk::next_boundary(size_t from) {
  pass_until(from);
  const bool value = tree_.value();
  while (passed_ < crossings_.size()) {
    pass();
    if (tree_.value() != value) return passed_ - 1;
  }
  return crossings_.size();
}

RayWalk::Coincidence RayWalk::cluster_of(size_t begin, size_t first) {
  Coincidence coincidence{begin, first, first, crossings_.size(), true};
  for (;;) {
    coincidence.end = next_boundary(coincidence.last + 1);
    if (coincidence.end == crossings_.size() ||
        !together(crossings_[coincidence.last], crossings_[coincidence.end])) {
      return coincidence;
    }
    coincidence.last = coincidence.end;
    coincidence.turns = !coincidence.turns;
  }
}

const RayTarget& RayWalk::target(const Crossing& crossing) const {
  return setup_.targets[slots()[crossing.slot]];
}

bool RayWalk::is_subtracted(const Crossing& crossing) const {
  return setup_.subtracted[slots()[crossing.slot]];
}

LongVec3 RayWalk::normal(const Crossing& crossing) const {
  return target(crossing).normal(*ray_, crossing.t, crossing.surface);
}

/// Returns how squarely the ray meets the surface: the thickness per unit of t.
Real RayWalk::steepness(const Crossing& crossing) const {
  return std::abs(glm::dot(normal(crossing), ray_->direction));
}

bool RayWalk::together(const Crossing& a, const Crossing& b) const {
  const Real gap = std::abs(b.t - a.t);
  // No surface is met more squarely than |d|, so that crossings this near need no normals.
  if (gap * glm::length(ray_->direction) < setup_.thickness) return true;
  return gap * steepness(a) < setup_.thickness && gap * steepness(b) < setup_.thickness;
}

/// Collects the crossings by which a coincidence changes the primitives. The tree is left as it is
/// after all of them.
void RayWalk::collect_changes(const Coincidence& coincidence) {
  const auto place = [this](size_t i) { return crossings_.begin() + long(i); };
  changed_.assign(place(coincidence.first), place(coincidence.last + 1));
  // No crossing further than this from the first or the last one is coincident with it.
  const Crossing &first = crossings_[coincidence.first], &last = crossings_[coincidence.last];
  const Real before = setup_.thickness / steepness(first);
  const Real after = setup_.thickness / steepness(last);
  for (size_t i = coincidence.first;
       i-- > coincidence.begin && first.t - crossings_[i].t < before;) {
    if (together(first, crossings_[i])) changed_.push_back(crossings_[i]);
  }
  size_t end = coincidence.last + 1;
  for (size_t i = end; i < coincidence.end && crossings_[i].t - last.t < after; ++i) {
    if (!together(last, crossings_[i])) continue;
    changed_.push_back(crossings_[i]);
    end = i + 1;
  }
  pass_until(end);
  drop_what_came_back();
}

/// Drops the primitives that are left as often as they are entered, which have not changed. Keeps
/// the first crossing of each of the others.
void RayWalk::drop_what_came_back() {
  std::sort(changed_.begin(), changed_.end(), [](const Crossing& a, const Crossing& b) {
    return a.slot != b.slot ? a.slot < b.slot : a.t < b.t;
  });
  std::vector<Crossing> kept;
  for (auto run = changed_.begin(); run != changed_.end();) {
    const auto next = std::find_if(
        run, changed_.end(), [&](const Crossing& crossing) { return crossing.slot != run->slot; });
    if ((next - run) % 2 != 0) kept.push_back(*run);
    run = next;
  }
  changed_ = std::move(kept);
}

/// Returns the crossing that a coincidence which turns the value shows.
const RayWalk::Crossing& RayWalk::shown(const Coincidence& coincidence) {
  collect_changes(coincidence);
  if (changed_.size() == 1) return changed_.front();
  has_changed_.assign(slots().size(), 0);
  for (const Crossing& crossing : changed_) has_changed_[crossing.slot] = 1;
  const uint32_t slot = tree_.turning_slot(has_changed_);
  const auto seen =
      std::find_if(changed_.begin(), changed_.end(),
                   [slot](const Crossing& crossing) { return crossing.slot == slot; });
  return seen != changed_.end() ? *seen : crossings_[coincidence.first];
}

ReferenceHit RayWalk::describe(const Crossing& crossing) const {
  const LongVec3 own = normal(crossing);
  return {slots()[crossing.slot], Real(setup_.pivot_s) + crossing.t,
          LongVec3(setup_.pivot) + (ray_->origin + crossing.t * ray_->direction),
          is_subtracted(crossing) ? -own : own};
}

}  // namespace csgcore::reference
