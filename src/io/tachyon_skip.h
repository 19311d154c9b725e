// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/tachyon_notes.h"
#include "io/tachyon_tokens.h"

// The shapes of Tachyon that we can't draw, read far enough to find where each ends.
namespace tessera::io {

/// Reads past what `pattern` describes: `3` is three numbers, `n*3` a count n and n times three numbers, `word` any
/// word, `texture` a name or an inline texture, and everything else is a keyword.
/// throws:  Error(bad_scene)
void read_past(TachyonTokens& in, std::string_view pattern);

/// If `keyword` begins a shape that we can't draw, reads past it, counts it and returns true.
/// throws:  Error(bad_scene)
bool skip_shape(std::string_view keyword, TachyonTokens& in, TachyonNotes& notes);

/// Their keywords, to suggest one for a mistyped word.
std::vector<std::string> shape_keywords();

}  // namespace tessera::io
