// SPDX-License-Identifier: BSD-3-Clause
#include "io/sphere_table.h"

#include "io/binary_table.h"
#include "io/lower_case.h"
#include "io/read_file.h"
#include "io/text_table.h"

namespace tessera::io {

SphereTable read_sphere_table(const std::filesystem::path& path, const SphereTableOptions& options,
                              MaterialSet& materials) {
  const std::string bytes = read_file(path);
  const auto parse = lower_case(path.extension().string()) == ".bin" ? parse_binary_table : parse_text_table;
  return parse(bytes, path.string(), options, materials);
}

}  // namespace tessera::io
