// Shapes as the shaders read them: triangle meshes (mesh.glsl), convex polyhedra (polyhedron.glsl)
// and profiles (profile.glsl).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

#include "csgcore/polyhedron.hpp"
#include "csgcore/profile.hpp"
#include "csgcore/triangle_mesh.hpp"

namespace glrender {

/// The triangles of several meshes in canonical space, one mesh after the other. Meshes with the
/// same vertices and triangles are one.
///
/// A mesh starts with a texel that holds the number of texels that follow, 1 if the mesh is closed,
/// else 0, and the number of texels of a triangle. Then come the nodes of its BVH, depth first. A
/// node is two texels: the lower corner of its box, with the number of texels to skip after the
/// node if a ray misses the box; and the upper corner, with the number of the leaf's triangles (0:
/// a branch, whose children follow). After a leaf come its triangles, with three texels each: the
/// corners, and beside them the coordinates of the outward unit normal. If faces have colours, a
/// fourth one holds r, g and b, which are negative where the face has none. Texel 0 belongs to no
/// mesh.
class MeshTexels {
 public:
  using Texel = std::array<float, 4>;
  /// The shaders read texel numbers as floats, which hold integers up to 2^24 exactly.
  static constexpr size_t kMostTexels = size_t{1} << 24;

  explicit MeshTexels(size_t most_texels = kMostTexels) : most_texels_(most_texels) {}

  /// Returns the mesh's first texel; 0 if it is null. Adds a mesh that is not there yet, and keeps
  /// it alive. Throws GlError if there would be too many texels.
  uint32_t first_of(const std::shared_ptr<const csgcore::TriangleMesh>& mesh);

  /// Returns the texels that were added since the last call. They follow those that were there.
  std::vector<Texel> take_added() { return std::exchange(added_, {}); }
  /// The number of all texels.
  size_t size() const { return size_; }
  bool empty() const { return first_.empty(); }

 private:
  using Mesh = std::shared_ptr<const csgcore::TriangleMesh>;
  struct Hash {
    size_t operator()(const Mesh& mesh) const;
  };
  struct IsSame {
    bool operator()(const Mesh& a, const Mesh& b) const { return same_mesh(a.get(), b.get()); }
  };

  size_t most_texels_;
  size_t size_ = 1;
  std::vector<Texel> added_{Texel{}};
  std::unordered_map<Mesh, uint32_t, Hash, IsSame> first_;
};

/// The faces of several polyhedra, one polyhedron after the other. Each starts with a texel that
/// holds the number of texels that follow. Then come its entries (csgcore/polyhedron.hpp) in their
/// order, in canonical space. A face is its normal and 0. A branch is its normal and the number of
/// texels to skip after it, with its limit in a texel of its own. Texel 0 stands for a primitive
/// without faces.
class PolyhedronTexels {
 public:
  using Texel = std::array<float, 4>;
  /// The shaders read texel numbers as floats, which hold integers up to 2^24 exactly.
  static constexpr size_t kMostTexels = size_t{1} << 24;

  explicit PolyhedronTexels(size_t most_texels = kMostTexels) : most_texels_(most_texels) {}

  /// Returns the polyhedron's first texel; 0 if it is null. Adds a polyhedron that is not there
  /// yet, which must live as long as this object. Throws GlError if there would be too many texels.
  uint32_t first_of(const csgcore::Polyhedron* polyhedron);

  const std::vector<Texel>& texels() const { return texels_; }
  bool empty() const { return first_.empty(); }

 private:
  size_t most_texels_;
  std::vector<Texel> texels_{Texel{}};
  std::unordered_map<const csgcore::Polyhedron*, uint32_t> first_;
};

/// Estimates how many loop rounds the shaders take to cut a segment by the polyhedron's faces; 0 if
/// it is null.
uint64_t face_rounds(const csgcore::Polyhedron* polyhedron);

/// The pieces of several profiles in canonical space, one profile after the other. Profiles of the
/// same loops and fill rule are one.
///
/// A profile starts with a texel that holds the number of texels that follow, 1 for the fill rule
/// kNonZero, else 0, and Profile::radii(). Then come the nodes of its BVH, depth first. A node is
/// two texels: its box as (min, max); and the number of texels to skip after the node if a line
/// misses the box, with the number of the leaf's pieces (0: a branch, whose children follow). After
/// a leaf come its pieces, with three texels each: start and control point; end and weight; and the
/// ways from the start to the end and to the control point. Texel 0 belongs to no profile.
class ProfileTexels {
 public:
  using Texel = std::array<float, 4>;
  /// The shaders read texel numbers as floats, which hold integers up to 2^24 exactly.
  static constexpr size_t kMostTexels = size_t{1} << 24;

  explicit ProfileTexels(size_t most_texels = kMostTexels) : most_texels_(most_texels) {}

  /// Returns the profile's first texel; 0 if it is null. Adds a profile that is not there yet, and
  /// keeps it alive. Throws GlError if there would be too many texels.
  uint32_t first_of(const std::shared_ptr<const csgcore::Profile>& profile);

  /// Returns the texels that were added since the last call. They follow those that were there.
  std::vector<Texel> take_added() { return std::exchange(added_, {}); }
  /// The number of all texels.
  size_t size() const { return size_; }
  bool empty() const { return first_.empty(); }

 private:
  using Profile = std::shared_ptr<const csgcore::Profile>;
  struct Hash {
    size_t operator()(const Profile& profile) const;
  };
  struct IsSame {
    bool operator()(const Profile& a, const Profile& b) const {
      return same_profile(a.get(), b.get());
    }
  };

  size_t most_texels_;
  size_t size_ = 1;
  std::vector<Texel> added_{Texel{}};
  std::unordered_map<Profile, uint32_t, Hash, IsSame> first_;
};

}  // namespace glrender
