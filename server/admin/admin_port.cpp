#include "server/admin/admin_port.h"

#include <spdlog/fmt/fmt.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/local/stream_protocol.hpp>

#include <cassert>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "server/logging/events.h"
#include "shared/core/joined.h"

namespace woodlouse::server {
namespace {

namespace asio = boost::asio;
namespace fs = std::filesystem;
using boost::system::error_code;

constexpr std::chrono::milliseconds kAdminPause{100};  // after accepting failed

std::string error_text(int number) { return std::generic_category().message(number); }

/// Whether somebody listens behind it; nothing: that can't be found out, errno says why.
std::optional<bool> is_living(const fs::path& path) {
  const int socket = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (socket < 0) return std::nullopt;
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string& text = path.native();
  assert(text.size() < sizeof(address.sun_path));
  std::memcpy(address.sun_path, text.c_str(), text.size());
  const int result = ::connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof(address));
  const int error = errno;
  ::close(socket);
  if (result == 0 || error == EAGAIN) return true;  // a full queue is somebody's
  if (error == ECONNREFUSED) return false;
  errno = error;
  return std::nullopt;
}

/// What stands in the way of a socket there goes, if nobody needs it.
core::Expected<void> clear_way(const fs::path& path) {
  const std::string where = "--admin " + path.string();
  struct stat there {};
  if (::lstat(path.c_str(), &there) != 0) {
    if (errno == ENOENT) return {};
    return core::fail(where, error_text(errno), "does its folder exist, and may you write there?");
  }
  if (!S_ISSOCK(there.st_mode))
    return core::fail(where, "is there already, and no socket: it is left alone", "choose another name");
  const auto living = is_living(path);
  if (!living) return core::fail(where, "is there, and can't be asked who listens: " + error_text(errno));
  if (*living)
    return core::fail(where, "another server listens there",
                      "each needs a socket of its own:  --admin " + path.string() + ".2");
  if (::unlink(path.c_str()) != 0 && errno != ENOENT)
    return core::fail(where,
                      "is left from a server that was killed, and can't be removed: " + error_text(errno));
  return {};
}

}  // namespace

AdminPort::AdminPort(Strand strand, std::shared_ptr<spdlog::logger> log)
    : strand_(std::move(strand)), log_(std::move(log)), acceptor_(strand_), pause_(strand_) {
  assert(log_ != nullptr);
}

core::Expected<std::string> AdminPort::open(const AdminAddress& address) {
  assert(!acceptor_.is_open());
  if (const auto* path = std::get_if<fs::path>(&address)) return open_socket(*path);
  return open_port(std::get<ListenAddress>(address));
}

core::Expected<std::string> AdminPort::open_socket(const fs::path& path) {
  const std::string where = "--admin " + path.string();
  // The default's folder in /tmp is ours alone, or it is nobody's to be trusted.
  if (path == default_admin_socket() && ::mkdir(path.parent_path().c_str(), 0700) != 0 && errno != EEXIST)
    return core::fail(where, "its folder can't be made: " + error_text(errno));
  struct stat folder {};
  if (path == default_admin_socket() && (::lstat(path.parent_path().c_str(), &folder) != 0 ||
                                         !S_ISDIR(folder.st_mode) || folder.st_uid != ::geteuid()))
    return core::fail(where, "its folder is not yours", "name another one:  --admin PATH");
  if (const auto cleared = clear_way(path); !cleared) return tl::unexpected(cleared.error());
  error_code error;
  const asio::local::stream_protocol::endpoint endpoint(path.string());
  acceptor_.open(endpoint.protocol(), error);
  if (!error) acceptor_.bind(endpoint, error);
  if (error) return core::fail(where, error.message(), "does its folder exist, and may you write there?");
  struct stat made {};
  if (::lstat(path.c_str(), &made) != 0) return core::fail(where, error_text(errno));
  path_ = fs::absolute(path);
  device_ = made.st_dev;
  inode_ = made.st_ino;
  // Nobody can connect before listen().
  if (::chmod(path.c_str(), 0600) != 0) return core::fail(where, error_text(errno));
  acceptor_.listen(asio::socket_base::max_listen_connections, error);
  if (error) return core::fail(where, error.message());
  return path.string();
}

core::Expected<std::string> AdminPort::open_port(const ListenAddress& address) {
  const std::string where = "--admin " + to_text(address);
  error_code error;
  asio::ip::tcp::resolver resolver(strand_);
  const auto found =
      resolver.resolve(address.host, std::to_string(address.port), asio::ip::tcp::resolver::passive, error);
  if (error) return core::fail(where, error.message(), "for example  --admin 127.0.0.1:7779");
  const asio::ip::tcp::endpoint endpoint = found.begin()->endpoint();
  if (!endpoint.address().is_loopback())
    return core::fail(where, "what it says goes in plain text, and so on this machine alone",
                      "--admin 127.0.0.1:7779, and from outside  ssh -L 7779:127.0.0.1:7779 HOST");
  acceptor_.open(endpoint.protocol(), error);
  if (!error) acceptor_.set_option(asio::socket_base::reuse_address(true), error);
  if (!error) acceptor_.bind(endpoint, error);
  if (!error) acceptor_.listen(asio::socket_base::max_listen_connections, error);
  if (error) return core::fail(where, error.message(), "try the same with  --admin 127.0.0.1:0");
  sockaddr_storage bound{};
  socklen_t size = sizeof(bound);
  if (::getsockname(acceptor_.native_handle(), reinterpret_cast<sockaddr*>(&bound), &size) != 0)
    return core::fail(where, error_text(errno));
  asio::ip::tcp::endpoint taken;
  assert(size <= taken.capacity());
  std::memcpy(taken.data(), &bound, size);
  return to_text(taken);
}

void AdminPort::start(std::function<void(Socket)> taken) {
  assert(!taken_ && taken);
  taken_ = std::move(taken);
  if (acceptor_.is_open()) accept();
}

void AdminPort::accept() {
  acceptor_.async_accept([this](const error_code& error, Socket socket) {
    if (!acceptor_.is_open()) return;
    if (error) {
      if (!std::exchange(is_starved_, true))
        log_event(*log_, LogEvent::kAcceptFailed,
                  fmt::format("cannot accept a connection to the admin door: {}", error.message()));
      return pause();
    }
    is_starved_ = false;
    taken_(std::move(socket));
    accept();
  });
}

void AdminPort::pause() {
  pause_.expires_after(kAdminPause);
  pause_.async_wait([this](const error_code& error) {
    if (!error && acceptor_.is_open()) accept();
  });
}

void AdminPort::close() {
  error_code ignored;  // closed all the same
  acceptor_.close(ignored);
  pause_.cancel();
  remove();
}

/// Another server's, which took this one for dead, stays.
void AdminPort::remove() {
  if (path_.empty()) return;
  struct stat there {};
  if (::lstat(path_.c_str(), &there) == 0 && there.st_dev == device_ && there.st_ino == inode_)
    ::unlink(path_.c_str());
  path_.clear();
}

}  // namespace woodlouse::server
