// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace tessera::io {

/// `text` as a JSON string, quotes included. Bytes that are no UTF-8 become U+FFFD, the replacement character.
/// source:  RFC 8259 section 7; well-formed sequences: Unicode 15, table 3-7
std::string json_string(std::string_view text);

}  // namespace tessera::io
