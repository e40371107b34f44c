#include "stream_drawer.hpp"

#include <cstddef>
#include <glm/geometric.hpp>
#include <iterator>

namespace glrender {
namespace {

/// The corners of a box as one triangle strip, wound counter-clockwise as seen from outside. Bits
/// 0, 1 and 2 of a corner's number say whether it is at the upper end of x, y and z.
constexpr uint8_t kBoxStrip[] = {3, 7, 1, 5, 4, 7, 6, 3, 2, 1, 0, 4, 2, 6};

}  // namespace

StreamDrawer::StreamDrawer(ProgramCache& programs)
    : instances_(Buffer::make()),
      strip_(Buffer::make()),
      vertex_array_(VertexArray::make()),
      programs_(programs),
      conservative_depth_(epoxy_has_gl_extension("GL_ARB_conservative_depth") &&
                          epoxy_has_gl_extension("GL_ARB_clip_control")) {
  glBindVertexArray(vertex_array_.name());
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, strip_.name());
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, sizeof kBoxStrip, kBoxStrip, GL_STATIC_DRAW);
  for (const GLuint location : {kLocationLow, kLocationHigh, kLocationList}) {
    glEnableVertexAttribArray(location);
    glVertexAttribDivisor(location, 1);
  }
}

void StreamDrawer::begin(const Pass& pass) const {
  glBindVertexArray(vertex_array_.name());
  // Tiles do not overlap, so that they need no depth test.
  (pass.tiles ? glDisable : glEnable)(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
  glEnable(GL_DEPTH_CLAMP);
  glEnable(GL_CULL_FACE);
  // A mirroring view reverses the winding of a box on the screen. Tiles are wound on the screen.
  const csgcore::View& view = pass.frame.view;
  const bool is_mirrored = glm::dot(glm::cross(view.right, view.up), view.forward) > 0;
  glFrontFace(is_mirrored && !pass.tiles ? GL_CW : GL_CCW);
  if (conservative_depth_) glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
}

/// Writes all streams into one buffer, in the order in which draw() reads them.
void StreamDrawer::upload(const InstanceStreams& streams) {
  glBindBuffer(GL_ARRAY_BUFFER, instances_.name());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(streams.size() * sizeof(Instance)), nullptr,
               GL_STREAM_DRAW);
  GLintptr offset = 0;
  for (const auto* group : {&streams.front_faces, &streams.back_faces}) {
    for (const auto& stream : *group) {
      const auto bytes = static_cast<GLsizeiptr>(stream.size() * sizeof(Instance));
      if (bytes > 0) glBufferSubData(GL_ARRAY_BUFFER, offset, bytes, stream.data());
      offset += bytes;
    }
  }
}

void StreamDrawer::draw(const InstanceStreams& streams, const Pass& pass,
                        const SolidBuffers& buffers, FrameStats& stats) {
  size_t offset = 0;
  for (const bool front : {true, false}) {
    glCullFace(front ? GL_BACK : GL_FRONT);
    const auto& group = front ? streams.front_faces : streams.back_faces;
    for (int path = 0; path < kPaths; ++path) {
      const size_t count = group[static_cast<size_t>(path)].size();
      if (count == 0) continue;
      use_program(static_cast<Path>(path), front, pass, buffers);
      point_attributes(offset);
      if (pass.tiles) {
        glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(count));
      } else {
        glDrawElementsInstanced(GL_TRIANGLE_STRIP, std::size(kBoxStrip), GL_UNSIGNED_BYTE, nullptr,
                                static_cast<GLsizei>(count));
      }
      offset += count * sizeof(Instance);
      ++stats.draw_calls;
      (pass.tiles ? stats.tiles_drawn : stats.cells_drawn) += count;
    }
  }
}

void StreamDrawer::use_program(Path path, bool front, const Pass& pass,
                               const SolidBuffers& buffers) {
  ProgramKey key;
  key.path = path;
  key.tiles = pass.tiles;
  key.shading = pass.settings.shading;
  key.perspective = pass.frame.perspective();
  key.measured = pass.settings.measured_channels;
  key.enclosures = buffers.enclosures();
  key.cuts = buffers.cuts();
  key.nonconvex = buffers.nonconvex();
  key.clip_zero_to_one = conservative_depth_;
  key.behind = pass.first != 0;
  // A hit behind a cell's back face may be nearer than that face, so that its depth promises
  // nothing. With kBoxes the fragment's depth is the face's own, but for rounding.
  key.conservative_depth = conservative_depth_ && front && path != Path::kBoxes && !pass.tiles;
  const GLuint program = programs_.get(key);
  glUseProgram(program);
  set_frame_uniforms(program, pass.frame, pass.overlap);
  buffers.bind(program, pass.tiles ? ListsOf::kTiles : ListsOf::kCells);
  const auto set3 = [&](const char* name, const glm::vec3& v) {
    glUniform3f(glGetUniformLocation(program, name), v.x, v.y, v.z);
  };
  set3("u_front", pass.settings.front);
  set3("u_back", pass.settings.back);
  const glm::vec3 within = pass.settings.from_within.value_or(glm::vec3(0.0f));
  glUniform4f(glGetUniformLocation(program, "u_from_within"), within.r, within.g, within.b,
              pass.settings.from_within ? 1.0f : 0.0f);
  set3("u_edge", pass.settings.edge);
  set3("u_light_position", pass.frame.relative(pass.light_world));
  glUniform1f(glGetUniformLocation(program, "u_tolerance"), static_cast<float>(pass.tolerance));
  glUniform1i(glGetUniformLocation(program, "u_eye_inside"), pass.eye_inside);
  if (pass.first != 0) {
    glActiveTexture(GL_TEXTURE0 + SolidBuffers::kTextureUnits);
    glBindTexture(GL_TEXTURE_2D, pass.first);
    glUniform1i(glGetUniformLocation(program, "u_first"), SolidBuffers::kTextureUnits);
  }
}

void StreamDrawer::point_attributes(size_t offset) const {
  glBindBuffer(GL_ARRAY_BUFFER, instances_.name());
  const auto at = [&](size_t member) { return reinterpret_cast<const void*>(offset + member); };
  constexpr GLsizei kStride = sizeof(Instance);
  glVertexAttribPointer(kLocationLow, 3, GL_FLOAT, GL_FALSE, kStride, at(offsetof(Instance, low)));
  glVertexAttribPointer(kLocationHigh, 3, GL_FLOAT, GL_FALSE, kStride,
                        at(offsetof(Instance, high)));
  glVertexAttribIPointer(kLocationList, 2, GL_UNSIGNED_INT, kStride,
                         at(offsetof(Instance, first_test)));
}

}  // namespace glrender
