#include "heal/turned_frames.hpp"

#include <array>
#include <map>

namespace frontend {
namespace {

using csgcore::Affine;
using csgcore::Mat3;

/// Returns whether each axis is mapped to a multiple of an axis.
bool keeps_axes(const Mat3& linear) {
  for (int column = 0; column < 3; ++column) {
    int entries = 0;
    for (int row = 0; row < 3; ++row) entries += linear[column][row] != 0;
    if (entries > 1) return false;
  }
  return true;
}

bool is_invertible(const Affine& map) { return map.finite() && inverse_of(map).finite(); }

std::array<double, 12> entries_of(const Affine& map) {
  std::array<double, 12> result{};
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) result[3 * column + row] = map.linear[column][row];
    result[9 + column] = map.translation[column];
  }
  return result;
}

}  // namespace

TurnedFrames turned_frames(const FrameTree& frames, std::span<const uint32_t> frame_of) {
  TurnedFrames result;
  result.frames.emplace_back();
  std::map<std::array<double, 12>, uint32_t> known;
  std::vector<uint32_t> turned_of(frames.size());
  for (uint32_t i = 1; i < frames.size(); ++i) {
    const Frame& frame = frames[i];
    const uint32_t around = turned_of[frame.parent];
    turned_of[i] = around;
    const uint32_t depth = result.frames[around].depth + 1;
    if (keeps_axes(frame.to_parent.linear) || depth > kMostTurnedFrames ||
        !is_invertible(frame.to_world)) {
      continue;
    }
    const auto next = static_cast<uint32_t>(result.frames.size());
    const auto [entry, is_new] = known.emplace(entries_of(frame.to_world), next);
    if (is_new) result.frames.push_back({around, depth, frame.to_world});
    turned_of[i] = entry->second;
  }
  result.of_primitive.reserve(frame_of.size());
  for (const uint32_t frame : frame_of) result.of_primitive.push_back(turned_of[frame]);
  return result;
}

}  // namespace frontend
