// Which version of the vectorised functions runs on this machine.
//
// Highway compiles each of them for several instruction sets; its own choice at run time would load
// libhwy, whose start-up measures the processor's clock for milliseconds.
#pragma once

namespace csgcore {

/// From the widest to what every machine has (on ARM, that is NEON).
enum class SimdLevel : int { kAvx512, kAvx2, kSse4, kBaseline };

/// The widest that the processor and the operating system support, within the limit. Every level
/// gives the same results, bit for bit.
SimdLevel simd_level();

/// For tests: from now on, nothing wider than this. Not while other threads trace.
void limit_simd_level(SimdLevel widest);

}  // namespace csgcore

/// After HWY_ONCE, with <hwy/highway.h>: makes FUNCTION, of the sources' HWY_NAMESPACE, callable as
/// CSGCORE_SIMD(FUNCTION)(arguments).
#define CSGCORE_SIMD_EXPORT(FUNCTION)                                                  \
  constexpr decltype(&HWY_STATIC_DISPATCH(FUNCTION)) k_##FUNCTION##_versions[] = {     \
      HWY_CHOOSE_AVX3(FUNCTION), HWY_CHOOSE_AVX2(FUNCTION), HWY_CHOOSE_SSE4(FUNCTION), \
      HWY_CHOOSE_FALLBACK(FUNCTION)}
#define CSGCORE_SIMD(FUNCTION) k_##FUNCTION##_versions[static_cast<int>(simd_level())]
