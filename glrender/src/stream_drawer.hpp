// Instance streams on the GPU, and what a pass over them draws.
#pragma once

#include "frame.hpp"
#include "gl_object.hpp"
#include "glrender/frame_settings.hpp"
#include "shader_program.hpp"
#include "solid_buffers.hpp"
#include "traversal.hpp"

namespace glrender {

/// One pass over the cells or tiles: a ray for each pixel.
struct Pass {
  Frame frame;
  FrameSettings settings;
  double overlap = 0;       // of the cells: csgcore::cell_overlap
  double tolerance = 0;     // thinnest piece that exists, world units
  Vec3 light_world{0.0};    // csgcore::phong_light
  bool tiles = false;       // of the screen, not cells
  bool eye_inside = false;  // rays start in the solid: what is seen is its complement
  GLuint first = 0;         // measured texture of the picture that this one lies behind; 0: none
};

/// Owns the buffer of instances and the programs.
class StreamDrawer {
 public:
  StreamDrawer();

  /// Sets the state that the pass needs, in whatever framebuffer is bound.
  void begin(const Pass& pass) const;
  /// Replaces the instances.
  void upload(const InstanceStreams& streams);
  /// Draws the instances, which must be those uploaded, into the framebuffer that is bound: one
  /// instanced call for each path and side, so that the calls do not grow with the cells.
  void draw(const InstanceStreams& streams, const Pass& pass, const SolidBuffers& buffers,
            FrameStats& stats);

 private:
  void use_program(Path path, bool front, const Pass& pass, const SolidBuffers& buffers);
  void point_attributes(size_t offset) const;

  Buffer instances_, strip_;
  VertexArray vertex_array_;
  ProgramCache programs_;
  bool conservative_depth_;
};

}  // namespace glrender
