// The pixels of a block that show the same face share a point of it. Where the light of points
// beside each other is shared, a point asks a part of the directions, one of 9 groups, so that the
// points of any square of 3 × 3 blocks have all of them (interleaved sampling: Keller and Heidrich,
// Rendering Techniques 2001), and its light is that of the points around it on the same face. It
// asks the groups that none of these asks itself. So each has answers to all directions, however
// small its face is. Occlusion is smooth, but the key light's shadows have edges: a point there
// asks all of that light's directions itself.
#include "csgcore/studio.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "base/worker_threads.hpp"
#include "csgcore/light_tracer.hpp"
#include "csgcore/studio_light.hpp"
#include "frame/sparse_hits.hpp"

namespace csgcore {
namespace {

/// The side of the square of blocks whose points ask all groups.
constexpr uint32_t kSquareBlocks = 3;
constexpr uint32_t kGroups = kSquareBlocks * kSquareBlocks;
using Groups = uint16_t;  // bits
constexpr Groups kAllGroups = (1u << kGroups) - 1;
/// A point's neighbours are in at most so many blocks to each side.
constexpr uint32_t kReachBlocks = 1;
/// Neighbours share their groups by bands of so many rows of blocks, first every other band and
/// then those between, which therefore can be dealt with at once.
constexpr uint32_t kBandRows = 16;
static_assert(kBandRows > 2 * kReachBlocks);
/// So many rounds there are at most, each of as many directions of the sky.
constexpr uint32_t kRounds = 2;
/// One direction goes to the key light for so many of the whole sky: fewer where light is shared,
/// since the neighbours' directions make shadows smooth there.
constexpr uint32_t kPerKeyDirection = 4, kPerSharedKeyDirection = 9;
/// The tangent of the angle between the middle of the key light, which is a disc, and its rim:
/// shadows are soft away from what casts them.
constexpr double kKeyRadius = 0.06;

constexpr uint32_t kNoPoint = std::numeric_limits<uint32_t>::max();

constexpr double kDegree = std::numbers::pi / 180;
/// The largest angle between normals of the same smooth face in pixels side by side.
constexpr double kSmoothAngle = 20 * kDegree;
/// The same between faces of different primitives, which may touch in a line that is to be seen.
constexpr double kMeetingAngle = 6 * kDegree;
const double kSmoothCosine = std::cos(kSmoothAngle), kMeetingCosine = std::cos(kMeetingAngle);
/// A line in a crease gets darker up to so many times that angle: one that began at once would be
/// dashed where a face bends by about as much.
constexpr double kFullLine = 1.5;
/// The sine of the largest angle of the line between two such pixels' points to both faces.
constexpr double kLargestRise = 0.3;
/// What a line leaves of the colour below it.
constexpr double kLineShade = 0.3;

/// Returns direction i of n that are spread evenly over the sphere: a Fibonacci lattice. That of
/// the next round is turned by half of its steps.
Vec3 sky_direction(uint32_t i, uint32_t n, uint32_t round) {
  const double z = 1 - (2.0 * i + 1) / n;
  const double turn = 2 * std::numbers::pi * (std::numbers::phi - 1) * (i + 0.5 * round);
  const double radius = std::sqrt(1 - z * z);
  return {radius * std::cos(turn), radius * std::sin(turn), z};
}

/// Returns direction i of n towards the key light's disc.
Vec3 key_direction(const View& view, const Vec3& key, uint32_t i, uint32_t n) {
  const Vec3 across = glm::normalize(glm::cross(key, view.up));
  const double turn = 2 * std::numbers::pi * (std::numbers::phi - 1) * i;
  const double radius = kKeyRadius * std::sqrt((i + 0.5) / n);
  return glm::normalize(
      key + radius * (std::cos(turn) * across + std::sin(turn) * glm::cross(key, across)));
}

/// Sums over the directions that a point has asked, weighted by its normal's cosine.
struct Light {
  LightSum sky, key;
};

void add(const LightSum& other, float weight, LightSum& sum) {
  sum.all += weight * other.all;
  sum.open += weight * other.open;
}

float open_share(const LightSum& sum) { return sum.all > 0 ? sum.open / sum.all : 1; }

template <typename Visit>
void for_each_group(Groups groups, const Visit& visit) {
  for (unsigned left = groups; left != 0; left &= left - 1) {
    visit(static_cast<uint32_t>(std::countr_zero(left)));
  }
}

class Studio {
 public:
  Studio(const Solid& solid, const View& view, const StudioSettings& settings,
         const TraceOptions& options, const SparseHits& hits, Image& image)
      : solid_(solid),
        view_(view),
        light_(studio_light(view)),
        settings_(settings),
        options_(options),
        hits_(hits),
        image_(image) {}

