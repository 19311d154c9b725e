// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/test/unit_test.hpp>
#include <string>
#include <vector>

#include "render/kernel.h"

// The kernels that a test can set against each other on this machine.
namespace tessera::render::test {

struct NamedKernel {
  Kernel kernel;
  std::string name;
};

/// Every kernel that runs here, brute force last. Says so where one does not.
inline std::vector<NamedKernel> supported_kernels() {
  std::vector<NamedKernel> kernels{{Kernel::scalar, "scalar"}};
  if (is_supported(Kernel::avx2)) {
    kernels.push_back({Kernel::avx2, "avx2"});
  } else {
    BOOST_TEST_MESSAGE("not tested: the avx2 kernel, which this machine cannot run");
  }
  kernels.push_back({Kernel::brute, "brute"});
  return kernels;
}

}  // namespace tessera::render::test
