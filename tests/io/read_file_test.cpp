// SPDX-License-Identifier: BSD-3-Clause
#include "io/read_file.h"

#include <boost/test/unit_test.hpp>
#include <cstddef>
#include <string>
#include <utility>

#include "io/error.h"
#include "io/temp_folder.h"

namespace tessera::io {

BOOST_AUTO_TEST_SUITE(ReadFile)

BOOST_AUTO_TEST_CASE(returns_every_byte) {
  const test::TempFolder folder;
  for (const std::size_t size : {0u, 1u, 65535u, 65536u, 300000u}) {
    std::string bytes(size, '\0');
    for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<char>(i * i);
    BOOST_TEST((read_file(folder.write("a", bytes)) == bytes), "size " << size);
  }
}

BOOST_AUTO_TEST_CASE(what_says_no_size_is_read_to_its_end) {
  BOOST_TEST(read_file("/dev/null") == "");
  BOOST_TEST(read_file("/proc/version") == test::slurp("/proc/version"));
}

BOOST_AUTO_TEST_CASE(what_cannot_be_opened_is_missing) {
  const test::TempFolder folder;
  for (const auto& [name, reason] :
       {std::pair{folder / "none", "No such file or directory"}, std::pair{folder / ".", "it is a directory"}}) {
    const auto error = test::error_of([&name = name] { read_file(name); });
    BOOST_TEST_REQUIRE(error.has_value());
    BOOST_TEST((error->kind() == ErrorKind::input_missing));
    BOOST_TEST(error->what() == name.string() + ": cannot open (" + reason + ")");
  }
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::io
