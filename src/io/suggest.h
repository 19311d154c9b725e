// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// "Did you mean": finds the known word that a mistyped one was meant to be.
namespace tessera::io {

/// How many letters to insert, delete, replace or swap with their neighbour to turn `a` into `b`.
/// shapes:  bytes count as letters; time and memory grow with |a| |b|
/// source:  optimal string alignment, the restricted Damerau-Levenshtein distance
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The known word nearest to `word`, the case of letters aside, if at most a third of its letters differ; of equally
/// near ones the first.
std::optional<std::string> nearest_word(std::string_view word, const std::vector<std::string>& known);

/// The end of a message about an unknown word: `, did you mean "radius"?`, or "" where none is near.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& known);

}  // namespace tessera::io
