#include "exact_walk.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "exact_mesh.hpp"
#include "exact_profile.hpp"

namespace oracle {
namespace {

using csgcore::Projection;
using csgcore::Vec3;

}  // namespace

ExactWalk::Shown ExactWalk::see(const SeenRay& ray) {
  ++counts_.rays;
  set_ray(ray);
  collect();
  evaluate();
  Shown shown;
  if (const std::optional<Coincidence> coincidence = first_turning_coincidence()) {
    shown = describe(shown_of(*coincidence));
  }
  pass_until(0);
  return shown;
}

// --- The ray's crossings ---

void ExactWalk::set_ray(const SeenRay& ray) {
  seen_ = ray;
  unsettled_ = false;
  const Vec3 &origin = ray.ray.origin, &direction = ray.ray.direction;
  base_s_ = glm::dot(scene_.pivot - origin, direction) / glm::dot(direction, direction);
  const Exact unit(scene_.unit);
  for (int i = 0; i < 3; ++i) {
    exact_ray_.direction[i] = unit * Exact(direction[i]);
    exact_ray_.origin[i] = Exact(base_s_) * exact_ray_.direction[i] +
                           unit * (Exact(origin[i]) - Exact(scene_.pivot[i]) + Exact(ray.shift[i]));
    ray_.direction[i] = Interval(scene_.unit * direction[i]);
    ray_.origin[i] = enclose(exact_ray_.origin[i]);
  }
  exact_eye_t_ = Exact(ray.thickness) - Exact(base_s_);
  eye_t_ = enclose(exact_eye_t_);
}

void ExactWalk::collect() {
  const bool from_eye = seen_.projection == Projection::kPerspective;
  scene_.boxes.find(middle(ray_.origin), middle(ray_.direction),
                    from_eye ? eye_t_.inf() : -kInfinity, items_);
  candidates_.clear();
  crossings_.clear();
  for (const uint32_t item : items_) add_candidates(scene_.boxed[item]);
  for (uint32_t i = 0; i < candidates_.size(); ++i) {
    crossings_.push_back({i, false});
    crossings_.push_back({i, true});
  }
  std::sort(crossings_.begin(), crossings_.end(), [this](const Crossing& a, const Crossing& b) {
    const int sign = order(a, b);
    return sign != 0 ? sign < 0 : primitive_of(a) < primitive_of(b);
  });
}

void ExactWalk::add_candidates(uint32_t primitive) {
  const Target<Interval>& target = scene_.intervals[primitive];
  if (target.mesh) return add_mesh_candidates(primitive);
  if (target.profile) return add_profile_candidates(primitive);
  ++counts_.segments;
  Candidate candidate{primitive, 0, {}, base_of(target, ray_), {}, {}, {}, {}};
  candidate.local = localize(target, ray_, candidate.base);
  if (!near_planes_.find(target, candidate.local)) return;
  std::optional<Ends> ends;
  try {
    ends = ends_of(target, candidate.local, near_planes_.planes());
    if (!ends) return;
    candidate.ends = *ends;
    find_ends(candidate);
  } catch (const Undecided&) {
    candidate.exact = localize(scene_.exact[primitive], exact_ray_, 0);
    ends = ends_of(scene_.exact[primitive], *candidate.exact, near_planes_.planes());
    ++counts_.exact_segments;
    if (!ends) return;
    candidate.ends = *ends;
    find_ends(candidate);
  }
  candidates_.push_back(std::move(candidate));
}

/// Which triangles the ray passes is decided exactly, so that the exact ray is there anyway.
void ExactWalk::add_mesh_candidates(uint32_t primitive) {
  const Target<Exact>& target = scene_.exact[primitive];
  const Target<Interval>& enclosed = scene_.intervals[primitive];
  const std::vector<Ends> segments = mesh_segments(
      target, enclosed, exact_ray_, base_of(enclosed, ray_), scene_.unit * seen_.thickness);
  if (segments.empty()) return;
  const LocalRay<Exact> exact = localize(target, exact_ray_, 0);
  for (uint32_t i = 0; i < segments.size(); ++i) {
    ++counts_.segments;
    candidates_.push_back({primitive, i, segments[i], 0, {}, {}, {}, exact});
    find_ends(candidates_.back());
  }
}

void ExactWalk::add_profile_candidates(uint32_t primitive) {
  const Target<Exact>& target = scene_.exact[primitive];
  const double base = base_of(scene_.intervals[primitive], ray_);
  const std::vector<ProfileSegment> segments =
      target.profile->segments(localize(target, exact_ray_, base));
  if (segments.empty()) return;
  const LocalRay<Exact> exact = localize(target, exact_ray_, 0);
  for (uint32_t i = 0; i < segments.size(); ++i) {
    ++counts_.segments;
    const auto& [begin, end] = segments[i];
    Candidate candidate{primitive, i, {begin.surface, end.surface}, 0, {}, {}, {}, exact};
    candidate.found = {moved(begin.t, base), moved(end.t, base)};
    candidate.error = begin.error;
    find_ends(candidate);
    candidates_.push_back(std::move(candidate));
  }
}

/// Finds the parameters of the ends, from the exact ray if there is one.
void ExactWalk::find_ends(Candidate& candidate) {
  const Surface surfaces[2] = {candidate.ends.begin, candidate.ends.end};
  if (candidate.exact) {
    candidate.base = 0;
    candidate.local = enclose(*candidate.exact);
  }
  for (const bool at_end : {false, true}) {
    if (candidate.found) {
      const Interval error(-candidate.error, candidate.error);
      candidate.u[at_end] = candidate.t[at_end] = enclose((*candidate.found)[at_end].p) + error;
      continue;
    }
    candidate.u[at_end] =
        candidate.exact ? enclose_crossing(scene_.exact[candidate.primitive], *candidate.exact,
                                           candidate.local, surfaces[at_end], !at_end)
                        : crossing_of(scene_.intervals[candidate.primitive], candidate.local,
                                      surfaces[at_end], !at_end);
    if (at_end) candidate.u[at_end] += Interval(candidate.ends.beyond);
    candidate.t[at_end] = Interval(candidate.base) + candidate.u[at_end];
  }
}

/// Makes the parameters as tight as doubles allow.
void ExactWalk::refine(Candidate& candidate) {
  if (candidate.exact) return;
  ++counts_.exact_segments;
  candidate.exact = localize(scene_.exact[candidate.primitive], exact_ray_, 0);
  find_ends(candidate);
}

Surface ExactWalk::surface_of(const Crossing& crossing) const {
  const Ends& ends = candidates_[crossing.candidate].ends;
  return crossing.at_end ? ends.end : ends.begin;
}

ExactRoot ExactWalk::exact_of(const Crossing& crossing) const {
  const Candidate& candidate = candidates_[crossing.candidate];
  if (candidate.found) return (*candidate.found)[crossing.at_end];
  const ExactRoot met = crossing_of(scene_.exact[candidate.primitive], *candidate.exact,
                                    surface_of(crossing), !crossing.at_end);
  return moved(met, beyond_of(crossing));
}

/// Returns −1 if `a` comes first, 0 if both have the same parameter, 1 otherwise.
int ExactWalk::order(const Crossing& a, const Crossing& b) {
  if (a.candidate == b.candidate) return int(a.at_end) - int(b.at_end);
  ++counts_.comparisons;
  const auto sure = CGAL::compare(t_of(a), t_of(b));
  if (CGAL::is_certain(sure)) return CGAL::get_certain(sure);
  const auto alike = [this](const Crossing& c) {
    return std::pair(scene_.first_alike[primitive_of(c)], candidates_[c.candidate].segment);
  };
  if (a.at_end == b.at_end && alike(a) == alike(b)) return 0;
  refine(candidates_[a.candidate]);
  refine(candidates_[b.candidate]);
  const auto refined = CGAL::compare(t_of(a), t_of(b));
  if (CGAL::is_certain(refined)) return CGAL::get_certain(refined);
  ++counts_.exact_comparisons;
  // Crossings that differ by less than the error are taken for equal.
  const double error = candidates_[a.candidate].error + candidates_[b.candidate].error;
  if (error == 0) return compare(exact_of(a), exact_of(b));
  if (compare(moved(exact_of(a), error), exact_of(b)) < 0) return -1;
  return compare(moved(exact_of(a), -error), exact_of(b)) > 0 ? 1 : 0;
}

bool ExactWalk::is_behind_eye(const Crossing& crossing) {
  if (seen_.projection == Projection::kOrthographic) return false;
  ++counts_.comparisons;
  const auto sure = CGAL::compare(t_of(crossing), eye_t_);
  if (CGAL::is_certain(sure)) return CGAL::get_certain(sure) <= 0;
  refine(candidates_[crossing.candidate]);
  ++counts_.exact_comparisons;
  return compare(exact_of(crossing), quotient(exact_eye_t_, 1)) <= 0;
}

// --- Coincidences ---

void ExactWalk::pass_until(size_t count) {
  while (passed_ < count) tree_.flip(primitive_of(crossings_[passed_++]));
  while (passed_ > count) tree_.flip(primitive_of(crossings_[--passed_]));
}

/// Finds the solid's value everywhere along the ray.
void ExactWalk::evaluate() {
  values_.assign(1, tree_.value());
  eye_ = 0;
  while (eye_ < crossings_.size() && is_behind_eye(crossings_[eye_])) ++eye_;
  while (passed_ < crossings_.size()) {
    pass_until(passed_ + 1);
    values_.push_back(tree_.value());
  }
}

std::optional<ExactWalk::Coincidence> ExactWalk::first_turning_coincidence() {
  const auto next_boundary = [this](size_t from) {
    while (from < crossings_.size() && values_[from + 1] == values_[from]) ++from;
    return from;
  };
  Coincidence coincidence{eye_, 0, 0, next_boundary(eye_)};
  while (coincidence.end < crossings_.size()) {
    coincidence.first = coincidence.last = coincidence.end;
    for (;;) {
      coincidence.end = next_boundary(coincidence.last + 1);
      if (coincidence.end == crossings_.size() ||
          !together(crossings_[coincidence.last], crossings_[coincidence.end])) {
        break;
      }
      coincidence.last = coincidence.end;
    }
    if (values_[coincidence.last + 1] != values_[eye_]) return coincidence;
    coincidence.begin = coincidence.last + 1;
  }
  return std::nullopt;
}

/// Returns |n·d| at the crossing.
Interval ExactWalk::steepness(const Crossing& crossing) const {
  const Candidate& candidate = candidates_[crossing.candidate];
  return steepness_at(scene_.intervals[candidate.primitive], candidate.local,
                      candidate.u[crossing.at_end], surface_of(crossing), !crossing.at_end);
}

/// Returns the distance along the normal of the surface that the ray meets more squarely, in the
/// prepared unit.
Interval ExactWalk::thickness_between(const Crossing& a, const Crossing& b) const {
  return CGAL::abs(t_of(b) - t_of(a)) * (CGAL::max)(steepness(a), steepness(b));
}

bool ExactWalk::together(const Crossing& a, const Crossing& b) {
  ++counts_.thicknesses;
  const double tolerance = scene_.unit * seen_.thickness;
  Interval thickness = thickness_between(a, b);
  if (!CGAL::is_certain(thickness < tolerance)) {
    refine(candidates_[a.candidate]);
    refine(candidates_[b.candidate]);
    thickness = thickness_between(a, b);
  }
  const auto sure = thickness < tolerance;
  if (CGAL::is_certain(sure)) return CGAL::get_certain(sure);
  ++counts_.unsettled_thicknesses;
  unsettled_ = true;
  return middle(thickness) < tolerance;
}

// --- What is shown ---

/// Collects the crossings by which a coincidence changes the primitives, in the order of the
/// primitives: its own, and those that coincide with its first or last boundary. Leaves the tree at
/// a point after all of them.
void ExactWalk::collect_changes(const Coincidence& coincidence) {
  changed_.clear();
  for (size_t i = coincidence.begin; i < coincidence.first; ++i) {
    if (together(crossings_[i], crossings_[coincidence.first])) changed_.push_back(crossings_[i]);
  }
  size_t end = coincidence.last + 1;
  for (size_t i = coincidence.first; i < end; ++i) changed_.push_back(crossings_[i]);
  for (size_t i = end; i < coincidence.end; ++i) {
    if (!together(crossings_[coincidence.last], crossings_[i])) continue;
    changed_.push_back(crossings_[i]);
    end = i + 1;
  }
  pass_until(end);
  drop_what_came_back();
}

/// Keeps the first crossing of each primitive that is crossed an odd number of times, and none of
/// others. The crossings must be in order along the ray.
void ExactWalk::drop_what_came_back() {
  std::stable_sort(changed_.begin(), changed_.end(), [this](const Crossing& a, const Crossing& b) {
    return primitive_of(a) < primitive_of(b);
  });
  std::vector<Crossing> kept;
  for (size_t begin = 0, end = 0; begin < changed_.size(); begin = end) {
    while (end < changed_.size() && primitive_of(changed_[end]) == primitive_of(changed_[begin])) {
      ++end;
    }
    if ((end - begin) % 2 == 1) kept.push_back(changed_[begin]);
  }
  changed_ = std::move(kept);
}

/// Returns whether the crossing can turn the value from that at the eye: if the eye is outside, by
/// entering an added primitive or leaving a subtracted one; if it is inside, the reverse.
bool ExactWalk::turns(const Crossing& crossing) const {
  const bool adds = crossing.at_end == bool(values_[eye_]);
  const uint32_t primitive = primitive_of(crossing);
  return adds ? tree_.is_added(primitive) : tree_.is_subtracted(primitive);
}

ExactWalk::Crossing ExactWalk::shown_of(const Coincidence& coincidence) {
  collect_changes(coincidence);
  if (changed_.size() == 1) return changed_.front();
  changed_primitives_.clear();
  for (const Crossing& crossing : changed_) changed_primitives_.push_back(primitive_of(crossing));
  const uint32_t shown = tree_.turning_primitive(changed_primitives_);
  const auto at = std::ranges::find(changed_primitives_, shown);
  if (at == changed_primitives_.end()) return crossings_[coincidence.first];
  return changed_[static_cast<size_t>(at - changed_primitives_.begin())];
}

ExactWalk::Shown ExactWalk::describe(const Crossing& crossing) const {
  const uint32_t primitive = primitive_of(crossing);
  const Target<Exact>& target = scene_.exact[primitive];
  const Surface surface = surface_of(crossing);
  const bool enters = !crossing.at_end;
  // Map the ray anew from a point next to the crossing, so that no precision is lost for a tiny
  // primitive.
  const double base = middle(t_of(crossing));
  const LocalRay<Exact> exact = localize(target, exact_ray_, base);
  const LocalRay<Interval> local = enclose(exact);
  const double beyond = beyond_of(crossing);
  const bool is_found = candidates_[crossing.candidate].found.has_value();
  const ExactRoot root = is_found ? moved(exact_of(crossing), -base)
                                  : moved(crossing_of(target, exact, surface, enters), beyond);
  const Interval u =
      is_found ? enclose(root.p)
               : enclose_crossing(target, exact, local, surface, enters) + Interval(beyond);
  Shown shown;
  shown.hit.primitive = primitive;
  shown.hit.s = tight_s(root, base, Interval(base_s_) + (Interval(base) + u));
  Vec3 normal = middle(normal_at(scene_.intervals[primitive], local, u, surface));
  // Which way a mesh faces makes no difference, nor a profile's direction.
  const bool is_against = glm::dot(normal, middle(ray_.direction)) < 0;
  if ((target.mesh || target.profile) && is_against != enters) normal = -normal;
  const Interval t = Interval(base) + u, unit(scene_.unit);
  for (int i = 0; i < 3; ++i) {
    const Interval offset = (ray_.origin[i] + t * ray_.direction[i]) / unit;
    shown.from_pivot[i] = middle(offset);
    shown.hit.position[i] = middle(Interval(scene_.pivot[i]) + offset);
  }
  // The normal outward of the solid points against the ray unless the eye is inside.
  const bool is_cut =
      turns(crossing) ? enters == bool(values_[eye_]) : tree_.is_subtracted(primitive);
  shown.hit.normal = (is_cut ? -1.0 : 1.0) * glm::normalize(normal);
  return shown;
}

/// Returns the doubles next to base_s + base + u, which lies within `s`.
Bounds ExactWalk::tight_s(const ExactRoot& u, double base, const Interval& s) const {
  const Exact zero_s = Exact(base_s_) + Exact(base);
  const auto sign_at = [&](double at) { return compare(u, quotient(Exact(at) - zero_s, 1)); };
  Bounds bounds{s.inf(), s.sup()};
  while (std::nextafter(bounds.lower, kInfinity) < bounds.upper) {
    double half = bounds.lower + (bounds.upper - bounds.lower) / 2;
    if (bounds.lower < 0 && bounds.upper > 0) half = 0;
    if (half == bounds.upper) half = std::nextafter(bounds.lower, kInfinity);  // it was rounded up
    const int sign = sign_at(half);
    if (sign >= 0) bounds.lower = half;
    if (sign <= 0) bounds.upper = half;
  }
  if (bounds.lower < bounds.upper) {
    if (sign_at(bounds.lower) == 0) bounds.upper = bounds.lower;
    if (sign_at(bounds.upper) == 0) bounds.lower = bounds.upper;
  }
  return bounds;
}

}  // namespace oracle
