// The formats in which a design is exported (frontend/OPTIONS.md).
#pragma once

#include <cstdint>

namespace frontend {

enum class ModelFormat : uint8_t { kStl, kAsciiStl, kOff, kObj, kAmf, k3mf, kSvg, kDxf, kPdf };

/// Returns whether the format holds plane figures; the others hold solids.
constexpr bool is_plane_format(ModelFormat format) {
  return format == ModelFormat::kSvg || format == ModelFormat::kDxf || format == ModelFormat::kPdf;
}

}  // namespace frontend
