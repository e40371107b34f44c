// The OpenGL picture against the CPU tracer's, channel by channel.
#pragma once

#include <cstdint>

#include "csgcore/tracer.hpp"
#include "fixture.hpp"

namespace gl_test {

/// Levels of 255: both round the same colour but for 1e-4.
constexpr int kLevels = 1;

/// What the pictures' pixels have in common, of the channels of their hits at most.
struct Agreement {
  uint64_t hits = 0;
  uint64_t other_face = 0;  // of the same primitive
  double surface = 0;       // along the normal, a share of the model's size, as the next two
  double depth = 0;         // beyond what rounding does to it, times the cosine
  double normal = 0;        // times the cosine
  int levels = 0;
};

/// What counts as an edge, where either side is right.
struct EdgeLimits {
  /// Unit normals further apart are of two faces.
  double face_distance;
  /// Pixels at an edge whose ray float takes to the other side of it: of so many hits one.
  uint64_t hits_per_edge_pixel = 2000;
};

/// Expects the same background at the misses of both.
Agreement agreement(const csgcore::Image& gl, const csgcore::Image& cpu, const csgcore::View& view,
                    double model_size, const EdgeLimits& edges);

/// Expects that what the pictures show differs no more than float explains (see the .cpp).
void expect_agreement(const csgcore::Image& gl, const csgcore::Image& cpu,
                      const csgcore::View& view, double model_size, const EdgeLimits& edges,
                      const std::string& name);

/// How far apart the colours of the pixel are, of 255.
int levels_apart(const csgcore::Image& a, const csgcore::Image& b, size_t pixel);

/// The same frame by the CPU tracer.
csgcore::Image draw_by_cpu(const LoadedScene& loaded, const csgcore::View& view,
                           csgcore::Boundary boundary = csgcore::Boundary::kFirst);

}  // namespace gl_test
