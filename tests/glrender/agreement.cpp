#include "agreement.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>

namespace gl_test {
namespace {

using csgcore::Image;
using csgcore::Vec3;

// What float does to a hit. A ray's own coordinates are relative to the scene's middle, so that
// they are rounded to 2^-25 of its size, and some tens of operations lead from them to the
// boundary.

/// The rounding of a number that the picture stores as a float.
constexpr double kFloatRounding = 0x1p-24;
/// The length of the difference of unit normals, times their cosine to the ray: for a point that is
/// off by EdgeLimits::surface_error, on surfaces with radii down to 2^-10 of the model's size.
constexpr double kNormalError = 0x1p-12;

}  // namespace

int levels_apart(const Image& a, const Image& b, size_t i) {
  int most = 0;
  for (int c = 0; c < 3; ++c) most = std::max(most, std::abs(int{a.rgb[i][c]} - b.rgb[i][c]));
  return most;
}

Agreement agreement(const Image& gl, const Image& cpu, const csgcore::View& view, double model_size,
                    const EdgeLimits& edges) {
  Agreement result;
  for (size_t i = 0; i < cpu.id.size(); ++i) {
    if (gl.id[i] != cpu.id[i]) continue;
    if (cpu.id[i] == csgcore::kNoPrimitive) {
      EXPECT_TRUE(std::isinf(gl.z[i]) && std::isinf(cpu.z[i]));
      EXPECT_EQ(gl.rgb[i], cpu.rgb[i]);
      continue;
    }
    ++result.hits;
    const Vec3 normal(cpu.normal[i]);
    const double normal_error = glm::length(Vec3(gl.normal[i]) - normal);
    if (normal_error > edges.face_distance) {
      ++result.other_face;
      continue;
    }
    const csgcore::Ray ray =
        csgcore::pixel_ray(view, double(i % view.width_px), double(i / view.width_px));
    const double cosine = std::abs(glm::dot(normal, ray.direction));
    const Vec3 apart = Vec3(gl.position[i]) - Vec3(cpu.position[i]);
    const double rounding = 2 * kFloatRounding * glm::length(Vec3(cpu.position[i]));
    const double surface = std::max(0.0, std::abs(glm::dot(apart, normal)) - rounding);
    const double depth = std::abs(double(gl.z[i]) - double(cpu.z[i]));
    const double depth_rounding = 2 * kFloatRounding * std::abs(double(cpu.z[i]));
    result.surface = std::max(result.surface, surface / model_size);
    result.depth =
        std::max(result.depth, std::max(0.0, depth - depth_rounding) * cosine / model_size);
    result.normal = std::max(result.normal, normal_error * cosine);
    result.levels = std::max(result.levels, levels_apart(gl, cpu, i));
  }
  return result;
}

void expect_agreement(const Image& gl, const Image& cpu, const csgcore::View& view,
                      double model_size, const EdgeLimits& edges, const std::string& name) {
  const Speckle ids = speckle(gl, cpu);
  const Agreement same = agreement(gl, cpu, view, model_size, edges);
  std::printf(
      "%s: %llu hits, %llu of another primitive, %llu of another face; off by %.1e along "
      "the normal, %.1e in depth, normals by %.1e, colours by %d\n",
      name.c_str(), static_cast<unsigned long long>(ids.hits),
      static_cast<unsigned long long>(ids.wrong), static_cast<unsigned long long>(same.other_face),
      same.surface, same.depth, same.normal, same.levels);
  EXPECT_GT(same.hits, 1000u) << name;
  EXPECT_EQ(ids.speckle, 0u) << name;
  EXPECT_LE((ids.wrong + same.other_face) * edges.hits_per_edge_pixel, ids.hits) << name;
  EXPECT_LE(same.surface, edges.surface_error) << name;
  EXPECT_LE(same.depth, edges.surface_error) << name;
  EXPECT_LE(same.normal, kNormalError) << name;
  EXPECT_LE(same.levels, kLevels) << name;
}

Image draw_by_cpu(const LoadedScene& loaded, const csgcore::View& view,
                  csgcore::Boundary boundary) {
  csgcore::TraceOptions options;
  options.samples = loaded.settings.samples;
  options.boundary = boundary;
  Image image;
  csgcore::TraceStats stats;
  csgcore::draw(loaded.solid, view, loaded.settings, options, image, stats);
  return image;
}

}  // namespace gl_test
