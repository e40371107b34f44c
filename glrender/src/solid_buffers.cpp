#include "solid_buffers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "csgcore/canonical_primitive.hpp"
#include "glrender/gl_error.hpp"
#include "shader_constants.hpp"

namespace glrender {
namespace {

using csgcore::BlistTest;
using csgcore::CanonicalPrimitive;

/// 16 bits of a channel from 0 to kBrightestColor.
uint32_t fixed_point(float channel) {
  const float share = std::fmin(std::fmax(channel / kBrightestColor, 0.0f), 1.0f);
  return static_cast<uint32_t>(std::lround(share * 65535.0f));
}

using Surface = std::array<uint32_t, 4>;

/// Red and green; blue, which channels are the primitive's own, and its cut faces; id.
Surface surface_of(const CanonicalPrimitive& primitive) {
  const csgcore::Color color = primitive.color.value_or(csgcore::Color{-1, -1, -1, 1});
  uint32_t flags = static_cast<uint32_t>(primitive.cut_faces) << kCutFacesShift;
  const float channels[] = {color.r, color.g, color.b};
  for (uint32_t i = 0; i < 3; ++i) flags |= static_cast<uint32_t>(channels[i] >= 0) << i;
  const bool has_face_colors =
      !primitive.color && primitive.mesh() && !primitive.mesh()->colors().empty();
  if (has_face_colors) flags |= kFaceColorsFlag;
  return {fixed_point(color.r) | fixed_point(color.g) << 16,
          fixed_point(color.b) | flags << kSurfaceFlagsShift, primitive.id, 0u};
}

std::vector<bool> too_thin(const csgcore::Solid& solid, double thickness_tolerance) {
  std::vector<bool> result;
  result.reserve(solid.primitives().size());
  for (const CanonicalPrimitive& primitive : solid.primitives()) {
    result.push_back(is_thinner(primitive, thickness_tolerance));
  }
  return result;
}

constexpr const char* kFewerPrimitives = "draw the design in parts";

/// Returns the primitive's mesh; null if it has none.
std::shared_ptr<const csgcore::TriangleMesh> mesh_of(const CanonicalPrimitive& primitive) {
  if (!primitive.mesh()) return nullptr;
  return std::static_pointer_cast<const csgcore::TriangleMesh>(primitive.shared_shape);
}

/// Returns the primitive's profile; null if it has none.
std::shared_ptr<const csgcore::Profile> profile_of(const CanonicalPrimitive& primitive) {
  if (!primitive.profile()) return nullptr;
  return std::static_pointer_cast<const csgcore::Profile>(primitive.shared_shape);
}

template <typename Texels>
void upload_texels(Texels& shapes, TextureBuffer& buffer) {
  if (shapes.empty()) return;
  const auto texels = shapes.take_added();
  buffer.upload(texels.data(), texels.size() * sizeof(typename Texels::Texel));
}

}  // namespace

void TextureBuffer::upload(const void* data, size_t bytes) {
  if (bytes / texel_bytes_ > most_texels_) {
    throw GlError(std::string("the ") + what_ + " need a buffer of " +
                  std::to_string(bytes / texel_bytes_) + " texels, and this OpenGL driver allows " +
                  std::to_string(most_texels_) + " (" + todo_ + ")");
  }
  if (!buffer_) {
    buffer_ = Buffer::make();
    texture_ = Texture::make();
  }
  glBindBuffer(GL_TEXTURE_BUFFER, buffer_.name());
  glBufferData(GL_TEXTURE_BUFFER, static_cast<GLsizeiptr>(bytes), data, GL_STATIC_DRAW);
  glBindTexture(GL_TEXTURE_BUFFER, texture_.name());
  glTexBuffer(GL_TEXTURE_BUFFER, format_, buffer_.name());
}

void TextureBuffer::bind(GLuint unit) const {
  glActiveTexture(GL_TEXTURE0 + unit);
  glBindTexture(GL_TEXTURE_BUFFER, texture_.name());
}

SolidBuffers::SolidBuffers(const csgcore::Solid& solid, double thickness_tolerance,
                           uint64_t most_texels)
    : solid_(&solid),
      primitives_(GL_RGBA32F, 4 * sizeof(float), most_texels, "primitives", kFewerPrimitives),
      surfaces_(GL_RGBA32UI, sizeof(Surface), most_texels, "primitives", kFewerPrimitives),
      tests_(GL_RGBA32UI, sizeof(TestTexel), most_texels, "cells",
             "use a larger --leaf-primitives or --threshold"),
      tile_tests_(GL_RGBA32UI, sizeof(TestTexel), most_texels, "tiles",
                  "use a smaller --imgsize, or --technique=cells"),
      polyhedra_(GL_RGBA32F, sizeof(PolyhedronTexels::Texel), most_texels, "faces of polyhedra",
                 "use a smaller $fn"),
      triangles_(GL_RGBA32F, sizeof(MeshTexels::Texel), most_texels, "triangles of meshes",
                 "use coarser meshes"),
      pieces_(GL_RGBA32F, sizeof(ProfileTexels::Texel), most_texels, "edges of profiles",
              "use a smaller $fn"),
      is_too_thin_(too_thin(solid, thickness_tolerance)) {
  std::vector<Surface> surfaces;
  surfaces.reserve(solid.primitives().size());
  for (const CanonicalPrimitive& primitive : solid.primitives()) {
    surfaces.push_back(surface_of(primitive));
    take_in(primitive);
  }
  surfaces_.upload(surfaces.data(), surfaces.size() * sizeof(Surface));
  if (has_faces()) {
    polyhedra_.upload(faces_.texels().data(),
                      faces_.texels().size() * sizeof(PolyhedronTexels::Texel));
  }
  upload_texels(meshes_, triangles_);
  upload_texels(profiles_, pieces_);
}

void SolidBuffers::take_in(const CanonicalPrimitive& primitive) {
  if (primitive.is_convex) {
    enclosures_.add(primitive.enclosure);
  } else {
    nonconvex_.add(primitive.shape);
  }
  if (primitive.is_convex && primitive.shape != primitive.enclosure) cuts_.add(primitive.shape);
  meshes_.first_of(mesh_of(primitive));
  profiles_.first_of(profile_of(primitive));
  faces_.first_of(primitive.polyhedron.get());
}

void SolidBuffers::append_texels(uint32_t index, const Vec3& focus, std::vector<float>& texels) {
  const CanonicalPrimitive& primitive = solid_->primitives()[index];
  const csgcore::Shape kind = primitive.is_convex ? primitive.enclosure : primitive.shape;
  const float shape = is_too_thin_[index] ? kShapeNone : static_cast<float>(kind);
  const glm::vec3 center(primitive.center - focus);
  const uint32_t faces = primitive.mesh()      ? meshes_.first_of(mesh_of(primitive))
                         : primitive.profile() ? profiles_.first_of(profile_of(primitive))
                                               : faces_.first_of(primitive.polyhedron.get());
  texels.insert(texels.end(), {center.x, center.y, center.z, static_cast<float>(faces)});
  const auto [first, second] = shader_numbers(primitive);
  const double beside[] = {first, second, shape};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      texels.push_back(static_cast<float>(primitive.world_to_canonical[column][row]));
    }
    texels.push_back(static_cast<float>(beside[row]));
  }
}

