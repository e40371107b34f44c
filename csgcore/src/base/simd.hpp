// The choice of the version of the vectorised functions that runs on this machine.
//
// Highway compiles each of them for several instruction sets. Its own choice at run time is not
// used, since it loads libhwy, which measures the processor's clock for milliseconds at start-up.
#pragma once

namespace csgcore {

/// Instruction sets, from the widest to the one that every machine has (NEON on ARM).
enum class SimdLevel : int { kAvx512, kAvx2, kSse4, kBaseline };

/// Returns the widest level within the limit that the processor and the operating system support.
/// Every level gives the same results, bit for bit.
SimdLevel simd_level();

/// Limits simd_level() to `widest`, for tests. It must not be called while other threads trace.
void limit_simd_level(SimdLevel widest);

}  // namespace csgcore

/// The instruction sets of Highway for which nothing is compiled. Vectors whose length is not known
/// to the compiler (SVE, RVV) cannot be put into arrays. Under the sanitizers, and without
/// SCADRAY_ALL_INSTRUCTION_SETS, two more are left out, which are made of the same source as the
/// others and take half of the compiler's time.
#define CSGCORE_UNUSED_TARGETS \
  (HWY_SSSE3 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#ifdef CSGCORE_TWO_TARGETS
#define CSGCORE_DISABLED_TARGETS (CSGCORE_UNUSED_TARGETS | HWY_AVX3 | HWY_SSE4)
#else
#define CSGCORE_DISABLED_TARGETS CSGCORE_UNUSED_TARGETS
#endif

/// Makes FUNCTION of the source's HWY_NAMESPACE callable as CSGCORE_SIMD(FUNCTION)(arguments). It
/// is used within `#if HWY_ONCE`, and needs <hwy/highway.h>.
#define CSGCORE_SIMD_EXPORT(FUNCTION)                                                  \
  constexpr decltype(&HWY_STATIC_DISPATCH(FUNCTION)) k_##FUNCTION##_versions[] = {     \
      HWY_CHOOSE_AVX3(FUNCTION), HWY_CHOOSE_AVX2(FUNCTION), HWY_CHOOSE_SSE4(FUNCTION), \
      HWY_CHOOSE_FALLBACK(FUNCTION)}
#define CSGCORE_SIMD(FUNCTION) k_##FUNCTION##_versions[static_cast<int>(simd_level())]
