// SPDX-License-Identifier: BSD-3-Clause
#include "io/read_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <system_error>

#include "io/error.h"

namespace tessera::io {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const noexcept { std::fclose(file); }
};

}  // namespace

std::string read_file(const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    throw Error(ErrorKind::input_missing, path.string() + ": cannot open (it is a directory)");
  }
  const std::unique_ptr<std::FILE, CloseFile> file(std::fopen(path.c_str(), "rb"));
  if (!file) {
    throw Error(ErrorKind::input_missing, path.string() + ": cannot open (" + std::strerror(errno) + ")");
  }
  std::setvbuf(file.get(), nullptr, _IONBF, 0);

  // Ask for the size that the file says it has and one byte more, so that its end is seen at once
  const auto size = std::filesystem::file_size(path, ignored);
  std::string bytes(ignored ? std::size_t{1} << 16 : static_cast<std::size_t>(size) + 1, '\0');
  std::size_t filled = 0;
  while (const std::size_t got = std::fread(bytes.data() + filled, 1, bytes.size() - filled, file.get())) {
    filled += got;
    if (filled == bytes.size()) bytes.resize(2 * bytes.size());
  }
  if (std::ferror(file.get())) {
    throw Error(ErrorKind::io_failure, path.string() + ": cannot read (" + std::strerror(errno) + ")");
  }
  bytes.resize(filled);
  return bytes;
}

}  // namespace tessera::io
