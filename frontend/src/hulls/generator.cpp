#include "hulls/generator.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "base/angles.hpp"
#include "csgcore/stop_scope.hpp"
#include "hulls/orthonormal.hpp"
#include "hulls/point_hull.hpp"

namespace frontend {
namespace {

using csgcore::Affine;
using csgcore::Mat3;
using csgcore::Vec3;

/// A matrix of six digits keeps circles up to this share of their radii.
constexpr double kRoundness = 2e-6;
/// A sum of more generators takes more than some seconds and a GB.
constexpr size_t kMostSums = size_t{1} << 22;

double mean_length(const Mat3& m) {
  return std::sqrt((glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2])) / 3);
}

bool are_orthogonal_and_equal(const Vec3& a, const Vec3& b) {
  const double aa = glm::dot(a, a), bb = glm::dot(b, b);
  return std::abs(aa - bb) <= 2 * kRoundness * aa &&
         std::abs(glm::dot(a, b)) <= 2 * kRoundness * aa;
}

bool is_similarity(const Mat3& m) {
  return are_orthogonal_and_equal(m[0], m[1]) && are_orthogonal_and_equal(m[1], m[2]) &&
         are_orthogonal_and_equal(m[2], m[0]);
}

bool is_round(const Generator& generator) {
  return (!generator.has_disc() || are_orthogonal_and_equal(generator.disc_a, generator.disc_b)) &&
         (!generator.has_ball() || is_similarity(generator.ball));
}

/// `generator` must be round.
RoundGenerator round_of(const Generator& generator) {
  RoundGenerator result;
  result.center = generator.center;
  if (generator.has_disc()) {
    const Vec3 normal = glm::cross(generator.disc_a, generator.disc_b);
    result.normal = glm::normalize(normal);
    // A rotation by 90° may leave components of its rounding.
    result.disc_radius = std::sqrt(glm::length(normal));
  }
  if (generator.has_ball()) result.ball_radius = mean_length(generator.ball);
  return result;
}

Generator general_of(const RoundGenerator& generator) {
  Generator result;
  result.center = generator.center;
  if (generator.disc_radius > 0) {
    const Axes axes = axes_along(generator.normal);
    result.disc_a = generator.disc_radius * axes.x;
    result.disc_b = generator.disc_radius * axes.y;
  }
  if (generator.ball_radius > 0) result.ball = Mat3(generator.ball_radius);
  return result;
}

/// The unit cube's image has a volume that double tells from 0.
bool is_regular(const Mat3& m) {
  constexpr double kFlattest = 1e-9;
  const double size = std::max({glm::length(m[0]), glm::length(m[1]), glm::length(m[2])});
  return size > 0 && std::abs(glm::determinant(m / size)) > kFlattest;
}

/// A frame in which the generator's ball, or its disc, is round.
std::optional<Mat3> frame_of(const Generator& generator) {
  Mat3 frame(0.0);
  if (generator.has_ball()) {
    frame = generator.ball;
  } else {
    const Vec3 normal = glm::cross(generator.disc_a, generator.disc_b);
    const double length = glm::length(normal);
    if (!(length > 0)) return std::nullopt;
    frame = {generator.disc_a, generator.disc_b, normal / std::sqrt(length)};
  }
  if (!is_regular(frame)) return std::nullopt;
  return frame;
}

bool all_are_round(const Generators& generators) {
  return std::all_of(generators.begin(), generators.end(), is_round);
}

Generators in_frame(const Mat3& frame, const Generators& generators) {
  Generators result = generators;
  map_all({csgcore::inverse(frame), Vec3(0.0)}, result);
  return result;
}

