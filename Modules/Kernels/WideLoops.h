// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file WideLoops.h
 * @brief Functions whose loops become vector instructions, once for every x86-64 and once for those with AVX2.
 *
 * The faster is chosen when the library is loaded. AVX2 has no fused multiply-add, so that both give the same bits. Other compilers,
 * and sanitizers, which cannot yet run where the choice is made, have one version.
 */
#ifndef WideLoops_h
#define WideLoops_h

#if defined(__x86_64__) && defined(__linux__) && defined(__GNUC__) && !defined(__clang__) &&       \
  !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define NEPHOSCOPE_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define NEPHOSCOPE_WIDE
#endif

#endif
