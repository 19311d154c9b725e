// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "io/place.h"
#include "render/color.h"
#include "render/vec3.h"

// The words of a Tachyon scene file. A word is what stands between blanks; the word `#` begins a comment that ends
// with the line.
namespace tessera::io {

/// Whether two words are the same but for the case of their letters A-Z.
bool is_keyword(std::string_view word, std::string_view keyword) noexcept;

/// Reads one file word by word. Every read moves on and throws Error(bad_scene) with the place of the word where it
/// isn't what was asked for.
class TachyonTokens {
 public:
  /// Where a word begins: its offset in the file. A Place takes time to make and is for messages.
  using Mark = std::size_t;

  /// throws:  Error(input_missing / io_failure)
  explicit TachyonTokens(const std::filesystem::path& path);

  /// The next word, empty at the end of the file. It stays valid as long as this object.
  std::string_view next() noexcept;

  /// Takes the next word if it is `keyword`, and says so.
  bool take(std::string_view keyword) noexcept;

  void expect(std::string_view keyword);
  std::string_view word(std::string_view what);  ///< any word; `what` it stands for goes into the message
  double number();
  std::int64_t integer();
  render::Vec3 vector();
  render::Rgb color();  ///< three numbers

  Mark mark() const noexcept { return word_; }  ///< of the word read last
  Place place_of(Mark mark) const;
  const std::filesystem::path& path() const noexcept { return path_; }

  [[noreturn]] void fail(Mark mark, const std::string& problem) const { refuse(place_of(mark), problem); }
  [[noreturn]] void fail(const std::string& problem) const { fail(word_, problem); }  ///< at the word read last

 private:
  [[noreturn]] void fail_expected(std::string_view expected, std::string_view found) const;

  std::filesystem::path path_;
  std::string bytes_;
  Mark word_ = 0;         // begin of the word read last
  std::size_t next_ = 0;  // where to look for the next one
};

}  // namespace tessera::io
