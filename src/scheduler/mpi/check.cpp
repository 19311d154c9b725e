// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/mpi/check.h"

#include <mpi.h>

#include <array>
#include <stdexcept>
#include <string>

namespace tessera::scheduler::mpi {

void check(int code, const char* call) {
  if (code == MPI_SUCCESS) return;
  std::array<char, MPI_MAX_ERROR_STRING> words{};
  int length = 0;
  if (MPI_Error_string(code, words.data(), &length) != MPI_SUCCESS) length = 0;
  throw std::runtime_error(std::string(call) + " failed (" +
                           std::string(words.data(), static_cast<std::size_t>(length)) + ")");
}

}  // namespace tessera::scheduler::mpi
