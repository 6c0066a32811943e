// A library for LD_PRELOAD: a program's calls to the system are counted by kind, and one of them, or all from
// one on, fails. tests/e2e/server/injection_test.py plays games with it.
//
//   WOODLOUSE_FAIL=write:3:ENOSPC     the third write fails
//   WOODLOUSE_FAIL=write:3+:ENOSPC    so do all after it
//   WOODLOUSE_FAIL=send:4@:ECONNRESET so do all after it of the same descriptor
//   WOODLOUSE_FAIL=alloc:1000         the thousandth request for memory gets none
//   WOODLOUSE_FAIL_LISTENING=1        calls count once the program listens
//   WOODLOUSE_CALLS=file              gets `failed write 3` when that happens, and at exit a line `write 17`
//   a
//                                     kind; a program that is killed or ends by _Exit writes no counts
//
// Kinds: `kKinds`. A write is one to a file; that to standard error is a log, one to a socket a send. Of
// epoll_ctl what adds a descriptor is counted, as nothing else needs memory. Calls that the C library makes
// for itself (stdio's, the resolver's) are not seen, but for those for memory.
#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/timerfd.h>
#include <sys/uio.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string_view>

extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
}

namespace {

enum Kind {
  kWrite,
  kLog,
  kOpen,
  kDescriptor,
  kAccept,
  kSend,
  kRecv,
  kTimer,
  kEpoll,
  kOption,
  kLock,
  kClose,
  kThread,
  kSync,
  kRename,
  kCut,
  kAlloc,
};
constexpr std::array<std::string_view, kAlloc + 1> kKinds = {
    "write",  "log",  "open",  "descriptor", "accept", "send",   "recv", "timer", "epoll",
    "option", "lock", "close", "thread",     "sync",   "rename", "cut",  "alloc"};

struct Name {
  std::string_view text;
  int number;
};
constexpr Name kErrors[] = {{"ENOSPC", ENOSPC},
                            {"EIO", EIO},
                            {"EMFILE", EMFILE},
                            {"ENFILE", ENFILE},
                            {"EACCES", EACCES},
                            {"EINVAL", EINVAL},
                            {"ENOMEM", ENOMEM},
                            {"EAGAIN", EAGAIN},
                            {"ECONNRESET", ECONNRESET},
                            {"EPIPE", EPIPE},
                            {"ENOBUFS", ENOBUFS},
                            {"ECONNABORTED", ECONNABORTED},
                            {"EINTR", EINTR},
                            {"EFBIG", EFBIG},
                            {"ETIMEDOUT", ETIMEDOUT},
                            {"ENOENT", ENOENT},
                            {"EWOULDBLOCK", EWOULDBLOCK}};

std::array<std::atomic<long>, kKinds.size()> counts;
std::atomic<bool> is_counting{false};
int kind_that_fails = -1;
long first_that_fails = 0;
char reach = '\0';  // '+' or '@', as above
std::atomic<int> descriptor_that_fails{-1};
int error_of_failure = 0;
int calls_file = -1;

template <typename... Arguments>
void tell(const char* format, Arguments... arguments) {
  if (calls_file < 0) return;
  char line[80];
  const int size = std::snprintf(line, sizeof line, format, arguments...);
  ::syscall(SYS_write, calls_file, line, static_cast<std::size_t>(size));
}

[[noreturn]] void refuse(const char* what) {
  std::fprintf(stderr, "failing_calls: WOODLOUSE_FAIL: %s\n", what);
  std::_Exit(3);
}

/// kind:number[+|@][:error]
void read_order(std::string_view order) {
  const auto part = [&order] {
    const std::size_t end = std::min(order.find(':'), order.size());
    const std::string_view head = order.substr(0, end);
    order.remove_prefix(std::min(end + 1, order.size()));
    return head;
  };
  const std::string_view kind = part(), number = part(), error = part();
  for (std::size_t k = 0; k < kKinds.size(); ++k)
    if (kKinds[k] == kind) kind_that_fails = static_cast<int>(k);
  if (kind_that_fails < 0) refuse("no such kind of call");
  first_that_fails = std::atol(number.data());
  if (first_that_fails < 1) refuse("calls are counted from 1");
  if (const char last = number.back(); last == '+' || last == '@') reach = last;
  error_of_failure = kind_that_fails == kAlloc ? ENOMEM : 0;
  for (const Name& name : kErrors)
    if (name.text == error) error_of_failure = name.number;
  if (error_of_failure == 0) refuse("no such error");
}

__attribute__((constructor)) void begin() {
  if (const char* file = std::getenv("WOODLOUSE_CALLS"))
    calls_file = static_cast<int>(
        ::syscall(SYS_openat, AT_FDCWD, file, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666));
  if (const char* order = std::getenv("WOODLOUSE_FAIL")) read_order(order);
  is_counting = std::getenv("WOODLOUSE_FAIL_LISTENING") == nullptr;
}

__attribute__((destructor)) void end() {
  is_counting = false;
  for (std::size_t k = 0; k < kKinds.size(); ++k) tell("%s %ld\n", kKinds[k].data(), counts[k].load());
}

/// Whether this call is to fail: then errno is set.
bool fails(Kind kind, int descriptor = -1) {
  if (!is_counting.load(std::memory_order_relaxed)) return false;
  const long number = ++counts[kind];
  if (kind != kind_that_fails || number < first_that_fails) return false;
  if (number == first_that_fails) {
    tell("failed %s %ld\n", kKinds[kind].data(), number);
    descriptor_that_fails = descriptor;
  } else if (reach == '\0' || (reach == '@' && descriptor != descriptor_that_fails)) {
    return false;
  }
  errno = error_of_failure;
  return true;
}

/// What the program would have called.
template <typename Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

bool is_socket(int descriptor) {
  struct stat status {};
  return ::fstat(descriptor, &status) == 0 && S_ISSOCK(status.st_mode);
}

/// Not the pipes and events by which threads wake each other: those don't fail.
bool fails_to_write(int descriptor) {
  if (descriptor == STDERR_FILENO) return fails(kLog);
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) return false;
  if (S_ISSOCK(status.st_mode)) return fails(kSend, descriptor);
  return S_ISREG(status.st_mode) && fails(kWrite);
}

}  // namespace