  void finish() {
    const bool has_light = settings_.occlusion > 0 || settings_.shadows > 0;
    if (has_light) {
      collect_points();
      find_neighbours();
      share_groups();
      ask_for_light();
    }
    if (options_.stop.stop_requested()) return;
    tbb::parallel_for(uint32_t{0}, view_.height_px, [&](uint32_t y) {
      for (uint32_t x = 0; x < view_.width_px; ++x) {
        const size_t pixel = index(x, y);
        if (hits_.primitive[pixel] == Hits::kMiss) continue;
        double factor = has_light ? light_at(pixel) : 1;
        if (settings_.edges > 0) factor *= 1 - settings_.edges * (1 - kLineShade) * line_at(x, y);
        for (uint8_t& channel : image_.rgb[pixel]) {
          channel = static_cast<uint8_t>(channel * factor + 0.5);
        }
      }
    });
  }

 private:
  /// The points of a row of blocks, and their neighbours.
  struct Row {
    uint32_t first = 0;                 // of all points
    std::vector<uint32_t> blocks;       // by block: its first point in this row; and the end
    std::vector<uint32_t> pixels;       // of each point in turn
    std::vector<uint32_t> first_pixel;  // by point: of its part of `pixels`; and the end
    std::vector<uint32_t> neighbours;   // of each point in turn, among all points
    std::vector<uint32_t> ends;         // by point: of its part of `neighbours`
    uint32_t size() const { return static_cast<uint32_t>(first_pixel.size()) - 1; }
    /// A pixel of a point, for all tests of what face it is of.
    uint32_t pixel(uint32_t point) const { return pixels[first_pixel[point]]; }
  };

  /// A point: the i-th of a row.
  struct Place {
    uint32_t row, i;
  };
  uint32_t point_at(const Place& place) const { return rows_[place.row].first + place.i; }

  size_t index(uint32_t x, uint32_t y) const { return size_t{y} * view_.width_px + x; }

  Vec3 towards_viewer(const Vec3& position) const {
    return view_.projection == Projection::kPerspective ? view_.eye - position : -view_.forward;
  }

  bool is_translucent(uint32_t primitive) const {
    const std::optional<Color>& color = solid_.primitives()[primitive].color;
    return color && color->a < 1;
  }

  /// Whether light falls on what a pixel shows. Faces that are seen from within the solid have no
  /// light of their own to lose, and what is seen through translucent ones has another.
  bool is_lit_from_outside(size_t pixel) const {
    return hits_.primitive[pixel] != Hits::kMiss && !is_translucent(hits_.primitive[pixel]) &&
           glm::dot(hits_.normal[pixel], towards_viewer(hits_.position[pixel])) > 0;
  }