/// Puts points for the parts that are chosen: they lie on them.
void replace_parts(const Generator& generator, int rings, bool replaces_round,
                   std::vector<RoundGenerator>& result) {
  std::vector<Generator> without_ball;
  if (!generator.has_ball() || (!replaces_round && is_similarity(generator.ball))) {
    without_ball.push_back(generator);
  } else {
    for (int i = 0; i <= rings; ++i) {
      const double polar = kTurn / 2 * i / rings;
      const int points = i == 0 || i == rings ? 1 : 2 * rings;
      for (int k = 0; k < points; ++k) {
        const double azimuth = kTurn * k / points;
        const Vec3 direction(std::sin(polar) * std::cos(azimuth),
                             std::sin(polar) * std::sin(azimuth), std::cos(polar));
        Generator& part = without_ball.emplace_back(generator);
        part.center += generator.ball * direction;
        part.ball = Mat3(0.0);
      }
    }
  }
  for (const Generator& part : without_ball) {
    if (!part.has_disc() || (!replaces_round && is_round(part))) {
      result.push_back(round_of(part));
      continue;
    }
    const int chords = 4 * rings;
    for (int k = 0; k < chords; ++k) {
      const double angle = kTurn * k / chords;
      Generator point = part;
      point.center += std::cos(angle) * part.disc_a + std::sin(angle) * part.disc_b;
      point.disc_a = point.disc_b = Vec3(0.0);
      result.push_back(round_of(point));
    }
  }
}
static_assert(4 * kRingsOfBall == kChordsOfDisc);

/// The rings that keep the number of points within bounds.
int affordable_rings(const Generators& generators, double most_points) {
  constexpr int kFewestRings = 6;
  int rings = kRingsOfBall;
  const auto points = [&] {
    double sum = 0;
    for (const Generator& generator : generators) {
      if (is_round(generator)) continue;
      const bool has_ball = generator.has_ball() && !is_similarity(generator.ball);
      const bool has_disc =
          generator.has_disc() && !are_orthogonal_and_equal(generator.disc_a, generator.disc_b);
      sum += (has_ball ? 2.0 * rings * rings : 1) * (has_disc ? 4.0 * rings : 1);
    }
    return sum;
  };
  while (rings > kFewestRings && points() > most_points) rings /= 2;
  return rings;
}

RoundedGenerators rounded_in(const Mat3& frame, const Generators& generators, double most_points) {
  RoundedGenerators result;
  result.frame = frame;
  result.generators.reserve(generators.size());
  const int rings = affordable_rings(generators, most_points);
  for (const Generator& generator : generators) {
    if (is_round(generator)) {
      result.generators.push_back(round_of(generator));
    } else {
      result.is_faceted = true;
      replace_parts(generator, rings, false, result.generators);
    }
  }
  return result;
}

/// Keeps those that the hull of the others may not hold: of generators without round parts, the
/// corners of their hull. Returns whether all are points, and lie in a plane.
bool leave_out_inner_points(std::vector<RoundGenerator>& generators) {
  std::vector<Vec3> points;
  std::vector<RoundGenerator> kept;
  for (const RoundGenerator& generator : generators) {
    const bool is_point = generator.disc_radius == 0 && generator.ball_radius == 0;
    if (is_point) {
      points.push_back(generator.center);
    } else {
      kept.push_back(generator);
    }
  }
  const PointHull hull = point_hull(on_grid(points));
  const bool is_flat = kept.empty() && hull.dimension < 3;
  for (const uint32_t corner : hull.corners) kept.push_back({points[corner]});
  generators = std::move(kept);
  return is_flat;
}

/// A frame in which all are round, if there is one.
std::optional<Mat3> common_frame(const Generators& generators) {
  if (all_are_round(generators)) return Mat3(1.0);
  // Both a ball and a disc that are not round may name the frame of all.
  for (const bool wants_ball : {true, false}) {
    const auto odd =
        std::find_if(generators.begin(), generators.end(), [&](const Generator& generator) {
          return !is_round(generator) && generator.has_ball() == wants_ball;
        });
    if (odd == generators.end()) continue;
    const std::optional<Mat3> frame = frame_of(*odd);
    if (frame && all_are_round(in_frame(*frame, generators))) return frame;
  }
  return std::nullopt;
}

bool are_parallel(const Vec3& a, const Vec3& b) {
  return glm::length(glm::cross(a, b)) <= kRoundness;
}

