// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Functions between these two are compiled for AVX2 and FMA; what headers outside of them define is not, unless it is
// inlined there. So no other file can come to be linked to code that its machine cannot run.
#if defined(__clang__)
#define TESSERA_BEGIN_AVX2 _Pragma("clang attribute push(__attribute__((target(\"avx2,fma\"))), apply_to = function)")
#define TESSERA_END_AVX2 _Pragma("clang attribute pop")
#else
#define TESSERA_BEGIN_AVX2 _Pragma("GCC push_options") _Pragma("GCC target(\"avx2,fma\")")
#define TESSERA_END_AVX2 _Pragma("GCC pop_options")
#endif
