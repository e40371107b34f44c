// Compares GL pictures with the brute-force oracle.
#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "csgcore/image.hpp"
#include "csgcore/scene.hpp"
#include "csgcore/subdivision.hpp"
#include "glrender/renderer.hpp"
#include "support/reference.hpp"

namespace gl_test {

/// Returns the context that all tests of a program share.
glrender::HeadlessContext& context();

/// Returns a view from the direction given by two angles (degrees: around z, above the xy plane)
/// towards the centre of the model, from `distance` model diagonals away. The model fills most of
/// the picture.
csgcore::View view_from(const csgcore::Scene& scene, csgcore::Projection projection,
                        double around_deg, double above_deg, double distance = 3);

/// Returns the same view of a model with that box.
csgcore::View view_from(const csgcore::Box& box, csgcore::Projection projection, double around_deg,
                        double above_deg, double distance = 3);

/// The way to draw a picture: by cells of these options, or by tiles, which have none.
struct Way {
  Way(const csgcore::SubdivisionOptions& cells) : options(cells) {}
  csgcore::SubdivisionOptions options;
  glrender::Technique technique = glrender::Technique::kCells;
};
Way by_tiles();
/// A name for messages: "tiles", "K = 8".
std::string name_of(const Way& way);
void PrintTo(const Way& way, std::ostream* out);
/// A name for a test whose parameter is a Way: "Tiles", "K8".
std::string test_name(const testing::TestParamInfo<Way>& instance);

/// A scene's model, ready to be drawn, with its cells loaded if they are drawn. By default it is
/// drawn with all channels, on black.
struct LoadedScene {
  LoadedScene(const csgcore::Scene& scene, const Way& way);
  LoadedScene(const LoadedScene&) = delete;  // its members refer to each other
  LoadedScene& operator=(const LoadedScene&) = delete;
  csgcore::Image draw(const csgcore::View& view) { return renderer.draw(view, settings, stats); }

  csgcore::Solid solid;
  csgcore::Subdivision subdivision;
  glrender::Renderer renderer;
  glrender::FrameSettings settings;
  glrender::FrameStats stats;  // of the last frame
};

/// Draws one frame of the scene.
csgcore::Image draw(const csgcore::Scene& scene, const csgcore::View& view, const Way& way);

/// The default rule with the given K.
csgcore::SubdivisionOptions leaves_of(uint32_t leaf_primitives);

/// Cells of few and of many primitives, and tiles. Where a test does less, cells of few primitives,
/// and tiles.
const std::vector<Way>& all_ways();

/// A map that only moves.
csgcore::Affine at(double x, double y, double z);
/// A sheared, mirrored, uneven map.
csgcore::Affine skewed();
csgcore::Primitive cube(const csgcore::Vec3& min, const csgcore::Vec3& max);

struct Comparison {
  uint64_t hits = 0;         // hits of the oracle
  uint64_t hit_or_miss = 0;  // pixels that only one of both hits
  uint64_t position = 0;     // positions further apart than 1e-4 of the model's diagonal
  uint64_t id = 0;           // same position, another primitive
  uint64_t normal = 0;       // same primitive, normals more than 0.5° apart
  std::string first;         // where and how the first wrong pixel is wrong
  uint64_t wrong() const { return hit_or_miss + position; }
};

/// Counts the pixels that show another primitive than the oracle's picture, or a hit for a miss.
struct Speckle {
  uint64_t hits = 0;   // hits of the oracle
  uint64_t wrong = 0;  // all such pixels, including those at an edge, whose ray just misses what is
                       // right
  /// Those that show what the oracle shows in none of the pixels around: no edge excuses them.
  uint64_t speckle = 0;
  Speckle& operator+=(const Speckle& other);
};

Speckle speckle(const csgcore::Image& picture, const csgcore::Image& oracle);

Comparison compare(const csgcore::Image& picture, const csgcore::Image& oracle, double model_size);

/// Draws and compares. Expects at most 1 wrong pixel in 10,000 hits (the bar) and
/// consistent channels.
void expect_right(const csgcore::Scene& scene, const csgcore::View& view, const Way& way);

}  // namespace gl_test