void SolidBuffers::place(const Frame& frame) {
  if (placed_at_ == frame.focus) return;
  std::vector<float> texels;
  texels.reserve(solid_->primitives().size() * kPrimitiveTexels * 4);
  for (uint32_t i = 0; i < solid_->primitives().size(); ++i) {
    append_texels(i, frame.focus, texels);
  }
  primitives_.upload(texels.data(), texels.size() * sizeof(float));
  placed_at_ = frame.focus;
}

void SolidBuffers::upload_tests(std::span<const BlistTest> tests, ListsOf of) {
  std::vector<TestTexel> texels;
  texels.reserve(tests.size());
  for (const BlistTest& test : tests) {
    texels.push_back({test.primitive | (static_cast<uint32_t>(test.complement) << 31),
                      test.if_inside, test.if_outside,
                      static_cast<uint32_t>(solid_->primitives()[test.primitive].is_convex)});
  }
  (of == ListsOf::kTiles ? tile_tests_ : tests_)
      .upload(texels.data(), texels.size() * sizeof(TestTexel));
}

void SolidBuffers::bind(GLuint program, ListsOf of) const {
  primitives_.bind(0);
  surfaces_.bind(1);
  (of == ListsOf::kTiles ? tile_tests_ : tests_).bind(2);
  if (has_faces()) polyhedra_.bind(3);
  if (has_meshes()) triangles_.bind(4);
  if (has_profiles()) pieces_.bind(5);
  glUniform1i(glGetUniformLocation(program, "u_primitives"), 0);
  glUniform1i(glGetUniformLocation(program, "u_surfaces"), 1);
  glUniform1i(glGetUniformLocation(program, "u_tests"), 2);
  if (has_faces()) glUniform1i(glGetUniformLocation(program, "u_polyhedra"), 3);
  if (has_meshes()) glUniform1i(glGetUniformLocation(program, "u_meshes"), 4);
  if (has_profiles()) glUniform1i(glGetUniformLocation(program, "u_profiles"), 5);
}

}  // namespace glrender
