// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <initializer_list>
#include <optional>

namespace tessera::app {

/// A file and the option that names it.
struct NamedPath {
  const char* option;
  std::optional<std::filesystem::path> path;
};

/// One file for two things would lose one of them; so would a file for one that another is still being written to.
/// throws:  UsageError
void refuse_shared_names(std::initializer_list<NamedPath> paths);

}  // namespace tessera::app