  void collect_points() {
    const uint32_t side = settings_.block_px;
    columns_ = (view_.width_px + side - 1) / side;
    rows_.resize((view_.height_px + side - 1) / side);
    point_of_.assign(hits_.primitive.size(), kNoPoint);
    const auto for_each_pixel = [&](uint32_t column, uint32_t row, const auto& visit) {
      for (uint32_t y = row * side; y < std::min((row + 1) * side, view_.height_px); ++y) {
        for (uint32_t x = column * side; x < std::min((column + 1) * side, view_.width_px); ++x) {
          visit(index(x, y));
        }
      }
    };
    const auto count = static_cast<uint32_t>(rows_.size());
    tbb::parallel_for(uint32_t{0}, count, [&](uint32_t y) {
      Row& row = rows_[y];
      std::vector<std::vector<uint32_t>> faces(size_t{side} * side);
      for (uint32_t column = 0; column < columns_; ++column) {
        size_t found = 0;
        for_each_pixel(column, y, [&](size_t pixel) {
          if (!is_lit_from_outside(pixel)) return;
          size_t face = 0;
          while (face < found && !are_of_one_face(pixel, faces[face].front())) ++face;
          if (face == found) faces[found++].clear();
          faces[face].push_back(static_cast<uint32_t>(pixel));
        });
        row.blocks.push_back(static_cast<uint32_t>(row.first_pixel.size()));
        for (size_t face = 0; face < found; ++face) {
          const auto point = static_cast<uint32_t>(row.first_pixel.size());
          row.first_pixel.push_back(static_cast<uint32_t>(row.pixels.size()));
          for (const uint32_t pixel : faces[face]) {
            row.pixels.push_back(pixel);
            point_of_[pixel] = point;
          }
        }
      }
      row.blocks.push_back(static_cast<uint32_t>(row.first_pixel.size()));
      row.first_pixel.push_back(static_cast<uint32_t>(row.pixels.size()));
    });
    uint32_t points = 0;
    for (Row& row : rows_) {
      row.first = points;
      points += row.size();
    }
    asked_.resize(points);
    lights_.resize(points);
    tbb::parallel_for(uint32_t{0}, count, [&](uint32_t y) {
      for (const uint32_t pixel : rows_[y].pixels) point_of_[pixel] += rows_[y].first;
    });
  }

  /// Returns the point of a block that is on the same face as what a pixel shows, or kNoPoint.
  uint32_t point_of_face(uint32_t column, uint32_t row, size_t pixel) const {
    const Row& points = rows_[row];
    for (uint32_t i = points.blocks[column]; i < points.blocks[column + 1]; ++i) {
      if (are_of_one_face(pixel, points.pixel(i))) return points.first + i;
    }
    return kNoPoint;
  }

  /// Calls visit(place) for all points in turn.
  template <typename Visit>
  void for_each_place(const Visit& visit) const {
    for (uint32_t row = 0; row < rows_.size(); ++row) {
      for (uint32_t i = 0; i < rows_[row].size(); ++i) visit(Place{row, i});
    }
  }

  /// Calls visit(column, row, i) for the i-th point of each row, in parallel for rows.
  template <typename Visit>
  void for_each_point(const Visit& visit) const {
    tbb::parallel_for(uint32_t{0}, static_cast<uint32_t>(rows_.size()), [&](uint32_t y) {
      for (uint32_t column = 0; column < columns_; ++column) {
        for (uint32_t i = rows_[y].blocks[column]; i < rows_[y].blocks[column + 1]; ++i) {
          visit(column, y, i);
        }
      }
    });
  }

  void find_neighbours() {
    const uint32_t reach = settings_.shares_light ? kReachBlocks : 0;
    const auto rows = static_cast<uint32_t>(rows_.size());
    for_each_point([&](uint32_t column, uint32_t row, uint32_t i) {
      Row& own = rows_[row];
      for (uint32_t y = row - std::min(row, reach); y <= std::min(row + reach, rows - 1); ++y) {
        for (uint32_t x = column - std::min(column, reach);
             x <= std::min(column + reach, columns_ - 1); ++x) {
          const uint32_t other =
              x == column && y == row ? own.first + i : point_of_face(x, y, own.pixel(i));
          if (other != kNoPoint) own.neighbours.push_back(other);
        }
      }
      own.ends.push_back(static_cast<uint32_t>(own.neighbours.size()));
    });
  }

  /// The neighbours of a row's point, itself included.
  static std::span<const uint32_t> neighbours_of(const Row& row, uint32_t i) {
    const uint32_t begin = i == 0 ? 0 : row.ends[i - 1];
    return {row.neighbours.data() + begin, row.ends[i] - begin};
  }

