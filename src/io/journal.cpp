// SPDX-License-Identifier: BSD-3-Clause
#include "io/journal.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <utility>

#include "io/error.h"
#include "io/output_file.h"

namespace tessera::io {
namespace {

using namespace std::chrono_literals;
constexpr auto kWriteInterval = 200ms;
constexpr auto kTouchInterval = 500ms;
constexpr std::size_t kWriteBytes = std::size_t{1} << 20;

Error cannot(ErrorKind kind, const std::filesystem::path& path, const std::string& what, const std::string& why) {
  return Error(kind, path.string() + ": cannot " + what + " the journal (" + why + ")");
}

/// A file's bytes, as they are on disk, while this lives.
class MappedFile {
 public:
  MappedFile(int descriptor, std::size_t size, const std::filesystem::path& path) : size_(size) {
    if (size == 0) return;
    memory_ = ::mmap(nullptr, size, PROT_READ, MAP_SHARED, descriptor, 0);
    if (memory_ == MAP_FAILED) throw cannot(ErrorKind::io_failure, path, "read", std::strerror(errno));
  }
  ~MappedFile() {
    if (size_ > 0) ::munmap(memory_, size_);
  }
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  std::span<const std::byte> bytes() const noexcept { return {static_cast<const std::byte*>(memory_), size_}; }

 private:
  void* memory_ = nullptr;
  std::size_t size_;
};

}  // namespace

Journal::Journal(const std::filesystem::path& path, const JournalSubject& subject, ExistingJournal existing)
    : path_(path), subject_(subject), last_sign_(Clock::now()) {
  try {
    open(existing);
  } catch (...) {
    if (descriptor_ >= 0) ::close(descriptor_);
    throw;
  }
}

Journal::~Journal() {
  if (descriptor_ < 0) return;
  try {
    flush();
    if (!has_records()) remove();
  } catch (const Error&) {
    // What is in the file stays good
  }
  if (descriptor_ >= 0) ::close(descriptor_);
}

void Journal::open(ExistingJournal existing) {
  struct stat status {};
  do {
    // A run that ended between our opening and locking has taken the file's name away: open another
    if (descriptor_ >= 0) ::close(descriptor_);
    descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor_ < 0) throw cannot(ErrorKind::cannot_create, path_, "create", std::strerror(errno));
    lock();
    if (::fstat(descriptor_, &status) != 0) throw cannot(ErrorKind::io_failure, path_, "read", std::strerror(errno));
    if (!S_ISREG(status.st_mode)) throw cannot(ErrorKind::cannot_create, path_, "create", "it is no plain file");
  } while (status.st_nlink == 0);

  end_ = static_cast<std::uint64_t>(status.st_size);
  is_resumed_ = end_ > 0;
  if (existing == ExistingJournal::refuse && has_records()) {
    throw Error(ErrorKind::cannot_create,
                path_.string() +
                    ": there already (an interrupted run's work may be in it) add --resume to go on from "
                    "it, or remove it");
  }
  keep_good_records();
  replay_end_ = end_;
}

void Journal::lock() {
  // Some network file systems know no locks: there we go without.
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  throw cannot(ErrorKind::cannot_create, path_, "write", "another run is writing it");
}

void Journal::keep_good_records() {
  const std::uint64_t size = end_;
  {
    const MappedFile file(descriptor_, size, path_);
    JournalReader reader(file.bytes(), subject_, path_.string());
    while (reader.next()) {
    }
    end_ = reader.good_bytes();
  }
  // Only where there is something to cut off: ext4 writes a file that was cut to nothing to disk when it is closed
  const bool is_cut = end_ == size || ::ftruncate(descriptor_, static_cast<::off_t>(end_)) == 0;
  if (!is_cut || ::lseek(descriptor_, static_cast<::off_t>(end_), SEEK_SET) < 0) {
    throw cannot(ErrorKind::io_failure, path_, "write", std::strerror(errno));
  }
  if (end_ == 0) write(encode_journal_header(subject_));
}

void Journal::replay(const std::function<void(const JournalRecord&)>& take) const {
  const MappedFile file(descriptor_, replay_end_, path_);
  JournalReader reader(file.bytes(), subject_, path_.string());
  while (const auto record = reader.next()) take(*record);
}

void Journal::append(const render::Rect& tile, const render::RayCounts& rays,
                     const std::function<void(std::span<std::byte>)>& fill) {
  append_journal_record(buffer_, subject_, tile, rays, fill);
  if (buffer_.size() >= kWriteBytes) flush();
}

void Journal::tick() {
  const auto now = Clock::now();
  if (now - last_sign_ < kWriteInterval) return;
  if (!buffer_.empty()) return flush();
  if (now - last_sign_ < kTouchInterval) return;
  ::futimens(descriptor_, nullptr);  // where it fails, others may find us dead; nothing is lost
  last_sign_ = now;
}

void Journal::flush() {
  write(buffer_);
  buffer_.clear();
}

void Journal::write(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ::ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throw cannot(ErrorKind::io_failure, path_, "write", std::strerror(errno));
    bytes = bytes.subspan(static_cast<std::size_t>(written));
    end_ += static_cast<std::uint64_t>(written);
  }
  last_sign_ = Clock::now();
}

void Journal::remove() {
  // While we still have the lock, or it might be another run's by then
  const bool is_gone = ::unlink(destination_of(path_).c_str()) == 0 || errno == ENOENT;
  const int why = errno;
  ::close(std::exchange(descriptor_, -1));
  if (!is_gone) throw cannot(ErrorKind::io_failure, path_, "remove", std::strerror(why));
}

}  // namespace tessera::io
