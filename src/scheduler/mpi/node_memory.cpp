// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/mpi/node_memory.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <new>
#include <string>
#include <type_traits>
#include <utility>

#include "scheduler/mpi/session.h"

namespace tessera::scheduler::mpi {
namespace {

/// A file, closed when this goes.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) noexcept : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&&) = delete;
  ~Descriptor() {
    if (is_open()) ::close(number_);
  }
  int get() const noexcept { return number_; }
  bool is_open() const noexcept { return number_ >= 0; }

 private:
  int number_;
};

/// Which file it is.
struct FileId {
  std::uint64_t device;
  std::uint64_t inode;

  bool operator==(const FileId&) const = default;
};
static_assert(std::is_trivially_copyable_v<FileId> && sizeof(FileId) == 16);

/// Where the others find the first rank's file.
struct Offer {
  std::uint64_t bytes;
  std::int64_t process;
  std::int64_t descriptor;  ///< -1: there is none
  FileId file;              ///< a process of that number may be another one in this rank's eyes
};
static_assert(std::is_trivially_copyable_v<Offer> && sizeof(Offer) == 40);

/// A file in memory: it has no name to be cleaned up, and unlike /dev/shm no limit but the memory's.
Descriptor make_file([[maybe_unused]] std::size_t bytes) noexcept {
#ifdef MFD_CLOEXEC
  Descriptor file(::memfd_create("tessera", MFD_CLOEXEC));
  if (file.is_open() && ::ftruncate(file.get(), static_cast<::off_t>(bytes)) == 0) return file;
#endif
  return Descriptor();
}

FileId id_of(const Descriptor& file) noexcept {
  struct ::stat status {};
  return file.is_open() && ::fstat(file.get(), &status) == 0 ? FileId{status.st_dev, status.st_ino} : FileId{};
}

Descriptor open_file(const Offer& offer) noexcept {
  const std::string name = "/proc/" + std::to_string(offer.process) + "/fd/" + std::to_string(offer.descriptor);
  Descriptor file(::open(name.c_str(), O_RDWR | O_CLOEXEC));
  return id_of(file) == offer.file ? std::move(file) : Descriptor();
}

void* map(std::size_t bytes, int flags, int descriptor) noexcept {
  return ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, flags, descriptor, 0);
}

}  // namespace

NodeMemory::NodeMemory(Session& session, std::size_t bytes, Sharing sharing) {
  const bool offers = session.is_first_on_node() && sharing == Sharing::if_possible;
  const Descriptor made = offers ? make_file(bytes) : Descriptor();
  Offer offer{bytes, ::getpid(), made.get(), id_of(made)};
  session.broadcast_on_node(std::as_writable_bytes(std::span(&offer, 1)));
  if (offer.bytes == 0) return;

  const Descriptor opened = offer.descriptor >= 0 && !made.is_open() ? open_file(offer) : Descriptor();
  const Descriptor& file = made.is_open() ? made : opened;
  void* memory = file.is_open() ? map(offer.bytes, MAP_SHARED, file.get()) : MAP_FAILED;
  shared_ = session.do_all_on_node(memory != MAP_FAILED);
  if (!shared_) {
    if (memory != MAP_FAILED) ::munmap(memory, offer.bytes);
    memory = map(offer.bytes, MAP_PRIVATE | MAP_ANONYMOUS, -1);
    if (memory == MAP_FAILED) throw std::bad_alloc();
  }
  bytes_ = {static_cast<std::byte*>(memory), offer.bytes};
}

NodeMemory::~NodeMemory() {
  if (!bytes_.empty()) ::munmap(bytes_.data(), bytes_.size());
}

void NodeMemory::publish(Session& session) {
  if (shared_) {
    session.do_all_on_node(true);
  } else {
    session.broadcast_on_node(bytes_);
  }
}

}  // namespace tessera::scheduler::mpi
