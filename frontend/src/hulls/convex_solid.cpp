#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <memory>
#include <optional>
#include <utility>

#include "csgcore/profile.hpp"
#include "hulls/generator.hpp"
#include "hulls/orthonormal.hpp"
#include "hulls/point_solid.hpp"
#include "hulls/round_bodies.hpp"
#include "hulls/strips.hpp"
#include "plane/hull.hpp"

namespace frontend {
namespace {

using csgcore::Affine;
using csgcore::Primitive;
using csgcore::Vec3;

/// Two normals or centres differ by rounding, as a share of the size.
constexpr double kSame = 0x1p-44;

/// The solid around the axis x = y = 0 which is the hull of generators on it, whose discs lie
/// across it.
std::optional<Primitive> revolved_hull(const std::vector<RoundGenerator>& generators) {
  std::vector<Disc> discs;
  for (const RoundGenerator& generator : generators) {
    for (const double sign : {-1.0, 1.0}) {
      discs.push_back({{sign * generator.disc_radius, generator.center.z}, generator.ball_radius});
    }
  }
  const Figure figure = convex_hull(discs);
  if (const Disc* ball = std::get_if<Disc>(&figure)) {
    if (!(ball->radius > 0)) return std::nullopt;
    return csgcore::make_sphere(ball->radius,
                                {csgcore::Mat3(1.0), Vec3(ball->center.x, 0, ball->center.y)});
  }
  Outline outline = right_half(figure);
  const Rectangle bounds = bounds_of(outline);
  if (bounds.empty() || !(bounds.max.x > 0)) return std::nullopt;
  return csgcore::make_revolution(
      std::make_shared<csgcore::Profile>(std::move(outline.loops), outline.fill_rule));
}

/// Generators that are round.
class RoundSolid {
 public:
  explicit RoundSolid(std::vector<RoundGenerator> generators) : generators_(std::move(generators)) {
    csgcore::Box box;
    for (const RoundGenerator& generator : generators_) {
      const double reach = generator.disc_radius + generator.ball_radius;
      box.merge(generator.center - reach);
      box.merge(generator.center + reach);
    }
    size_ = box.diagonal();
  }

  /// Returns nothing if the search for its pieces takes too long.
  std::optional<ConvexSolid> lower() {
    ConvexSolid result;
    const auto with_disc = std::find_if(generators_.begin(), generators_.end(),
                                        [](const auto& g) { return g.disc_radius > 0; });
    if (with_disc == generators_.end()) {
      if (add_ball_hull(bodies(&RoundGenerator::ball_radius), kLeastStrip, result.pieces)) {
        return result;
      }
      return std::nullopt;
    }
    const Vec3 normal = with_disc->normal;
    const Affine to_axis{axes_along(normal).matrix(), with_disc->center};
    if (has_parallel_discs(normal) && lower_parallel(to_axis, result)) return result;
    result = {};
    if (lower_facets(result)) return result;
    return std::nullopt;
  }

 private:
  std::vector<RoundBody> bodies(double RoundGenerator::*radius) const {
    std::vector<RoundBody> result;
    result.reserve(generators_.size());
    for (const RoundGenerator& generator : generators_) {
      result.push_back({generator.center, generator.*radius});
    }
    return result;
  }

  bool has_parallel_discs(const Vec3& normal) const {
    return std::all_of(generators_.begin(), generators_.end(), [&](const auto& g) {
      return g.disc_radius == 0 || glm::length(glm::cross(g.normal, normal)) <= kSame;
    });
  }

  bool all_on_axis() const {
    return std::all_of(generators_.begin(), generators_.end(), [&](const auto& g) {
      return glm::length(glm::dvec2(g.center)) <= kSame * size_;
    });
  }

  bool are_at_one_height() const {
    const auto [least, most] =
        std::minmax_element(generators_.begin(), generators_.end(),
                            [](const auto& a, const auto& b) { return a.center.z < b.center.z; });
    return most->center.z - least->center.z <= kSame * size_;
  }

  /// The discs lie across the z axis of that frame. False: there is no exact form.
  bool lower_parallel(const Affine& from_axis, ConvexSolid& result) {
    const auto world = generators_;
    const csgcore::Mat3 turn = glm::transpose(from_axis.linear);
    for (RoundGenerator& generator : generators_) {
      generator.center = turn * (generator.center - from_axis.translation);
      generator.normal = Vec3(0, 0, 1);
    }
    const bool is_lowered = lower_upright(result);
    generators_ = world;
    for (Primitive& piece : result.pieces) {
      piece.local_to_world = compose(from_axis, piece.local_to_world);
    }
    return is_lowered;
  }

