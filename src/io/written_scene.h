// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace tessera::io {

/// A scene in some format's words, and what these cannot say exactly: each note is one line.
struct WrittenScene {
  std::string text;
  std::vector<std::string> notes;
  std::string sphere_table;  ///< for a file beside it; empty: there is none
};

}  // namespace tessera::io
