// SPDX-License-Identifier: BSD-3-Clause
#include "io/journal.h"

#include <sys/stat.h>

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "io/error.h"
#include "io/temp_folder.h"

namespace tessera::io {
namespace {

using test::error_of;
using test::slurp;
using test::TempFolder;
using namespace std::chrono_literals;

constexpr JournalSubject kSubject{.picture = 7, .area = {0, 0, 64, 64}, .bytes_per_pixel = 3};
constexpr render::Rect kTile{8, 8, 4, 2};
constexpr std::size_t kRecordBytes = 48 + 4 * 2 * 3;

void append(Journal& journal, const render::Rect& tile = kTile) {
  journal.append(tile, {1, 2, 3},
                 [](std::span<std::byte> pixels) { std::fill(pixels.begin(), pixels.end(), std::byte{'p'}); });
}

std::size_t records_in(const Journal& journal) {
  std::size_t records = 0;
  journal.replay([&](const JournalRecord&) { ++records; });
  return records;
}

/// A file with some records, as a run leaves it.
void write_journal(const std::filesystem::path& path, std::size_t records) {
  Journal journal(path, kSubject, ExistingJournal::resume);
  for (std::size_t i = 0; i != records; ++i) append(journal);
}

std::optional<Error> error_on_opening(const std::filesystem::path& path,
                                      ExistingJournal existing = ExistingJournal::resume) {
  return error_of([&] { Journal journal(path, kSubject, existing); });
}

}  // namespace

BOOST_AUTO_TEST_SUITE(JournalTest)

BOOST_AUTO_TEST_CASE(what_was_appended_is_there_after_a_restart) {
  const TempFolder folder;
  write_journal(folder / "j", 3);
  {
    Journal journal(folder / "j", kSubject, ExistingJournal::resume);
    BOOST_TEST(journal.is_resumed());
    BOOST_TEST(records_in(journal) == 3u);
    append(journal);
    BOOST_TEST(records_in(journal) == 3u);  // of earlier runs
  }
  Journal journal(folder / "j", kSubject, ExistingJournal::resume);
  BOOST_TEST(records_in(journal) == 4u);
}

BOOST_AUTO_TEST_CASE(a_torn_end_is_cut_off_and_written_over) {
  const TempFolder folder;
  write_journal(folder / "j", 2);
  const std::string two = slurp(folder / "j");
  for (std::size_t size = 0; size != two.size(); ++size) {
    folder.write("j", two.substr(0, size));
    write_journal(folder / "j", 2);
    Journal journal(folder / "j", kSubject, ExistingJournal::resume);
    const std::size_t kept = size < kJournalHeaderBytes ? 0 : (size - kJournalHeaderBytes) / kRecordBytes;
    BOOST_TEST(records_in(journal) == kept + 2);
  }
}

BOOST_AUTO_TEST_CASE(a_journal_that_is_there_is_refused_unless_it_is_resumed) {
  const TempFolder folder;
  write_journal(folder / "j", 1);
  const std::string before = slurp(folder / "j");
  const auto error = error_on_opening(folder / "j", ExistingJournal::refuse);
  BOOST_TEST_REQUIRE(error.has_value());
  BOOST_TEST((error->kind() == ErrorKind::cannot_create));
  BOOST_TEST(std::string(error->what()).find("--resume") != std::string::npos);
  BOOST_TEST(slurp(folder / "j") == before);

  // Without a record nothing can be lost.
  folder.write("j", before.substr(0, kJournalHeaderBytes));
  BOOST_TEST(!error_on_opening(folder / "j", ExistingJournal::refuse));
}

BOOST_AUTO_TEST_CASE(another_file_is_left_as_it_is) {
  const TempFolder folder;
  for (const auto existing : {ExistingJournal::refuse, ExistingJournal::resume}) {
    folder.write("notes", "short");
    BOOST_TEST(error_on_opening(folder / "notes", existing).has_value());
    BOOST_TEST(slurp(folder / "notes") == "short");
  }
  BOOST_TEST((error_on_opening("/dev/null")->kind() == ErrorKind::cannot_create));
  BOOST_TEST((error_on_opening(folder / "no/such/j")->kind() == ErrorKind::cannot_create));
  BOOST_TEST((error_on_opening(folder / ".")->kind() == ErrorKind::cannot_create));
}

BOOST_AUTO_TEST_CASE(a_file_has_one_run_at_a_time) {
  const TempFolder folder;
  Journal first(folder / "j", kSubject, ExistingJournal::resume);
  append(first);
  const auto error = error_on_opening(folder / "j");
  BOOST_TEST_REQUIRE(error.has_value());
  BOOST_TEST((error->kind() == ErrorKind::cannot_create));
  BOOST_TEST(std::string(error->what()).find("another run is writing it") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(without_records_or_when_done_it_leaves_nothing) {
  const TempFolder folder;
  write_journal(folder / "j", 0);
  BOOST_TEST(folder.file_count() == 0u);
  {
    Journal journal(folder / "j", kSubject, ExistingJournal::resume);
    append(journal);
    journal.remove();
  }
  BOOST_TEST(folder.file_count() == 0u);
}

BOOST_AUTO_TEST_CASE(records_reach_the_file_in_time_or_in_bulk) {
  const TempFolder folder;
  Journal journal(folder / "j", kSubject, ExistingJournal::resume);
  const auto size = [&] { return std::filesystem::file_size(folder / "j"); };
  append(journal);
  journal.tick();
  BOOST_TEST(size() == kJournalHeaderBytes);
  std::this_thread::sleep_for(210ms);
  journal.tick();
  BOOST_TEST(size() == kJournalHeaderBytes + kRecordBytes);

  while (size() == kJournalHeaderBytes + kRecordBytes) append(journal, kSubject.area);
  const std::size_t bulk = size() - kJournalHeaderBytes - kRecordBytes;
  BOOST_TEST(bulk >= std::size_t{1} << 20);
  BOOST_TEST(bulk < (std::size_t{1} << 20) + 20'000);
}

BOOST_AUTO_TEST_CASE(the_time_of_change_moves_while_nothing_is_appended) {
  const TempFolder folder;
  Journal journal(folder / "j", kSubject, ExistingJournal::resume);
  const auto before = std::filesystem::last_write_time(folder / "j");
  std::this_thread::sleep_for(520ms);
  BOOST_TEST((std::filesystem::last_write_time(folder / "j") == before));
  journal.tick();
  BOOST_TEST((std::filesystem::last_write_time(folder / "j") > before));
}

BOOST_AUTO_TEST_CASE(a_link_stays_and_its_file_goes) {
  const TempFolder folder;
  std::filesystem::create_symlink("real", folder / "link");
  Journal journal(folder / "link", kSubject, ExistingJournal::resume);
  append(journal);
  journal.flush();
  BOOST_TEST(std::filesystem::exists(folder / "real"));
  journal.remove();
  BOOST_TEST(!std::filesystem::exists(folder / "real"));
  BOOST_TEST(std::filesystem::is_symlink(folder / "link"));
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::io