  void share_groups() {
    for_each_point([&](uint32_t column, uint32_t row, uint32_t i) {
      const uint32_t group = row % kSquareBlocks * kSquareBlocks + column % kSquareBlocks;
      asked_[rows_[row].first + i] = static_cast<Groups>(1u << group);
    });
    const uint32_t bands = (static_cast<uint32_t>(rows_.size()) + kBandRows - 1) / kBandRows;
    for (const uint32_t first : {0u, 1u}) {
      tbb::parallel_for(0u, (bands + 1 - first) / 2, [&](uint32_t pair) {
        const uint32_t band = 2 * pair + first;
        const size_t end = std::min(size_t{band + 1} * kBandRows, rows_.size());
        for (size_t y = size_t{band} * kBandRows; y < end; ++y) {
          for (uint32_t i = 0; i < rows_[y].size(); ++i) {
            unsigned answered = 0;
            for (const uint32_t other : neighbours_of(rows_[y], i)) answered |= asked_[other];
            Groups& asked = asked_[rows_[y].first + i];
            asked = static_cast<Groups>(asked | (kAllGroups & ~answered));
          }
        }
      });
    }
    uint32_t sums = 0;
    for (const Groups asked : asked_) {
      sums_before_.push_back(sums);
      sums += static_cast<uint32_t>(std::popcount(asked));
    }
    sums_.resize(sums);
  }

  bool asks(const Place& place, uint32_t group) const {
    return (asked_[point_at(place)] >> group & 1) != 0;
  }
  /// What a point sees of a group that it asks.
  Light& sum_of(const Place& place, uint32_t group) {
    const unsigned before = asked_[point_at(place)] & ((1u << group) - 1);
    return sums_[sums_before_[point_at(place)] + static_cast<uint32_t>(std::popcount(before))];
  }

  uint32_t key_directions() const {
    const uint32_t all = settings_.directions;
    // Fewer than one of each group would leave steps in soft shadows.
    return settings_.shares_light ? std::min(all, std::max(all / kPerSharedKeyDirection, kGroups))
                                  : all / kPerKeyDirection;
  }

  void ask_for_light() {
    const LightTracer tracer(solid_);
    const bool has_sky = settings_.occlusion > 0, has_key = settings_.shadows > 0;
    uint32_t round = 0;
    do {
      ask_all(tracer, has_sky ? std::optional(round) : std::nullopt, has_key && round == 0);
    } while (++round < rounds() && noise() > settings_.largest_noise);
    if (settings_.shares_light && has_key) sharpen_shadows(tracer);
  }

  uint32_t rounds() const {
    return settings_.shares_light && settings_.largest_noise > 0 ? kRounds : 1;
  }

  /// Asks what ask_group() does, and finds what each point gets of all that was asked so far.
  void ask_all(const LightTracer& tracer, std::optional<uint32_t> sky_round, bool has_key) {
    tbb::parallel_for(uint32_t{0}, kGroups, [&](uint32_t group) {
      std::vector<Place> places;
      places.reserve(sums_.size() / kGroups);
      for_each_place([&](const Place& place) {
        if (asks(place, group)) places.push_back(place);
      });
      const std::vector<Light> lights = ask_group(tracer, places, group, sky_round, has_key);
      for (size_t i = 0; i < places.size(); ++i) {
        Light& sum = sum_of(places[i], group);
        add(lights[i].sky, 1, sum.sky);
        add(lights[i].key, 1, sum.key);
      }
    });
    noise_of_rows_.assign(rows_.size(), 0);
    for_each_point([&](uint32_t, uint32_t row, uint32_t i) {
      lights_[rows_[row].first + i] = light_of(neighbours_of(rows_[row], i), noise_of_rows_[row]);
    });
  }

  /// Returns by how much the groups' answers let the shares of the sky be off, as a mean.
  double noise() const {
    double sum = 0;
    for (const double of_row : noise_of_rows_) sum += of_row;
    return lights_.empty() ? 0 : sum / static_cast<double>(lights_.size());
  }