  bool lower_upright(ConvexSolid& result) const {
    const double ball = generators_.front().ball_radius;
    const bool has_same_balls = std::all_of(generators_.begin(), generators_.end(),
                                            [&](const auto& g) { return g.ball_radius == ball; });
    if (has_same_balls && ball == 0) {
      if (are_at_one_height()) return false;
      return add_disc_hull(bodies(&RoundGenerator::disc_radius), result.pieces);
    }
    if (all_on_axis()) {
      if (const auto revolved = revolved_hull(generators_)) result.pieces.push_back(*revolved);
      return true;
    }
    return has_same_balls && !are_at_one_height() && lower_rounded_discs(ball, result);
  }

  /// The hull of discs, and a ball around each of its points: sums distribute over unions.
  bool lower_rounded_discs(double ball, ConvexSolid& result) const {
    const std::optional<DiscHull> hull = disc_hull(bodies(&RoundGenerator::disc_radius));
    if (!hull) return false;
    // Each oblique frustum would be made of facets by itself.
    constexpr auto kMostOblique = 8;
    const auto oblique =
        std::count_if(hull->frusta.begin(), hull->frusta.end(),
                      [&](const DiscHull::Pair& pair) { return is_oblique(*hull, pair); });
    if (oblique > kMostOblique) return false;
    std::vector<RoundBody> balls;
    for (const Vec3& point : hull->points) balls.push_back({point, ball});
    if (!add_ball_hull(std::move(balls), kLeastStrip, result.pieces)) return false;
    return std::all_of(hull->frusta.begin(), hull->frusta.end(), [&](const DiscHull::Pair& pair) {
      return add_rounded_frustum(hull->discs[pair.lower], hull->discs[pair.upper], ball, result);
    });
  }

  bool is_oblique(const RoundBody& lower, const RoundBody& upper) const {
    return glm::length(glm::dvec2(upper.center - lower.center)) > kSame * size_;
  }
  bool is_oblique(const DiscHull& hull, const DiscHull::Pair& pair) const {
    return is_oblique(hull.discs[pair.lower], hull.discs[pair.upper]);
  }

  bool add_rounded_frustum(const RoundBody& lower, const RoundBody& upper, double ball,
                           ConvexSolid& result) const {
    const Vec3 across(0, 0, 1);
    if (!is_oblique(lower, upper)) {
      const Vec3 center(lower.center.x, lower.center.y, 0);
      auto revolved = revolved_hull({{lower.center - center, across, lower.radius, ball},
                                     {upper.center - center, across, upper.radius, ball}});
      if (!revolved) return true;
      revolved->local_to_world.translation += center;
      result.pieces.push_back(std::move(*revolved));
      return true;
    }
    result.is_faceted = true;
    RoundSolid facets(
        {{lower.center, across, lower.radius, ball}, {upper.center, across, upper.radius, ball}});
    return facets.lower_facets(result);
  }

  bool lower_facets(ConvexSolid& result) const {
    result.is_faceted = true;
    std::vector<RoundGenerator> parts;
    const int most = affordable_chords();
    for (const RoundGenerator& generator : generators_) {
      if (generator.disc_radius > 0) {
        replace_disc(generator, chords_of(generator.disc_radius, most), parts);
      } else {
        parts.push_back(generator);
      }
    }
    // A frustum that spans less than two facets is not seen to be missing.
    constexpr double kFacetStrip = 4 * 3.14 / kChordsOfDisc;
    std::vector<RoundBody> balls;
    for (const RoundGenerator& part : parts) balls.push_back({part.center, part.ball_radius});
    return add_ball_hull(std::move(balls), kFacetStrip, result.pieces);
  }

  /// Chords of a disc that is smaller than the hull are as near to it as those of one that is not.
  int chords_of(double radius, int most) const {
    constexpr int kFewestVisible = 48;
    const double share = std::sqrt(std::min(2 * radius / size_, 1.0));
    return std::min(most, std::max(kFewestVisible, static_cast<int>(kChordsOfDisc * share)));
  }

  /// Balls at the corners of chords have frusta between them, which are primitives.
  int affordable_chords() const {
    constexpr int kMostRoundCorners = 1 << 12;
    constexpr int kFewestChords = 24;
    int discs = 1;
    bool has_ball = false;
    for (const RoundGenerator& generator : generators_) {
      discs += generator.disc_radius > 0;
      has_ball = has_ball || (generator.disc_radius > 0 && generator.ball_radius > 0);
    }
    const int most = has_ball ? kMostRoundCorners : kMostPoints;
    return std::clamp(most / discs, kFewestChords, kChordsOfDisc);
  }

