// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file VectorClones.h
 * @brief Loops for wider vectors where the machine has them.
 *
 * A function marked NEPHOSCOPE_VECTOR_CLONES is compiled twice, once for AVX2, and the one that the processor can run is taken when
 * the library is loaded. Both have the same bits: no operation is fused or reordered.
 */
#ifndef VectorClones_h
#define VectorClones_h

#if defined(__x86_64__) && defined(__linux__) && defined(__GNUC__) && !defined(__clang__) &&       \
  !defined(__SANITIZE_ADDRESS__)
#define NEPHOSCOPE_VECTOR_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define NEPHOSCOPE_VECTOR_CLONES
#endif

/// A template that such a function calls: only what is compiled into it is compiled for it.
#if defined(__GNUC__)
#define NEPHOSCOPE_INLINE inline __attribute__((always_inline))
#else
#define NEPHOSCOPE_INLINE inline
#endif
#endif
