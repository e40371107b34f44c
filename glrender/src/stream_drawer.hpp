// Draws streams of instances.
#pragma once

#include "frame.hpp"
#include "gl_object.hpp"
#include "glrender/frame_settings.hpp"
#include "shader_program.hpp"
#include "solid_buffers.hpp"
#include "traversal.hpp"

namespace glrender {

/// One pass over the cells or tiles, with a ray for each pixel.
struct Pass {
  Frame frame;
  FrameSettings settings;
  double overlap = 0;       // see csgcore::cell_overlap
  double tolerance = 0;     // thinner pieces do not exist; world units
  Vec3 light_world{0.0};    // csgcore::phong_light
  bool tiles = false;       // tiles of the screen, not cells
  bool eye_inside = false;  // rays start in the solid, and its complement is drawn
  GLuint first = 0;         // measured texture of the picture in front of this one; 0: none
};

/// Owns the buffer of instances.
class StreamDrawer {
 public:
  /// The programs must outlive this object.
  explicit StreamDrawer(ProgramCache& programs);

  /// Sets the GL state that the pass needs, and leaves the bound framebuffer.
  void begin(const Pass& pass) const;
  /// Replaces the instances.
  void upload(const InstanceStreams& streams);
  /// Draws the instances, which must be those uploaded, into the bound framebuffer. It takes one
  /// instanced call for each path and side, however many cells there are.
  void draw(const InstanceStreams& streams, const Pass& pass, const SolidBuffers& buffers,
            FrameStats& stats);

 private:
  void use_program(Path path, bool front, const Pass& pass, const SolidBuffers& buffers);
  void point_attributes(size_t offset) const;

  Buffer instances_, strip_;
  VertexArray vertex_array_;
  ProgramCache& programs_;
  bool conservative_depth_;
};

}  // namespace glrender
