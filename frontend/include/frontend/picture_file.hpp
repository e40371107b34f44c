// Image → the bytes of a picture file (frontend/OPTIONS.md, "What is written").
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "csgcore/image.hpp"

namespace frontend {

using Bytes = std::vector<std::byte>;

/// Encodes 8-bit RGB. The same image gives the same bytes on one processor; on a processor with
/// other instructions the compression may differ. Throws Error on failure.
Bytes encode_png(const csgcore::Image& image);

/// Encodes the float channels R, G, B, A, Z, P.X, P.Y, P.Z, N.X, N.Y, N.Z and the uint channel id.
/// Precondition: the image has its measured channels.
Bytes encode_exr(const csgcore::Image& image);

enum class PictureFormat : uint8_t { kPng, kExr };

Bytes encode_picture(const csgcore::Image& image, PictureFormat format);

}  // namespace frontend