  std::vector<RoundGenerator> generators_;
  double size_ = 0;
};

/// The hull with facets for all that is round.
ConvexSolid faceted_solid(const Generators& generators) {
  constexpr int kFewestChords = 24;
  constexpr size_t kRoughly = 16;  // a ball has chords² / 8 points
  const auto chords = static_cast<int>(std::sqrt(static_cast<double>(kMostPoints * kRoughly) /
                                                 static_cast<double>(generators.size())));
  ConvexSolid result;
  result.is_faceted = true;
  const PointSet points =
      points_of(generators, std::clamp(chords, kFewestChords, kChordsOfCutDisc));
  if (auto solid = solid_of_points(points.points)) {
    result.pieces.push_back(std::move(solid->primitive));
  }
  return result;
}

bool is_disc_or_ball(const Generator& generator) {
  return generator.has_disc() || generator.has_ball();
}

/// The hull of points.
ConvexSolid solid_of_centers(const Generators& generators) {
  std::vector<Vec3> points;
  points.reserve(generators.size());
  for (const Generator& generator : generators) points.push_back(generator.center);
  ConvexSolid result;
  if (auto solid = solid_of_points(points)) result.pieces.push_back(std::move(solid->primitive));
  return result;
}

/// How far the generator reaches along a direction.
double reach_along(const Vec3& direction, const Generator& generator) {
  const Vec3 ball = glm::transpose(generator.ball) * direction;
  return glm::dot(direction, generator.center) +
         std::hypot(glm::dot(direction, generator.disc_a), glm::dot(direction, generator.disc_b)) +
         glm::length(ball);
}

/// A point of the generator that is furthest along a direction.
Vec3 furthest_point(const Vec3& direction, const Generator& generator) {
  Vec3 result = generator.center;
  const double a = glm::dot(direction, generator.disc_a);
  const double b = glm::dot(direction, generator.disc_b);
  const double disc = std::hypot(a, b);
  if (disc > 0) result += a / disc * generator.disc_a + b / disc * generator.disc_b;
  const Vec3 ball = glm::transpose(generator.ball) * direction;
  const double length = glm::length(ball);
  if (length > 0) result += generator.ball * (ball / length);
  return result;
}

/// Leaves out generators within a polyhedron whose corners are points of some of them. What is
/// round becomes many points or pieces later; of many such generators, most have no part in the
/// hull.
Generators without_inner_generators(const Generators& generators) {
  constexpr size_t kMany = 12;
  constexpr double kRoom = 0x1p-40;  // more than the rounding of the polyhedron's faces
  const auto count = std::ranges::count_if(generators, is_disc_or_ball);
  if (static_cast<size_t>(count) < kMany) return generators;
  std::vector<Vec3> corners;
  for (const Vec3& direction : spread_directions()) {
    const Generator* furthest = nullptr;
    double most = 0;
    for (const Generator& generator : generators) {
      const double reach = reach_along(direction, generator);
      if (furthest != nullptr && reach <= most) continue;
      furthest = &generator;
      most = reach;
    }
    corners.push_back(furthest_point(direction, *furthest));
  }
  const std::vector<csgcore::HalfSpace> faces = faces_of(corners);
  if (faces.empty()) return generators;
  csgcore::Box box;
  for (const Vec3& corner : corners) box.merge(corner);
  const double room = kRoom * box.diagonal();
  Generators result;
  for (const Generator& generator : generators) {
    const auto holds = [&](const csgcore::HalfSpace& face) {
      return reach_along(face.normal, generator) < face.offset - room;
    };
    if (!std::ranges::all_of(faces, holds)) result.push_back(generator);
  }
  return result;
}

}  // namespace

ConvexSolid convex_solid(const Generators& all) {
  if (std::ranges::none_of(all, is_disc_or_ball)) return solid_of_centers(all);
  const Generators generators = without_inner_generators(all);
  RoundedGenerators round = rounded(generators);
  if (round.generators.empty()) return {};
  std::optional<ConvexSolid> result = RoundSolid(std::move(round.generators)).lower();
  if (!result) return faceted_solid(generators);
  result->is_faceted = result->is_faceted || round.is_faceted;
  if (round.frame == csgcore::Mat3(1.0)) return std::move(*result);
  for (Primitive& piece : result->pieces) {
    piece.local_to_world = compose({round.frame, Vec3(0.0)}, piece.local_to_world);
  }
  return std::move(*result);
}

}  // namespace frontend
