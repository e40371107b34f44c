// What is written of an image (frontend/OPTIONS.md): a channel of it as a picture, and the bytes of
// the file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "csgcore/image.hpp"
#include "frontend/render_settings.hpp"

namespace frontend {

using Bytes = std::vector<std::byte>;

/// Encodes 8-bit RGB. The same image gives the same bytes on one processor; on a processor with
/// other instructions the compression may differ. Throws Error on failure.
Bytes encode_png(const csgcore::Image& image);

/// Encodes the float channels R, G, B, A, Z, P.X, P.Y, P.Z, N.X, N.Y, N.Z and the uint channel id.
/// Precondition: the image has its measured channels.
Bytes encode_exr(const csgcore::Image& image);

enum class PictureFormat : uint8_t { kPng, kExr, kGif, kWebp };

/// Encodes a picture; of a format that can hold several (animated_picture.hpp), as the only one.
Bytes encode_picture(const csgcore::Image& image, PictureFormat format);

/// Replaces `image.rgb` by a picture of the channel `show` (--show=depth|normals|id); misses get
/// `background`. kSurface and kCells, which renderers draw, leave the image as it is. Depth: near
/// is white, far dark grey, linear in z over the range of the hits. Normals: (n + 1)/2. Id: a
/// colour of its own for each id below 2^24. Precondition: the image has its measured channels.
void show_channel(csgcore::Image& image, Show show, Rgb background);

}  // namespace frontend
