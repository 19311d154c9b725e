// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

// A whole file in memory: what every reader starts from.
namespace tessera::io {

/// All bytes of a file; pipes and devices are read to their end.
/// throws:  Error(input_missing) where it cannot be opened, Error(io_failure) where reading fails on the way
std::string read_file(const std::filesystem::path& path);

}  // namespace tessera::io
