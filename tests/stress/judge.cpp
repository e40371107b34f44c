#include "judge.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <sstream>

namespace stress {

using csgcore::Hits;
using csgcore::Vec3;
using oracle::Bounds;
using oracle::Doubt;
using oracle::ExactHit;

namespace {

/// The oracle takes long to judge doubts; in a picture that is all wrong, this many are enough.
constexpr uint64_t kMostQuestions = 500;

constexpr size_t kMostListed = 20;  // undecided pixels listed per picture

struct Errors {
  double position, normal, s;
};

/// Returns nan for nan.
double distance(double x, const Bounds& bounds) {
  return x < bounds.lower ? bounds.lower - x : x > bounds.upper ? x - bounds.upper : x - x;
}

Errors errors_of(const ExactHit& expected, const Hits& picture, size_t i) {
  return {glm::length(picture.position[i] - expected.position),
          glm::length(picture.normal[i] - expected.normal), distance(picture.s[i], expected.s)};
}

/// Returns the rounding of a point's coordinates.
double rounding(const Vec3& point, const Tolerance& tolerance) {
  return tolerance.coordinate * glm::length(point);
}

class Judge {
 public:
  Judge(Oracle& oracle, const Hits& picture, const Tolerance& tolerance)
      : oracle_(oracle), picture_(picture), tolerance_(tolerance) {}

  Tally run() {
    tally_.pixels = picture_.primitive.size();
    verdicts_.resize(tally_.pixels);
    for (size_t i = 0; i < tally_.pixels; ++i) verdicts_[i] = verdict(i);
    for (size_t i = 0; i < tally_.pixels; ++i) {
      if (verdicts_[i] != Verdict::kRight) count(i);
    }
    return std::move(tally_);
  }

 private:
  Verdict verdict(size_t i) {
    const ExactHit& expected = oracle_.hit(i);
    tally_.hits += expected.hit();
    const Verdict result = verdict_of(expected, picture_, i, tolerance_, oracle_.scene());
    if (result == Verdict::kRight && expected.hit()) {
      const Errors errors = errors_of(expected, picture_, i);
      const double size = oracle_.model_size();
      tally_.position_errors.add(errors.position / size);
      tally_.normal_errors.add(errors.normal);
      tally_.position_rounding =
          std::max(tally_.position_rounding, rounding(expected.position, tolerance_) / size);
    }
    return result;
  }

  void count(size_t i) {
    const bool may_ask = tally_.undecided + tally_.wrong_pixels() < kMostQuestions;
    const Doubt doubt = may_ask ? oracle_.doubt(i) : Doubt::kNone;
    if (doubt != Doubt::kNone) {
      ++tally_.undecided;
      if (tally_.undecided_pixels.size() < kMostListed) {
        tally_.undecided_pixels.push_back(name_of(doubt) + (", " + describe(i)));
      }
      return;
    }
    ++tally_.wrong[size_t(verdicts_[i])];
    tally_.speckle += is_speckle(i);
    if (tally_.first_wrong.empty()) tally_.first_wrong = describe(i);
  }

  bool is_speckle(size_t i) const {
    const size_t width = picture_.width_px, x = i % width, y = i / width;
    const uint32_t wanted = oracle_.hit(i).primitive;
    int giving_away = 0;
    const auto look_at = [&](bool exists, size_t neighbour) {
      giving_away += exists && verdicts_[neighbour] == Verdict::kRight &&
                     oracle_.hit(neighbour).primitive == wanted;
    };
    look_at(x > 0, i - 1);
    look_at(x + 1 < width, i + 1);
    look_at(y > 0, i - width);
    look_at(y + 1 < picture_.height_px, i + width);
    return giving_away >= 3;
  }

  std::string describe(size_t i) const {
    static const char* const kNames[kVerdicts] = {"right", "hit or miss", "primitive", "position",
                                                  "normal"};
    const ExactHit& expected = oracle_.hit(i);
    const Errors errors = errors_of(expected, picture_, i);
    std::ostringstream text;
    text.precision(17);
    text << kNames[size_t(verdicts_[i])] << " at pixel " << i % picture_.width_px << ", "
         << i / picture_.width_px << ": primitive " << int64_t(int32_t(picture_.primitive[i]))
         << " instead of " << int64_t(int32_t(expected.primitive)) << ", s " << picture_.s[i]
         << " instead of " << expected.s.lower;
    if (expected.hit()) {
      const double size = oracle_.model_size();
      text.precision(3);
      text << "; off by " << errors.position / size << " of the size, normal by " << errors.normal;
    }
    return text.str();
  }

  Oracle& oracle_;
  const Hits& picture_;
  const Tolerance& tolerance_;
  std::vector<Verdict> verdicts_;
  Tally tally_;
};

}  // namespace

const char* name_of(Doubt doubt) {
  switch (doubt) {
    case Doubt::kNone:
      return "no doubt";
    case Doubt::kSilhouette:
      return "silhouette";
    case Doubt::kEye:
      return "eye";
    case Doubt::kThickness:
      return "thickness";
  }
  return "";
}

Verdict verdict_of(const ExactHit& expected, const Hits& picture, size_t pixel,
                   const Tolerance& tolerance, const oracle::ExactScene& scene) {
  const bool hit = picture.primitive[pixel] != Hits::kMiss;
  if (hit != expected.hit()) return Verdict::kWrongHit;
  if (!hit) return Verdict::kRight;
  if (picture.primitive[pixel] != expected.primitive) return Verdict::kWrongPrimitive;
  const Errors errors = errors_of(expected, picture, pixel);
  const double far = tolerance.position * scene.size() + rounding(expected.position, tolerance) +
                     scene.displacement();
  const double far_s = far + 2 * tolerance.coordinate * std::abs(expected.s.lower);
  if (!(errors.position <= far && errors.s <= far_s)) return Verdict::kWrongPosition;
  return errors.normal <= tolerance.normal ? Verdict::kRight : Verdict::kWrongNormal;
}

uint64_t Tally::wrong_pixels() const {
  uint64_t sum = 0;
  for (const uint64_t count : wrong) sum += count;
  return sum;
}

void Tally::add(const Tally& other) {
  pixels += other.pixels;
  hits += other.hits;
  for (size_t i = 0; i < kVerdicts; ++i) wrong[i] += other.wrong[i];
  undecided += other.undecided;
  speckle += other.speckle;
  position_errors.add(other.position_errors);
  normal_errors.add(other.normal_errors);
  position_rounding = std::max(position_rounding, other.position_rounding);
  if (first_wrong.empty()) first_wrong = other.first_wrong;
  undecided_pixels.insert(undecided_pixels.end(), other.undecided_pixels.begin(),
                          other.undecided_pixels.end());
}

Oracle::Oracle(const csgcore::Scene& scene, const csgcore::View& view)
    : view_(&view), scene_(scene), rays_(scene_), hits_(oracle::exact_picture(scene_, view)) {}

uint64_t Oracle::hits() const {
  return uint64_t(
      std::count_if(hits_.begin(), hits_.end(), [](const ExactHit& hit) { return hit.hit(); }));
}

Doubt Oracle::doubt(size_t pixel) {
  const auto [entry, is_new] = doubts_.try_emplace(pixel, Doubt::kNone);
  if (is_new) {
    const auto x = double(pixel % view_->width_px), y = double(pixel / view_->width_px);
    entry->second = rays_.doubt(csgcore::pixel_ray(*view_, x, y), view_->projection);
  }
  return entry->second;
}

Tally judge(Oracle& oracle, const Hits& picture, const Tolerance& tolerance) {
  return Judge(oracle, picture, tolerance).run();
}

}  // namespace stress
