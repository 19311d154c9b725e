// SPDX-License-Identifier: BSD-3-Clause
#include "render/kernel.h"

#include <stdexcept>

namespace tessera::render {

bool is_supported(Kernel kernel) noexcept {
  if (kernel != Kernel::avx2) return true;
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
  return false;
#endif
}

Kernel runnable(Kernel kernel) {
  if (kernel == Kernel::automatic) return is_supported(Kernel::avx2) ? Kernel::avx2 : Kernel::scalar;
  if (!is_supported(kernel)) throw std::invalid_argument("this machine has no AVX2 and FMA instructions");
  return kernel;
}

}  // namespace tessera::render
