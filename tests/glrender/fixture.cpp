#include "fixture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <sstream>

#include "csgcore/polyhedron.hpp"
#include "support/full_run.hpp"

namespace gl_test {

using csgcore::Image;
using csgcore::Projection;
using csgcore::Scene;
using csgcore::SubdivisionOptions;
using csgcore::Vec3;
using csgcore::View;

glrender::HeadlessContext& context() {
  static glrender::HeadlessContext shared;
  return shared;
}

View view_from(const Scene& scene, Projection projection, double around_deg, double above_deg,
               double distance) {
  return view_from(csgcore::reference_box(scene), projection, around_deg, above_deg, distance);
}

View view_from(const csgcore::Box& box, Projection projection, double around_deg, double above_deg,
               double distance) {
  const double size = box.diagonal();
  const double around = around_deg * std::numbers::pi / 180;
  const double above = above_deg * std::numbers::pi / 180;
  const Vec3 towards_eye{std::cos(above) * std::cos(around), std::cos(above) * std::sin(around),
                         std::sin(above)};
  View view;
  view.projection = projection;
  view.forward = -towards_eye;
  view.right = {-std::sin(around), std::cos(around), 0};
  view.up = glm::cross(view.right, view.forward);
  view.eye = box.center() + distance * size * towards_eye;
  const double half_height = 0.55 * size;
  view.half_height =
      projection == Projection::kPerspective ? half_height / (distance * size) : half_height;
  view.width_px = 320;
  view.height_px = 240;
  return view;
}

SubdivisionOptions leaves_of(uint32_t leaf_primitives) {
  SubdivisionOptions options;
  options.leaf_primitives = leaf_primitives;
  return options;
}

Way by_tiles() {
  Way way{SubdivisionOptions{}};
  way.technique = glrender::Technique::kTiles;
  return way;
}

std::string name_of(const Way& way) {
  if (way.technique == glrender::Technique::kTiles) return "tiles";
  return "K = " + std::to_string(way.options.leaf_primitives);
}

void PrintTo(const Way& way, std::ostream* out) { *out << name_of(way); }

std::string test_name(const testing::TestParamInfo<Way>& instance) {
  if (instance.param.technique == glrender::Technique::kTiles) return "Tiles";
  return "K" + std::to_string(instance.param.options.leaf_primitives);
}

LoadedScene::LoadedScene(const Scene& scene, const Way& way)
    : solid(csgcore::canonical_primitives(scene), scene.model),
      subdivision(solid, way.options),
      renderer(context(), solid) {
  settings.technique = way.technique;
  if (way.technique == glrender::Technique::kCells) renderer.load(subdivision);
  settings.background = {0, 0, 0};
  settings.measured_channels = true;
}

Image draw(const Scene& scene, const View& view, const Way& way) {
  return LoadedScene(scene, way).draw(view);
}

namespace {

/// Returns whether the oracle shows `id` at the pixel or next to it.
bool shown_around(const Image& oracle, uint32_t x, uint32_t y, uint32_t id) {
  for (uint32_t v = y > 0 ? y - 1 : 0; v <= std::min(y + 1, oracle.height_px - 1); ++v) {
    for (uint32_t u = x > 0 ? x - 1 : 0; u <= std::min(x + 1, oracle.width_px - 1); ++u) {
      if (oracle.id[size_t{v} * oracle.width_px + u] == id) return true;
    }
  }
  return false;
}

}  // namespace

Speckle& Speckle::operator+=(const Speckle& other) {
  hits += other.hits;
  wrong += other.wrong;
  speckle += other.speckle;
  return *this;
}

Speckle speckle(const Image& picture, const Image& oracle) {
  Speckle result;
  for (uint32_t y = 0; y < oracle.height_px; ++y) {
    for (uint32_t x = 0; x < oracle.width_px; ++x) {
      const size_t i = size_t{y} * oracle.width_px + x;
      result.hits += oracle.id[i] != csgcore::kNoPrimitive;
      if (picture.id[i] == oracle.id[i]) continue;
      ++result.wrong;
      result.speckle += !shown_around(oracle, x, y, picture.id[i]);
    }
  }
  return result;
}

Comparison compare(const Image& picture, const Image& oracle, double model_size) {
  constexpr double kPositionError = 1e-4;  // as a share of the model's size
  const double least_cosine = std::cos(0.5 * std::numbers::pi / 180);
  Comparison result;
  for (size_t i = 0; i < oracle.z.size(); ++i) {
    const bool hit = std::isfinite(picture.z[i]);
    const bool expected = std::isfinite(oracle.z[i]);
    result.hits += expected;
    const char* wrong = nullptr;
    if (hit != expected) {
      ++result.hit_or_miss;
      wrong = "hit or miss";
    } else if (hit && glm::length(picture.position[i] - oracle.position[i]) >
                          kPositionError * model_size) {
      ++result.position;
      wrong = "position";
    } else if (hit && picture.id[i] != oracle.id[i]) {
      ++result.id;
    } else if (hit && glm::dot(picture.normal[i], oracle.normal[i]) < least_cosine) {
      ++result.normal;
    }
    if (wrong && result.first.empty()) {
      std::ostringstream text;
      text << wrong << " at pixel " << i % oracle.width_px << ", " << i / oracle.width_px << ": z "
           << picture.z[i] << " instead of " << oracle.z[i] << ", id " << picture.id[i]
           << " instead of " << oracle.id[i];
      result.first = text.str();
    }
  }
  return result;
}

void expect_right(const Scene& scene, const View& view, const Way& way) {
  SCOPED_TRACE(name_of(way));
  const Image picture = draw(scene, view, way);
  const Image oracle = csgcore::reference_render(scene, view);
  const Comparison result = compare(picture, oracle, csgcore::reference_box(scene).diagonal());
  EXPECT_LE(result.wrong() * 10000, std::max<uint64_t>(result.hits, 10000)) << result.first;
  // At an edge two primitives are equally right, as are their normals.
  EXPECT_LE(result.id * 1000, std::max<uint64_t>(result.hits, 1000));
  EXPECT_LE(result.normal * 1000, std::max<uint64_t>(result.hits, 1000));
}

const std::vector<Way>& all_ways() {
  static const std::vector<Way> all{leaves_of(2), leaves_of(8), by_tiles()};
  static const std::vector<Way> fewer{leaves_of(2), by_tiles()};
  return test_support::does_less() ? fewer : all;
}

csgcore::Affine at(double x, double y, double z) { return {csgcore::Mat3{1.0}, {x, y, z}}; }

csgcore::Affine skewed() {
  return {csgcore::Mat3{csgcore::Vec3{-1, 0.3, 0}, csgcore::Vec3{0.5, 2, 0.1},
                        csgcore::Vec3{0, 0.7, 1}},
          {7, 8, 9}};
}

csgcore::Primitive cube(const csgcore::Vec3& min, const csgcore::Vec3& max) {
  return csgcore::make_polyhedron(csgcore::Polyhedron::box({min, max}));
}

}  // namespace gl_test
