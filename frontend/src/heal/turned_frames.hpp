// The frames of a file that turn what they hold.
#pragma once

#include <cstdint>
#include <span>

#include "frontend/turned_frames.hpp"
#include "heal/frames.hpp"

namespace frontend {

/// Returns the turned frames of a file, and of each primitive the innermost one that it is in.
/// `frame_of` is the frame of each primitive. Frames of equal matrices to the world are one. A
/// frame that has no inverse, and one within kMostTurnedFrames others, counts as that around it.
TurnedFrames turned_frames(const FrameTree& frames, std::span<const uint32_t> frame_of);

constexpr uint32_t kMostTurnedFrames = 64;

}  // namespace frontend
