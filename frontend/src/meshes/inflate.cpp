#include "meshes/inflate.hpp"

#include <isa-l/igzip_lib.h>

#include <algorithm>
#include <memory>

namespace frontend {
namespace {

/// ISA-L counts in 32 bits.
constexpr size_t kMostAtOnce = size_t{1} << 30;
constexpr size_t kFirstRoom = size_t{1} << 16;

}  // namespace

std::optional<std::string> inflate(std::string_view packed, Wrapping wrapping, size_t most_bytes) {
  const auto state = std::make_unique<inflate_state>();
  isal_inflate_init(state.get());
  state->crc_flag = wrapping == Wrapping::kZlib ? ISAL_ZLIB : ISAL_DEFLATE;
  std::string result;
  size_t used = 0;
  while (state->block_state != ISAL_BLOCK_FINISH) {
    if (state->avail_in == 0 && !packed.empty()) {
      const size_t count = std::min(packed.size(), kMostAtOnce);
      // ISA-L's type lacks a const.
      state->next_in = reinterpret_cast<uint8_t*>(const_cast<char*>(packed.data()));
      state->avail_in = static_cast<uint32_t>(count);
      packed.remove_prefix(count);
    }
    if (used == result.size()) {
      if (used == most_bytes) return std::nullopt;
      result.resize(std::min(most_bytes, std::max(kFirstRoom, 2 * used)));
    }
    const size_t room = std::min(result.size() - used, kMostAtOnce);
    state->next_out = reinterpret_cast<uint8_t*>(result.data() + used);
    state->avail_out = static_cast<uint32_t>(room);
    const uint32_t before = state->avail_in;
    if (isal_inflate(state.get()) != ISAL_DECOMP_OK) return std::nullopt;
    const size_t written = room - state->avail_out;
    used += written;
    const bool stands_still = written == 0 && before == state->avail_in;
    if (stands_still && state->block_state != ISAL_BLOCK_FINISH)
      return std::nullopt;  // it is cut off
  }
  result.resize(used);
  return result;
}

}  // namespace frontend