extern "C" {

ssize_t write(int descriptor, const void* bytes, std::size_t size) {
  return fails_to_write(descriptor) ? -1 : ::syscall(SYS_write, descriptor, bytes, size);
}
ssize_t writev(int descriptor, const iovec* parts, int count) {
  return fails_to_write(descriptor) ? -1 : ::syscall(SYS_writev, descriptor, parts, count);
}

int open(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const auto mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(rest, mode_t) : mode_t{0};
  va_end(rest);
  return fails(kOpen) ? -1 : static_cast<int>(::syscall(SYS_openat, AT_FDCWD, path, flags, mode));
}
int open64(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const auto mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(rest, mode_t) : mode_t{0};
  va_end(rest);
  return fails(kOpen) ? -1 : static_cast<int>(::syscall(SYS_openat, AT_FDCWD, path, flags, mode));
}
FILE* fopen(const char* path, const char* mode) {
  static const auto next = real<decltype(fopen)>("fopen");
  return fails(kOpen) ? nullptr : next(path, mode);
}
FILE* fopen64(const char* path, const char* mode) {
  static const auto next = real<decltype(fopen64)>("fopen64");
  return fails(kOpen) ? nullptr : next(path, mode);
}
int close(int descriptor) {
  // As Linux does: the descriptor is gone all the same.
  if (descriptor == descriptor_that_fails) descriptor_that_fails = -2;  // the next of that number is another
  const auto result = static_cast<int>(::syscall(SYS_close, descriptor));
  return descriptor > STDERR_FILENO && fails(kClose) ? -1 : result;
}
int flock(int descriptor, int operation) {
  return fails(kLock) ? -1 : static_cast<int>(::syscall(SYS_flock, descriptor, operation));
}

int fsync(int descriptor) { return fails(kSync) ? -1 : static_cast<int>(::syscall(SYS_fsync, descriptor)); }
int rename(const char* from, const char* to) noexcept {
  return fails(kRename) ? -1 : static_cast<int>(::syscall(SYS_rename, from, to));
}
int ftruncate(int descriptor, off_t size) noexcept {
  return fails(kCut) ? -1 : static_cast<int>(::syscall(SYS_ftruncate, descriptor, size));
}

int socket(int domain, int type, int protocol) noexcept {
  return fails(kDescriptor) ? -1 : static_cast<int>(::syscall(SYS_socket, domain, type, protocol));
}
int pipe(int ends[2]) noexcept {
  return fails(kDescriptor) ? -1 : static_cast<int>(::syscall(SYS_pipe2, ends, 0));
}
int eventfd(unsigned value, int flags) noexcept {
  return fails(kDescriptor) ? -1 : static_cast<int>(::syscall(SYS_eventfd2, value, flags));
}
int timerfd_create(int clock, int flags) noexcept {
  return fails(kDescriptor) ? -1 : static_cast<int>(::syscall(SYS_timerfd_create, clock, flags));
}
int epoll_create1(int flags) noexcept {
  return fails(kDescriptor) ? -1 : static_cast<int>(::syscall(SYS_epoll_create1, flags));
}

int listen(int descriptor, int backlog) {
  const int result = static_cast<int>(::syscall(SYS_listen, descriptor, backlog));
  is_counting = true;
  return result;
}
int accept(int descriptor, sockaddr* address, socklen_t* size) {
  return fails(kAccept) ? -1 : static_cast<int>(::syscall(SYS_accept4, descriptor, address, size, 0));
}
int accept4(int descriptor, sockaddr* address, socklen_t* size, int flags) {
  return fails(kAccept) ? -1 : static_cast<int>(::syscall(SYS_accept4, descriptor, address, size, flags));
}
ssize_t send(int descriptor, const void* bytes, std::size_t size, int flags) {
  return fails(kSend, descriptor) ? -1 : ::syscall(SYS_sendto, descriptor, bytes, size, flags, nullptr, 0);
}
ssize_t sendmsg(int descriptor, const msghdr* message, int flags) {
  return fails(kSend, descriptor) ? -1 : ::syscall(SYS_sendmsg, descriptor, message, flags);
}
ssize_t recv(int descriptor, void* bytes, std::size_t size, int flags) {
  return fails(kRecv, descriptor) ? -1
                                  : ::syscall(SYS_recvfrom, descriptor, bytes, size, flags, nullptr, nullptr);
}
ssize_t recvmsg(int descriptor, msghdr* message, int flags) {
  return fails(kRecv, descriptor) ? -1 : ::syscall(SYS_recvmsg, descriptor, message, flags);
}
int setsockopt(int descriptor, int level, int name, const void* value, socklen_t size) noexcept {
  return fails(kOption) ? -1
                        : static_cast<int>(::syscall(SYS_setsockopt, descriptor, level, name, value, size));
}

int timerfd_settime(int descriptor, int flags, const itimerspec* value, itimerspec* before) noexcept {
  return fails(kTimer) ? -1
                       : static_cast<int>(::syscall(SYS_timerfd_settime, descriptor, flags, value, before));
}
int epoll_ctl(int epoll, int operation, int descriptor, epoll_event* event) noexcept {
  if (operation == EPOLL_CTL_ADD && is_socket(descriptor) && fails(kEpoll)) return -1;
  return static_cast<int>(::syscall(SYS_epoll_ctl, epoll, operation, descriptor, event));
}

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*body)(void*),
                   void* argument) noexcept {
  static const auto next = real<decltype(pthread_create)>("pthread_create");
  return fails(kThread) ? error_of_failure : next(thread, attributes, body, argument);
}

void* malloc(std::size_t size) noexcept { return fails(kAlloc) ? nullptr : __libc_malloc(size); }
void* calloc(std::size_t count, std::size_t size) noexcept {
  return fails(kAlloc) ? nullptr : __libc_calloc(count, size);
}
void* realloc(void* memory, std::size_t size) noexcept {
  return fails(kAlloc) ? nullptr : __libc_realloc(memory, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  return fails(kAlloc) ? nullptr : __libc_memalign(alignment, size);
}
int posix_memalign(void** memory, std::size_t alignment, std::size_t size) noexcept {
  if (fails(kAlloc)) return ENOMEM;
  *memory = __libc_memalign(alignment, size);
  return *memory == nullptr ? ENOMEM : 0;
}

}  // extern "C"
