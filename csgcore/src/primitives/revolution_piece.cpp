#include "primitives/revolution_piece.hpp"

#include <algorithm>
#include <cmath>

#include "base/constants.hpp"
#include "primitives/revolution_curve.hpp"

namespace csgcore {
namespace {

double sign(double x) { return x < 0 ? -1 : 1; }

/// The polar form of the function that is > 0 within the path.
double within(const RevolutionPath& path, const PathPoint& a, const PathPoint& b) {
  return path.rise * path.rise * (a.r * b.r - path.offset * path.offset) - a.run * b.run;
}
double within(const RevolutionPath& path, const PathPoint& p) {
  return path.rise * path.rise * ((p.r - path.offset) * (p.r + path.offset)) - p.run * p.run;
}

class PieceCrosser {
 public:
  PieceCrosser(const Profile& profile, const RevolutionPath& path, uint32_t face,
               std::vector<Crossing>& found)
      : profile_(profile), path_(path), passage_{path, face, found} {}

  void cross(const Profile::Piece& piece) {
    const PathPoint start = seen(piece.start), end = seen(piece.end);
    const bool from_within = within(path_, start) > 0, to_within = within(path_, end) > 0;
    if (piece.is_line()) {
      cross_line(start, end, from_within, to_within);
    } else {
      cross_curve(passage_,
                  {start, seen(piece.control), end, piece.weight, from_within, to_within});
    }
  }

 private:
  PathPoint seen(const Vec2& place) const { return seen(radius_at(profile_, place.x), place.y); }
  PathPoint seen(double r, double z) const {
    const double height = height_above(z, path_.height);
    return {r, height, path_.rise * path_.start + height * path_.run};
  }

  void add(double tau, int change) { passage_.add(tau, change); }

  /// A line makes a cone, whose radius at τ is (q + κ·τ)/Δz, and which a ray meets at the roots of
  /// a·τ² + 2h·τ + c. As for frusta, h² − a·c is formed without the products that would cancel.
  void cross_line(const PathPoint& start, const PathPoint& end, bool from_within, bool to_within) {
    const double rise = end.height - start.height, growth = end.r - start.r;
    if (from_within != to_within && rise == 0) {
      add(start.height / path_.rise, to_within ? 1 : -1);
      return;
    }
    // What lies within the path is convex.
    if (from_within && to_within) return;
    const bool is_pair = from_within == to_within;
    if (is_pair && !(within(path_, start, end) > 0)) return;
    const double kappa = path_.rise * growth;
    const double q = start.r * rise - growth * start.height;
    const double lean = q * path_.run - kappa * path_.start;
    const double turned = path_.offset * kappa, level = path_.offset * rise * path_.run;
    const double discriminant = lean * lean + (turned - level) * (turned + level);
    if (is_pair && !(discriminant > 0)) return;
    const double root = std::abs(rise) * std::sqrt(std::max(0.0, discriminant));
    const double steep = path_.run * rise;
    const double a = (steep - kappa) * (steep + kappa);
    const double h = steep * rise * path_.start - q * kappa;
    const double size =
        rise * rise * (path_.offset * path_.offset + path_.start * path_.start) + q * q;
    const double c = rise * rise * path_.offset * path_.offset +
                     (rise * path_.start - q) * (rise * path_.start + q);
    const auto add_root = [&](int change) {
      // The ray leaves the cone outwards at the larger root if a > 0.
      const double outwards = -change * path_.upwards() * sign(rise);
      const double own = -h + outwards * root, other = -h - outwards * root;
      // If the root nearly cancels h, the other form of it is exact, unless both are mere rounding,
      // as for a level ray that touches the cone.
      const bool cancels = h * outwards > 0 && 2 * root > std::abs(h) && root < 2 * std::abs(h) &&
                           h * h > kEpsilon * std::abs(a) * size;
      const double tau = cancels ? c / other : own / a;
      if (path_.rise == 0) return add(tau, change);
      // Along the cone, a ray passes it somewhere between the edge's ends.
      const auto [low, high] = std::minmax({start.height / path_.rise, end.height / path_.rise});
      add(std::isnan(tau) ? low : std::clamp(tau, low, high), change);
    };
    if (is_pair || to_within) add_root(1);
    if (is_pair || from_within) add_root(-1);
  }

  const Profile& profile_;
  const RevolutionPath& path_;
  PiecePassage passage_;
};

}  // namespace

void cross_piece(const Profile& profile, const RevolutionPath& path, const Profile::Piece& piece,
                 uint32_t face, std::vector<Crossing>& found) {
  PieceCrosser(profile, path, face, found).cross(piece);
}

}  // namespace csgcore
