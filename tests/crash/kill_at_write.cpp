#include "kill_at_write.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/sendfile.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>

namespace {

std::atomic<long> counted{0}, killed_at{0}, fails_from{0};

long from_environment(const char* name) {
  const char* text = std::getenv(name);
  return text ? std::atol(text) : 0;
}

[[maybe_unused]] const bool is_set = [] {
  killed_at = from_environment("KILL_AT_WRITE");
  fails_from = from_environment("FAIL_FROM_WRITE");
  return true;
}();

[[noreturn]] void die() {
  kill(getpid(), SIGKILL);
  for (;;) pause();
}

bool is_file(int descriptor) {
  struct stat found {};
  return fstat(descriptor, &found) == 0 && S_ISREG(found.st_mode);
}

/// Whether this is the write that is to kill; sets errno where it is to fail.
enum class Fate { passes, fails, kills };
Fate next() {
  const long n = ++counted;
  if (killed_at > 0 && n == killed_at) return Fate::kills;
  if (fails_from <= 0 || n < fails_from) return Fate::passes;
  errno = ENOSPC;
  return Fate::fails;
}

template <class Function>
Function original(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

/// `whole()` does it, `half()` by half.
template <class Whole, class Half>
auto decide(Whole whole, Half half) -> decltype(whole()) {
  switch (next()) {
    case Fate::kills:
      half();
      die();
    case Fate::fails:
      return -1;
    default:
      return whole();
  }
}

}  // namespace

extern "C" {

void kill_at_write(long n) {
  counted = 0;
  killed_at = n;
}
long writes_so_far() { return counted; }

ssize_t write(int file, const void* from, size_t size) {
  static const auto real = original<decltype(&write)>("write");
  if (!is_file(file)) return real(file, from, size);
  return decide([&] { return real(file, from, size); }, [&] { return real(file, from, size / 2); });
}
ssize_t writev(int file, const iovec* parts, int n) {
  static const auto real = original<decltype(&writev)>("writev");
  if (!is_file(file)) return real(file, parts, n);
  return decide([&] { return real(file, parts, n); }, [&] { return real(file, parts, n / 2); });
}
ssize_t pwrite(int file, const void* from, size_t size, off_t at) {
  static const auto real = original<decltype(&pwrite)>("pwrite");
  return decide([&] { return real(file, from, size, at); }, [&] { return real(file, from, size / 2, at); });
}
ssize_t pwrite64(int file, const void* from, size_t size, off64_t at) {
  static const auto real = original<decltype(&pwrite64)>("pwrite64");
  return decide([&] { return real(file, from, size, at); }, [&] { return real(file, from, size / 2, at); });
}
ssize_t sendfile(int to, int from, off_t* at, size_t size) {
  static const auto real = original<decltype(&sendfile)>("sendfile");
  return decide([&] { return real(to, from, at, size); }, [&] { return real(to, from, at, size / 2); });
}
ssize_t sendfile64(int to, int from, off64_t* at, size_t size) {
  static const auto real = original<decltype(&sendfile64)>("sendfile64");
  return decide([&] { return real(to, from, at, size); }, [&] { return real(to, from, at, size / 2); });
}
int rename(const char* from, const char* to) {
  static const auto real = original<decltype(&rename)>("rename");
  return decide([&] { return real(from, to); }, [] {});
}
int unlink(const char* path) {
  static const auto real = original<decltype(&unlink)>("unlink");
  return decide([&] { return real(path); }, [] {});
}
int remove(const char* path) {
  static const auto real = original<decltype(&remove)>("remove");
  return decide([&] { return real(path); }, [] {});
}
int truncate(const char* path, off_t size) {
  static const auto real = original<decltype(&truncate)>("truncate");
  return decide([&] { return real(path, size); }, [] {});
}
int ftruncate(int file, off_t size) {
  static const auto real = original<decltype(&ftruncate)>("ftruncate");
  return decide([&] { return real(file, size); }, [] {});
}
int ftruncate64(int file, off64_t size) {
  static const auto real = original<decltype(&ftruncate64)>("ftruncate64");
  return decide([&] { return real(file, size); }, [] {});
}
int fsync(int file) {
  static const auto real = original<decltype(&fsync)>("fsync");
  return decide([&] { return real(file); }, [] {});
}

}  // extern "C"
