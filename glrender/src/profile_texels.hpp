// Profiles as the shaders read them (profile.glsl).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

#include "csgcore/profile.hpp"

namespace glrender {

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
