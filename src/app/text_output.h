// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "io/output_file.h"
#include "io/stats.h"

namespace tessera::app {

/// A text that goes to a file, opened at once so that it is known to be writable, or with the path "-" to stdout.
class TextOutput {
 public:
  /// throws:  io::Error(cannot_create)
  explicit TextOutput(const std::filesystem::path& path) {
    if (path != "-") file_.emplace(path);
  }

  /// Appends text.
  /// throws:  io::Error(io_failure)
  void write(std::string_view text) {
    if (!file_) return io::write_text("-", text);
    file_->write(text);
  }

  /// Gives the file its name.
  /// throws:  io::Error(io_failure)
  void commit() {
    if (file_) file_->commit();
  }

 private:
  std::optional<io::OutputFile> file_;
};

}  // namespace tessera::app
