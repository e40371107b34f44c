// A solid's primitives as the shaders read them.
#pragma once

#include <optional>
#include <span>

#include "csgcore/solid.hpp"
#include "frame.hpp"
#include "gl_object.hpp"
#include "polyhedron_texels.hpp"

namespace glrender {

/// A buffer with the texture through which shaders read it.
class TextureBuffer {
 public:
  /// Replaces the contents. Throws GlError if they exceed what the driver can address.
  /// `what` and `todo` are for the message.
  void upload(GLenum format, const void* data, size_t bytes, size_t texel_bytes, const char* what,
              const char* todo);
  void bind(GLuint unit) const;

 private:
  Buffer buffer_;
  Texture texture_;
};

class SolidBuffers {
 public:
  /// Texture units 0 up to this one (exclusive) are bind's.
  static constexpr int kTextureUnits = 4;

  explicit SolidBuffers(const csgcore::Solid& solid);

  /// Uploads the primitives relative to the frame's focus, unless they are there already.
  void place(const Frame& frame);
  /// Replaces the cells' functions.
  void upload_literals(std::span<const csgcore::Literal> literals);
  /// Binds the buffers and sets the samplers of the program in use.
  void bind(GLuint program) const;

  /// Also those that enclose polyhedra.
  bool has_sphere() const { return has_sphere_; }
  bool has_frustum() const { return has_frustum_; }
  bool has_polyhedron() const { return !faces_.empty(); }

 private:
  const csgcore::Solid* solid_;
  PolyhedronTexels faces_;
  TextureBuffer primitives_, surfaces_, literals_, polyhedra_;
  std::optional<Vec3> placed_at_;
  bool has_sphere_ = false;
  bool has_frustum_ = false;
};

}  // namespace glrender
