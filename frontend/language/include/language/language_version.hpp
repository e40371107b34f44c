// The versions of OpenSCAD's language that are evaluated.
#pragma once

#include <cstdint>

namespace language {

enum class LanguageVersion : uint8_t {
  k2021,  // 2021.01, the last release
  k2026,  // the development snapshots
};

}  // namespace language
