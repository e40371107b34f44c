#include "solid_buffers.hpp"

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "glrender/context.hpp"
#include "shader_constants.hpp"

namespace glrender {
namespace {

using csgcore::CanonicalPrimitive;
using csgcore::Literal;
using csgcore::Shape;

uint32_t pack_rgba8(const csgcore::Color& color) {
  const float channels[] = {color.r, color.g, color.b, color.a};
  uint32_t packed = 0;
  for (int i = 0; i < 4; ++i) {
    const float clamped = std::fmin(std::fmax(channels[i], 0.0f), 1.0f);
    packed |= static_cast<uint32_t>(std::lround(clamped * 255.0f)) << (8 * i);
  }
  return packed;
}

constexpr const char* kFewerPrimitives = "draw the design in parts";

}  // namespace

void TextureBuffer::upload(GLenum format, const void* data, size_t bytes, size_t texel_bytes,
                           const char* what, const char* todo) {
  GLint limit = 0;
  glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &limit);
  if (bytes / texel_bytes > static_cast<size_t>(limit)) {
    throw GlError(std::string("the ") + what + " need a buffer of " +
                  std::to_string(bytes / texel_bytes) + " texels, and this OpenGL driver allows " +
                  std::to_string(limit) + " (" + todo + ")");
  }
  if (!buffer_) {
    buffer_ = Buffer::make();
    texture_ = Texture::make();
  }
  glBindBuffer(GL_TEXTURE_BUFFER, buffer_.name());
  glBufferData(GL_TEXTURE_BUFFER, static_cast<GLsizeiptr>(bytes), data, GL_STATIC_DRAW);
  glBindTexture(GL_TEXTURE_BUFFER, texture_.name());
  glTexBuffer(GL_TEXTURE_BUFFER, format, buffer_.name());
}

void TextureBuffer::bind(GLuint unit) const {
  glActiveTexture(GL_TEXTURE0 + unit);
  glBindTexture(GL_TEXTURE_BUFFER, texture_.name());
}

SolidBuffers::SolidBuffers(const csgcore::Solid& solid) : solid_(&solid) {
  std::vector<std::array<uint32_t, 4>> surfaces;
  surfaces.reserve(solid.primitives().size());
  for (const CanonicalPrimitive& primitive : solid.primitives()) {
    surfaces.push_back({primitive.color ? pack_rgba8(*primitive.color) : 0u,
                        primitive.color ? 1u : 0u, primitive.id, 0u});
    (primitive.enclosure == Shape::kSphere ? has_sphere_ : has_frustum_) = true;
    faces_.first_of(primitive.polyhedron.get());
  }
  surfaces_.upload(GL_RGBA32UI, surfaces.data(), surfaces.size() * sizeof surfaces[0],
                   sizeof surfaces[0], "primitives", kFewerPrimitives);
  if (has_polyhedron()) {
    polyhedra_.upload(GL_RGBA32F, faces_.texels().data(),
                      faces_.texels().size() * sizeof(PolyhedronTexels::Texel),
                      sizeof(PolyhedronTexels::Texel), "faces of polyhedra", "use a smaller $fn");
  }
}

void SolidBuffers::place(const Frame& frame) {
  if (placed_at_ == frame.focus) return;
  std::vector<float> texels;
  texels.reserve(solid_->primitives().size() * kPrimitiveTexels * 4);
  for (const CanonicalPrimitive& primitive : solid_->primitives()) {
    const glm::vec3 center = frame.relative(primitive.center);
    texels.insert(texels.end(), {center.x, center.y, center.z,
                                 static_cast<float>(faces_.first_of(primitive.polyhedron.get()))});
    const double beside[] = {primitive.radius_mid, primitive.radius_slope,
                             primitive.enclosure == Shape::kSphere ? kShapeSphere : kShapeFrustum};
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) {
        texels.push_back(static_cast<float>(primitive.world_to_canonical[column][row]));
      }
      texels.push_back(static_cast<float>(beside[row]));
    }
  }
  primitives_.upload(GL_RGBA32F, texels.data(), texels.size() * sizeof(float), 4 * sizeof(float),
                     "primitives", kFewerPrimitives);
  placed_at_ = frame.focus;
}

void SolidBuffers::upload_literals(std::span<const Literal> literals) {
  std::vector<std::array<uint32_t, 4>> texels;
  texels.reserve(literals.size());
  for (const Literal& literal : literals) {
    texels.push_back({literal.primitive | (static_cast<uint32_t>(literal.complement) << 31),
                      literal.if_inside, literal.if_outside, 0u});
  }
  literals_.upload(GL_RGBA32UI, texels.data(), texels.size() * sizeof texels[0], sizeof texels[0],
                   "cells", "use a larger --leaf-primitives or --threshold");
}

void SolidBuffers::bind(GLuint program) const {
  primitives_.bind(0);
  surfaces_.bind(1);
  literals_.bind(2);
  if (has_polyhedron()) polyhedra_.bind(3);
  glUniform1i(glGetUniformLocation(program, "u_primitives"), 0);
  glUniform1i(glGetUniformLocation(program, "u_surfaces"), 1);
  glUniform1i(glGetUniformLocation(program, "u_literals"), 2);
  if (has_polyhedron()) glUniform1i(glGetUniformLocation(program, "u_polyhedra"), 3);
}

}  // namespace glrender