  /// Asks all of the key light's directions at those points that some reach, and others do not:
  /// what the neighbours see there would blur the shadow's edge.
  void sharpen_shadows(const LightTracer& tracer) {
    std::vector<Place> places;
    for_each_place([&](const Place& place) {
      const Light& light = lights_[point_at(place)];
      if (light.key.open > 0 && light.key.open < light.key.all) places.push_back(place);
    });
    std::array<std::vector<Light>, kGroups> answers;
    tbb::parallel_for(uint32_t{0}, kGroups, [&](uint32_t group) {
      std::vector<Place> missing;
      std::ranges::copy_if(places, std::back_inserter(missing),
                           [&](const Place& place) { return !asks(place, group); });
      answers[group] = ask_group(tracer, missing, group, std::nullopt, true);
    });
    std::array<size_t, kGroups> next{};
    for (const Place& place : places) {
      LightSum& key = lights_[point_at(place)].key;
      key = {};
      for (uint32_t group = 0; group < kGroups; ++group) {
        add(asks(place, group) ? sum_of(place, group).key : answers[group][next[group]++].key, 1,
            key);
      }
    }
  }

  /// Returns what points see of a group's directions: those of the sky in a round, if one is given,
  /// and all those of the key light.
  std::vector<Light> ask_group(const LightTracer& tracer, std::span<const Place> places,
                               uint32_t group, std::optional<uint32_t> sky_round,
                               bool has_key) const {
    std::vector<Vec3> positions, normals;
    positions.reserve(places.size());
    normals.reserve(places.size());
    for (const auto& [row, i] : places) {
      const uint32_t begin = rows_[row].first_pixel[i], end = rows_[row].first_pixel[i + 1];
      const uint32_t pixel = rows_[row].pixels[begin + group % (end - begin)];
      positions.push_back(hits_.position[pixel]);
      normals.push_back(hits_.normal[pixel]);
    }
    std::vector<LightSum> sky(places.size()), key(places.size());
    const uint32_t directions = settings_.directions / rounds(), keys = key_directions();
    for (uint32_t i = group; sky_round && i < directions; i += kGroups) {
      tracer.add_light({positions, normals}, sky_direction(i, directions, *sky_round), sky,
                       options_.stop);
    }
    for (uint32_t i = group; has_key && i < keys; i += kGroups) {
      tracer.add_light({positions, normals}, key_direction(view_, light_.key, i, keys), key,
                       options_.stop);
    }
    std::vector<Light> lights(places.size());
    for (size_t i = 0; i < lights.size(); ++i) lights[i] = {sky[i], key[i]};
    return lights;
  }

  /// Returns the light of all of these points, to which each group counts the same. Adds to `noise`
  /// the standard error of the share of the sky, if the groups were drawn at random.
  Light light_of(std::span<const uint32_t> points, double& noise) const {
    std::array<uint32_t, kGroups> answers{};
    for (const uint32_t point : points) {
      for_each_group(asked_[point], [&](uint32_t group) { ++answers[group]; });
    }
    Light light;
    std::array<LightSum, kGroups> skies{};
    for (const uint32_t point : points) {
      uint32_t sum = sums_before_[point];
      for_each_group(asked_[point], [&](uint32_t group) {
        const float weight = 1 / static_cast<float>(answers[group]);
        add(sums_[sum].sky, weight, skies[group]);
        add(sums_[sum++].key, weight, light.key);
      });
    }
    for (const LightSum& sky : skies) add(sky, 1, light.sky);
    float squares = 0;
    for (const LightSum& sky : skies) {
      const float difference = sky.open - open_share(light.sky) * sky.all;
      squares += difference * difference;
    }
    if (light.sky.all > 0) noise += std::sqrt(squares) / light.sky.all;
    return light;
  }

  /// Whether two pixels side by side, or nearly so, show the same smooth face.
  bool are_of_one_face(size_t a, size_t b) const {
    if (hits_.primitive[a] == Hits::kMiss || hits_.primitive[b] == Hits::kMiss) return false;
    const double least = hits_.primitive[a] == hits_.primitive[b] ? kSmoothCosine : kMeetingCosine;
    if (glm::dot(hits_.normal[a], hits_.normal[b]) < least) return false;
    return !is_step(a, b);
  }

  /// Whether one of two faces ends before the other. Where they meet, each goes on before the other
  /// one, or each behind it.
  bool is_step(size_t a, size_t b) const {
    const Vec3 line = hits_.position[b] - hits_.position[a];
    const double from_a = glm::dot(hits_.normal[a], line);
    const double from_b = glm::dot(hits_.normal[b], line);
    const double rise = std::min(std::abs(from_a), std::abs(from_b));
    return from_a * from_b > 0 && rise * rise > kLargestRise * kLargestRise * glm::dot(line, line);
  }

