// SPDX-License-Identifier: BSD-3-Clause
#include "io/output_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>
#include <utility>

#include "io/error.h"

namespace tessera::io {
namespace {

namespace fs = std::filesystem;

Error cannot(ErrorKind kind, const fs::path& path, const std::string& what, const std::string& why) {
  return Error(kind, path.string() + ": cannot " + what + " (" + why + ")");
}

}  // namespace

fs::path destination_of(fs::path path) {
  constexpr int kMostLinks = 40;  // as many as Linux follows
  std::error_code error;
  for (int i = 0; i < kMostLinks && fs::is_symlink(path, error); ++i) {
    path = path.parent_path() / fs::read_symlink(path, error);
  }
  return path;
}

fs::path partial_name_of(fs::path destination) {
  return destination += ".part";
}

OutputFile::OutputFile(const fs::path& path) : path_(path) {
  if (path.empty()) throw Error(ErrorKind::cannot_create, "cannot create a file without a name");

  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status)) throw cannot(ErrorKind::cannot_create, path_, "create", "it is a directory");
  if (!path.has_filename()) throw cannot(ErrorKind::cannot_create, path_, "create", "the name ends in a slash");

  const bool is_plain = fs::is_regular_file(status) || !fs::exists(status);
  // A rename would replace a symbolic link, not what it points to.
  target_ = is_plain ? destination_of(path) : path;
  written_to_ = is_plain ? partial_name_of(target_) : target_;
  descriptor_ = ::open(written_to_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor_ < 0) throw cannot(ErrorKind::cannot_create, path_, "create", std::strerror(errno));
}

OutputFile::~OutputFile() {
  if (descriptor_ < 0) return;
  ::close(descriptor_);
  if (is_renamed()) ::unlink(written_to_.c_str());
}

void OutputFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ::ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throw cannot(ErrorKind::io_failure, path_, "write", std::strerror(errno));
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void OutputFile::commit() {
  // A network file system reports a full disk only here; the descriptor is gone in any case
  if (::close(std::exchange(descriptor_, -1)) == 0 &&
      (!is_renamed() || std::rename(written_to_.c_str(), target_.c_str()) == 0)) {
    return;
  }
  const std::string why = std::strerror(errno);
  if (is_renamed()) ::unlink(written_to_.c_str());
  throw cannot(ErrorKind::io_failure, path_, "write", why);
}

}  // namespace tessera::io
