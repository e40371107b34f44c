// The program's operator new, which asks the kernel for huge pages for large blocks, where it gives
// them on request only (its "madvise" setting). A design of a million primitives takes hundreds of
// MB; in pages of 4 KB, the kernel spends a third of the run on handing them out.
#include <malloc.h>
#include <sys/mman.h>

#include <cstdint>
#include <cstdlib>
#include <new>

namespace {

constexpr std::size_t kHugePage = std::size_t{1} << 21;
// In smaller blocks a huge page is mostly empty, and clearing it costs more than it saves.
constexpr std::size_t kLarge = std::size_t{1} << 19;

// Large blocks go back to the kernel when they are freed. Otherwise glibc keeps blocks of up to 32
// MB once it has freed one, and what an import needs for a moment leaves holes of tens of MB.
[[maybe_unused]] const bool kReturnsLargeBlocks =
    mallopt(M_MMAP_THRESHOLD, static_cast<int>(kLarge)) == 1;

void* allocate(std::size_t size, std::size_t alignment) {
  if (size > PTRDIFF_MAX) return nullptr;  // rounding it up might overflow to 0
  if (size >= kLarge && alignment <= kHugePage) {
    const std::size_t whole = (size + kHugePage - 1) & ~(kHugePage - 1);
    if (void* const block = std::aligned_alloc(kHugePage, whole)) {
      madvise(block, whole, MADV_HUGEPAGE);  // only a request: it may fail
      return block;
    }
  }
  if (alignment <= __STDCPP_DEFAULT_NEW_ALIGNMENT__) return std::malloc(size == 0 ? 1 : size);
  return std::aligned_alloc(alignment, (size + alignment - 1) & ~(alignment - 1));
}

void* allocate_or_throw(std::size_t size, std::size_t alignment) {
  for (;;) {
    if (void* const block = allocate(size, alignment)) return block;
    const std::new_handler handler = std::get_new_handler();
    if (handler == nullptr) throw std::bad_alloc();
    handler();
  }
}

}  // namespace

// The array forms call these.
void* operator new(std::size_t size) {
  return allocate_or_throw(size, __STDCPP_DEFAULT_NEW_ALIGNMENT__);
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return allocate_or_throw(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* block) noexcept { std::free(block); }
void operator delete(void* block, std::size_t) noexcept { std::free(block); }
void operator delete(void* block, std::align_val_t) noexcept { std::free(block); }
void operator delete(void* block, std::size_t, std::align_val_t) noexcept { std::free(block); }