  /// Returns by how much the colour of a pixel gets darker.
  double light_at(size_t pixel) const {
    if (point_of_[pixel] == kNoPoint) return 1;
    const Light& light = lights_[point_of_[pixel]];
    const double open = 1 - settings_.occlusion * (1 - open_share(light.sky));
    const double key = 1 - settings_.shadows * (1 - open_share(light.key));
    const Vec3& normal = hits_.normal[pixel];
    return studio_shade(light_, normal, open, key) / studio_shade(light_, normal, 1, 1);
  }

  /// Returns how much of a line there is between a pixel and one beside it, from 0 to 1: where one
  /// of two faces ends, which is the nearer one, or both meet in a crease.
  double line_between(size_t pixel, size_t other) const {
    if (hits_.primitive[other] == Hits::kMiss) return 1;
    if (is_step(pixel, other)) return hits_.s[pixel] < hits_.s[other] ? 1 : 0;
    const bool is_same = hits_.primitive[pixel] == hits_.primitive[other];
    const double cosine = glm::dot(hits_.normal[pixel], hits_.normal[other]);
    if (cosine >= (is_same ? kSmoothCosine : kMeetingCosine)) return 0;
    const double smooth = is_same ? kSmoothAngle : kMeetingAngle;
    return std::min((std::acos(std::max(cosine, -1.0)) / smooth - 1) / (kFullLine - 1), 1.0);
  }

  /// Returns how much of a line the pixel shows: the most of those that its face has within half a
  /// block.
  double line_at(uint32_t x, uint32_t y) const {
    const uint32_t reach = (settings_.block_px + 1) / 2;
    const auto towards = [&](size_t step, uint32_t steps_left) {
      double most = 0;
      size_t pixel = index(x, y);
      for (uint32_t i = 0; i < std::min(reach, steps_left) && most == 0; ++i, pixel += step) {
        most = line_between(pixel, pixel + step);
      }
      return most;
    };
    const size_t row = view_.width_px;
    return std::max({towards(~size_t{0}, x), towards(1, view_.width_px - 1 - x),
                     towards(~row + 1, y), towards(row, view_.height_px - 1 - y)});
  }

  const Solid& solid_;
  const View& view_;
  const StudioLight light_;
  const StudioSettings& settings_;
  const TraceOptions& options_;
  const SparseHits& hits_;
  Image& image_;
  uint32_t columns_ = 0;  // of blocks
  std::vector<Row> rows_;
  std::vector<uint32_t> point_of_;  // by pixel; kNoPoint: it shows none that light falls on
  // By point, row by row:
  std::vector<Groups> asked_;
  std::vector<uint32_t> sums_before_;
  std::vector<Light> lights_;
  std::vector<Light> sums_;  // of each point in turn, by the groups that it asks
  std::vector<double> noise_of_rows_;
};

void finish(const Solid& solid, const View& view, const StudioSettings& settings,
            const TraceOptions& options, const SparseHits& hits, Image& image, TraceStats& stats) {
  if (options.stop.stop_requested()) return;
  const auto start = std::chrono::steady_clock::now();
  with_threads(options.threads,
               [&] { Studio(solid, view, settings, options, hits, image).finish(); });
  stats.trace_ms +=
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

void finish_studio(const Solid& solid, const View& view, const StudioSettings& settings,
                   const TraceOptions& options, Image& image, TraceStats& stats) {
  SparseHits hits;
  TraceStats of_hits;
  trace(solid, view, options, hits, of_hits);
  stats.rays += of_hits.rays;
  stats.intersections += of_hits.intersections;
  stats.trace_ms += of_hits.cull_ms + of_hits.trace_ms;
  finish(solid, view, settings, options, hits, image, stats);
}

void draw_studio(const Solid& solid, const View& view, const FrameSettings& frame,
                 const StudioSettings& settings, const TraceOptions& options, Image& image,
                 TraceStats& stats) {
  SparseHits hits;
  draw(solid, view, frame, options, image, hits, stats);
  finish(solid, view, settings, options, hits, image, stats);
}

}  // namespace csgcore