/// Adds generators of the sum of two. Returns whether points stand for one of the discs.
bool add_sum(const RoundGenerator& a, const RoundGenerator& b,
             std::vector<RoundGenerator>& result) {
  const bool has_both = a.disc_radius > 0 && b.disc_radius > 0;
  const bool is_skew = has_both && !are_parallel(a.normal, b.normal);
  std::vector<RoundGenerator> parts{b};
  if (is_skew) {
    parts.clear();
    replace_disc(b, kChordsOfCutDisc, parts);
  }
  for (const RoundGenerator& part : parts) {
    result.push_back({a.center + part.center, a.disc_radius > 0 ? a.normal : part.normal,
                      a.disc_radius + part.disc_radius, a.ball_radius + part.ball_radius});
  }
  return is_skew;
}

}  // namespace

Generator mapped(const Affine& map, const Generator& generator) {
  return {map.point(generator.center), map.direction(generator.disc_a),
          map.direction(generator.disc_b), map.linear * generator.ball};
}

void map_all(const Affine& map, Generators& generators) {
  for (Generator& generator : generators) generator = mapped(map, generator);
}

bool is_finite(const Generator& generator) {
  const auto is_finite_vector = [](const Vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
  };
  return is_finite_vector(generator.center) && is_finite_vector(generator.disc_a) &&
         is_finite_vector(generator.disc_b) && is_finite_vector(generator.ball[0]) &&
         is_finite_vector(generator.ball[1]) && is_finite_vector(generator.ball[2]);
}

RoundedGenerators rounded(const Generators& generators) {
  const std::optional<Mat3> frame = common_frame(generators);
  return frame ? rounded_in(*frame, in_frame(*frame, generators), kMostPoints)
               : rounded_in(Mat3(1.0), generators, kMostPoints);
}

void replace_disc(const RoundGenerator& generator, int chords,
                  std::vector<RoundGenerator>& result) {
  const Axes axes = axes_along(generator.normal);
  for (int k = 0; k < chords; ++k) {
    const double angle = kTurn * k / chords;
    RoundGenerator point = generator;
    point.center += generator.disc_radius * (std::cos(angle) * axes.x + std::sin(angle) * axes.y);
    point.disc_radius = 0;
    result.push_back(point);
  }
}

PointSet points_of(const Generators& generators, int chords) {
  PointSet result;
  for (const Generator& generator : generators) {
    if (!generator.has_disc() && !generator.has_ball()) {
      result.points.push_back(generator.center);
      continue;
    }
    result.is_faceted = true;
    std::vector<RoundGenerator> points;
    replace_parts(generator, chords / 4, true, points);
    for (const RoundGenerator& point : points) result.points.push_back(point.center);
  }
  return result;
}

std::optional<GeneratorSum> minkowski_sum(const Generators& a, const Generators& b) {
  Generators both = a;
  both.insert(both.end(), b.begin(), b.end());
  const Mat3 frame = common_frame(both).value_or(Mat3(1.0));
  // Facets of both would be multiplied.
  constexpr double kMostPointsOfEach = 1 << 10;
  RoundedGenerators first = rounded_in(frame, in_frame(frame, a), kMostPointsOfEach);
  RoundedGenerators second = rounded_in(frame, in_frame(frame, b), kMostPointsOfEach);
  leave_out_inner_points(first.generators);
  leave_out_inner_points(second.generators);
  GeneratorSum result;
  result.is_faceted = first.is_faceted || second.is_faceted;
  if (first.generators.size() * second.generators.size() > kMostSums) return std::nullopt;
  std::vector<RoundGenerator> sums;
  for (const RoundGenerator& g : first.generators) {
    csgcore::stop_point();
    for (const RoundGenerator& h : second.generators) {
      if (add_sum(g, h, sums)) result.is_faceted = true;
      if (sums.size() > kMostSums) return std::nullopt;
    }
  }
  result.is_flat = leave_out_inner_points(sums);
  for (const RoundGenerator& sum : sums) {
    result.generators.push_back(mapped({frame, Vec3(0.0)}, general_of(sum)));
  }
  return result;
}

}  // namespace frontend
