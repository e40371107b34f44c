#include "profile_texels.hpp"

#include <functional>

#include "glrender/context.hpp"

namespace glrender {
namespace {

using csgcore::Profile;
using csgcore::Vec2;
using Texel = ProfileTexels::Texel;

constexpr size_t kNodeTexels = 2, kPieceTexels = 3;

Texel texel(const Vec2& first, const Vec2& second) {
  return {static_cast<float>(first.x), static_cast<float>(first.y), static_cast<float>(second.x),
          static_cast<float>(second.y)};
}

size_t texels_of(const Profile& profile) {
  return 1 + kNodeTexels * profile.nodes().size() + kPieceTexels * profile.pieces().size();
}

void append_piece(const Profile::Piece& piece, std::vector<Texel>& texels) {
  // A line has no control point.
  const Vec2 control = piece.is_line() ? piece.start : piece.control;
  texels.push_back(texel(piece.start, control));
  texels.push_back(texel(piece.end, {piece.weight, 0}));
  texels.push_back(texel(piece.end - piece.start, control - piece.start));
}

/// Appends the nodes, depth first, with the pieces of the leaves.
void append_nodes(const Profile& profile, uint32_t index, std::vector<Texel>& texels) {
  const Profile::Node& node = profile.nodes()[index];
  const bool is_leaf = node.children == 0;
  texels.push_back({node.min[0], node.min[1], node.max[0], node.max[1]});
  const size_t place = texels.size();
  texels.push_back({0, is_leaf ? static_cast<float>(node.end - node.begin) : 0.0f, 0, 0});
  if (is_leaf) {
    for (const Profile::Piece& piece :
         profile.pieces().subspan(node.begin, node.end - node.begin)) {
      append_piece(piece, texels);
    }
  } else {
    // The hierarchy is balanced, and so not deep.
    append_nodes(profile, node.children, texels);
    append_nodes(profile, node.children + 1, texels);
  }
  texels[place][0] = static_cast<float>(texels.size() - place - 1);
}

}  // namespace

/// Profiles that differ most often differ in their size or their first point.
size_t ProfileTexels::Hash::operator()(const Profile& profile) const {
  size_t hash = profile->pieces().size();
  const auto mix = [&](size_t value) { hash = hash * 0x9E3779B97F4A7C15u + value; };
  mix(static_cast<size_t>(profile->fill_rule()));
  if (profile->loops().empty()) return hash;
  const Vec2& first = profile->loops().front().front().end;
  mix(std::hash<double>()(first.x));
  mix(std::hash<double>()(first.y));
  return hash;
}

uint32_t ProfileTexels::first_of(const Profile& profile) {
  if (!profile) return 0;
  const auto [place, is_new] = first_.try_emplace(profile, static_cast<uint32_t>(size_));
  if (!is_new) return place->second;
  const size_t count = texels_of(*profile);
  if (size_ + count > most_texels_) {
    throw GlError("the profiles have more edges than OpenGL can number (use a smaller $fn)");
  }
  added_.reserve(added_.size() + count);
  const bool is_nonzero = profile->fill_rule() == csgcore::FillRule::kNonZero;
  added_.push_back(texel({static_cast<double>(count - 1), is_nonzero ? 1 : 0}, profile->radii()));
  if (!profile->nodes().empty()) append_nodes(*profile, 0, added_);
  size_ += count;
  return place->second;
}

}  // namespace glrender
