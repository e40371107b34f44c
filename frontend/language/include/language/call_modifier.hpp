// The modifiers of a module call, which its node keeps.
#pragma once

#include <cstdint>

namespace language {

/// Bits. What has `*` is dropped by the parser.
enum CallModifier : uint8_t {
  kRootModifier = 1,        // !
  kHighlightModifier = 2,   // #
  kBackgroundModifier = 4,  // %
};

}  // namespace language
