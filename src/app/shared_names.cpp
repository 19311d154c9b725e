// SPDX-License-Identifier: BSD-3-Clause
#include "app/shared_names.h"

#include <map>
#include <string>
#include <system_error>

#include "app/exit_code.h"
#include "io/output_file.h"

namespace tessera::app {

void refuse_shared_names(std::initializer_list<NamedPath> paths) {
  namespace fs = std::filesystem;
  std::map<fs::path, const char*> owners;
  for (const auto& [option, path] : paths) {
    if (!path || *path == "-") continue;
    std::error_code error;
    const fs::path file = fs::weakly_canonical(io::destination_of(fs::absolute(*path)), error);
    if (error || (fs::exists(file, error) && !fs::is_regular_file(file, error))) continue;
    for (const fs::path& taken : {file, io::partial_name_of(file)}) {
      const auto [owner, is_new] = owners.emplace(taken, option);
      if (is_new || owner->second == option) continue;
      throw UsageError(std::string(option) + ": \"" + path->string() + "\" is " + owner->second + " as well");
    }
  }
}

}  // namespace tessera::app
