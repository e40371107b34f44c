// Holds a solid's primitives and Blists in buffers that the shaders read.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "csgcore/solid.hpp"
#include "frame.hpp"
#include "gl_object.hpp"
#include "shader_kinds.hpp"
#include "shape_texels.hpp"

namespace glrender {

/// A buffer with the texture through which shaders read it.
class TextureBuffer {
 public:
  /// `texel_bytes` is the size of the format's texel, and `most_texels` what the driver allows;
  /// `what` and `todo` are for messages.
  TextureBuffer(GLenum format, size_t texel_bytes, uint64_t most_texels, const char* what,
                const char* todo)
      : format_(format),
        texel_bytes_(texel_bytes),
        most_texels_(most_texels),
        what_(what),
        todo_(todo) {}

  /// Replaces the contents. Throws GlError if they exceed what the driver allows.
  void upload(const void* data, size_t bytes);
  void bind(GLuint unit) const;

 private:
  GLenum format_;
  size_t texel_bytes_;
  uint64_t most_texels_;
  const char* what_;
  const char* todo_;
  Buffer buffer_;
  Texture texture_;
};

/// Selects the buffer of Blists: the cells' or the tiles'.
enum class ListsOf : uint8_t { kCells, kTiles };

class SolidBuffers {
 public:
  /// bind() uses the texture units from 0 up to this one (exclusive).
  static constexpr int kTextureUnits = 6;

  /// `solid` must outlive this object. Primitives thinner than `thickness_tolerance`, in world
  /// units, are left out. A buffer must not have more than `most_texels`.
  SolidBuffers(const csgcore::Solid& solid, double thickness_tolerance, uint64_t most_texels);

  /// Uploads the primitives relative to the frame's focus, unless they are there already.
  void place(const Frame& frame);
  /// Replaces the Blists of the cells or of the tiles.
  void upload_tests(std::span<const csgcore::BlistTest> tests, ListsOf of = ListsOf::kCells);
  /// Binds the buffers and sets the samplers of the program in use.
  void bind(GLuint program, ListsOf of) const;

  /// The kinds of the convex primitives' enclosures.
  KindSet enclosures() const { return enclosures_; }
  /// The kinds of the primitives whose enclosure is of another kind.
  KindSet cuts() const { return cuts_; }
  /// The kinds of the primitives that are not convex.
  KindSet nonconvex() const { return nonconvex_; }
  /// Whether lists of cells keep their segments: see short_list().
  bool are_segments_dear() const { return !cuts_.empty() || !nonconvex_.empty(); }

 private:
  /// Notes which kinds the primitive needs, and adds its faces to faces_,
  /// meshes_ or profiles_.
  void take_in(const csgcore::CanonicalPrimitive& primitive);
  using TestTexel = std::array<uint32_t, 4>;
  bool has_faces() const { return !faces_.empty(); }
  bool has_meshes() const { return !meshes_.empty(); }
  bool has_profiles() const { return !profiles_.empty(); }
  void append_texels(uint32_t index, const Vec3& focus, std::vector<float>& texels);

  const csgcore::Solid* solid_;
  PolyhedronTexels faces_;
  MeshTexels meshes_;
  ProfileTexels profiles_;
  TextureBuffer primitives_, surfaces_, tests_, tile_tests_, polyhedra_, triangles_, pieces_;
  std::vector<bool> is_too_thin_;  // by primitive's index
  std::optional<Vec3> placed_at_;
  KindSet enclosures_, cuts_, nonconvex_;
};

}  // namespace glrender
