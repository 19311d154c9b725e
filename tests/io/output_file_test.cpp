// SPDX-License-Identifier: BSD-3-Clause
#include "io/output_file.h"

#include <boost/test/unit_test.hpp>
#include <filesystem>
#include <string>

#include "io/error.h"
#include "io/temp_folder.h"

namespace tessera::io {

using test::error_of;
using test::slurp;
using test::TempFolder;

BOOST_AUTO_TEST_SUITE(OutputFileTest)

BOOST_AUTO_TEST_CASE(appears_only_at_the_commit) {
  const TempFolder folder;
  folder.write("a.png", "old");
  OutputFile file(folder / "a.png");
  BOOST_TEST(std::filesystem::exists(folder / "a.png.part"));
  file.write("ne");
  file.write("w");
  BOOST_TEST(slurp(folder / "a.png") == "old");
  file.commit();
  BOOST_TEST(slurp(folder / "a.png") == "new");
  BOOST_TEST(folder.file_count() == 1u);
}

BOOST_AUTO_TEST_CASE(leaves_nothing_behind_without_a_commit) {
  const TempFolder folder;
  {
    OutputFile file(folder / "a.png");
    file.write("half a picture");
  }
  BOOST_TEST(folder.file_count() == 0u);
}

BOOST_AUTO_TEST_CASE(a_stale_part_file_is_overwritten) {
  const TempFolder folder;
  folder.write("a.png.part", "a long rest of an earlier run");
  OutputFile file(folder / "a.png");
  file.write("new");
  file.commit();
  BOOST_TEST(slurp(folder / "a.png") == "new");
}

BOOST_AUTO_TEST_CASE(what_cannot_be_created_is_known_at_once) {
  const TempFolder folder;
  const auto problem_of = [](const std::filesystem::path& path) {
    const auto error = error_of([&] { OutputFile file(path); });
    if (!error) return std::string("none");
    BOOST_TEST((error->kind() == ErrorKind::cannot_create));
    return std::string(error->what());
  };
  const auto beyond = folder / "no/such/a.png";
  BOOST_TEST(problem_of(beyond) == beyond.string() + ": cannot create (No such file or directory)");
  BOOST_TEST(problem_of(folder / ".") == (folder / ".").string() + ": cannot create (it is a directory)");
  BOOST_TEST(problem_of(folder / "new/") == (folder / "new/").string() + ": cannot create (the name ends in a slash)");
  const auto under_a_file = folder.write("plain", "") / "a.png";
  BOOST_TEST(problem_of(under_a_file) == under_a_file.string() + ": cannot create (Not a directory)");
  BOOST_TEST(problem_of("") == "cannot create a file without a name");
}

BOOST_AUTO_TEST_CASE(a_link_keeps_pointing_to_its_file) {
  const TempFolder folder;
  folder.write("real.png", "old");
  std::filesystem::create_symlink("real.png", folder / "link.png");
  std::filesystem::create_symlink("later.png", folder / "dangling.png");
  for (const char* name : {"link.png", "dangling.png"}) {
    OutputFile file(folder / name);
    file.write("new");
    file.commit();
    BOOST_TEST(std::filesystem::is_symlink(folder / name));
  }
  BOOST_TEST(slurp(folder / "real.png") == "new");
  BOOST_TEST(slurp(folder / "later.png") == "new");
}

BOOST_AUTO_TEST_CASE(a_full_disk_is_an_error, *boost::unit_test::precondition([](boost::unit_test::test_unit_id) {
                       boost::test_tools::assertion_result has_device(std::filesystem::exists("/dev/full"));
                       has_device.message() << "there is no /dev/full here";
                       return has_device;
                     })) {
  OutputFile file("/dev/full");
  const auto error = error_of([&] { file.write("x"); });
  BOOST_TEST_REQUIRE(error.has_value());
  BOOST_TEST((error->kind() == ErrorKind::io_failure));
  BOOST_TEST(error->what() == "/dev/full: cannot write (No space left on device)");
  BOOST_TEST(!std::filesystem::exists("/dev/full.part"));
}

BOOST_AUTO_TEST_CASE(a_commit_that_fails_says_so_and_tidies_up) {
  const TempFolder folder;
  OutputFile file(folder / "a.png");
  file.write("new");
  std::filesystem::create_directory(folder / "a.png");  // in the meantime
  const auto error = error_of([&] { file.commit(); });
  BOOST_TEST_REQUIRE(error.has_value());
  BOOST_TEST((error->kind() == ErrorKind::io_failure));
  BOOST_TEST(folder.file_count() == 1u);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::io
