// The kinds of messages.
#pragma once

#include <cstdint>

namespace language {

enum class MessageGroup : uint8_t {
  kError,
  kWarning,
  kSoftWarning,  // looks like a warning, but --hardwarnings does not stop there
  kDeprecated,
  kTrace,
  kEcho,
  kPlain
};

}  // namespace language
