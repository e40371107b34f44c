// Compares the OpenGL picture with the CPU tracer's, channel by channel.
#pragma once

#include <cstdint>

#include "csgcore/tracer.hpp"
#include "fixture.hpp"

namespace gl_test {

/// Levels of 255: both renderers round the same colour, up to 1e-4.
constexpr int kLevels = 1;

/// What two pictures have in common, and the largest differences between the channels of their
/// hits.
struct Agreement {
  uint64_t hits = 0;
  uint64_t other_face = 0;  // another face of the same primitive
  double surface = 0;       // along the normal, as a share of the model's size; so are the next two
  double depth = 0;         // beyond its rounding, times the cosine
  double normal = 0;        // times the cosine
  int levels = 0;
};

/// Which pixels are at an edge, where either side is right.
struct EdgeLimits {
  /// Unit normals further apart belong to different faces.
  double face_distance;
  /// The hits per pixel at an edge whose ray float takes to the other side of it.
  uint64_t hits_per_edge_pixel = 2000;
  /// Along the normal, as a share of the model's size: half of GL's own tolerance
  /// (kThicknessTolerance).
  double surface_error = 0x1p-22;
};

/// Compares the pictures, and expects the same background at the misses of both.
Agreement agreement(const csgcore::Image& gl, const csgcore::Image& cpu, const csgcore::View& view,
                    double model_size, const EdgeLimits& edges);

/// Expects that the pictures differ no more than float explains (see the .cpp).
void expect_agreement(const csgcore::Image& gl, const csgcore::Image& cpu,
                      const csgcore::View& view, double model_size, const EdgeLimits& edges,
                      const std::string& name);

/// Returns how far apart the colours of the pixel are, in levels of 255.
int levels_apart(const csgcore::Image& a, const csgcore::Image& b, size_t pixel);

/// Draws the same frame by the CPU tracer.
csgcore::Image draw_by_cpu(const LoadedScene& loaded, const csgcore::View& view,
                           csgcore::Boundary boundary = csgcore::Boundary::kFirst);

}  // namespace gl_test
