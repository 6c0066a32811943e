#include "server/commands/admin.h"

#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/un.h>
#include <unistd.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>

#include <cassert>
#include <cerrno>
#include <cstring>
#include <ostream>
#include <string>
#include <string_view>
#include <system_error>

#include "shared/core/joined.h"
#include "shared/core/printable.h"
#include "shared/core/whole_file.h"
#include "shared/json/document.h"
#include "shared/json/text.h"

namespace woodlouse::server {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostAnswerBytes = 8u << 20;
constexpr std::size_t kMostTokenFileBytes = 1024;
constexpr int kPatienceSeconds = 30;

/// A descriptor that is closed at the end.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  [[nodiscard]] int number() const { return number_; }

 private:
  int number_;
};

std::string words(int error) { return std::generic_category().message(error); }

core::Error no_door(const AdminAddress& where, int error) {
  const std::string place = to_text(where);
  const bool is_socket = std::holds_alternative<fs::path>(where);
  if (error == ENOENT)
    return {place, "no server has its door there",
            "start one with  --admin " + place + "  or say where it is:  admin --socket PATH ..."};
  if (error == ECONNREFUSED)
    return {place, is_socket ? "the server that left this socket is gone" : "nobody listens there",
            "does the server run, and with which --admin?"};
  if (error == EACCES)
    return {place, words(error), "the door is for the user that the server runs as:  sudo -u USER ..."};
  return {place, words(error), ""};
}

core::Expected<Descriptor> connected_socket(const AdminAddress& where, const fs::path& path) {
  Descriptor socket(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string& text = path.native();
  assert(text.size() < sizeof(address.sun_path));
  std::memcpy(address.sun_path, text.c_str(), text.size());
  if (socket.number() < 0 ||
      ::connect(socket.number(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0)
    return tl::unexpected(no_door(where, errno));
  return socket;
}

core::Expected<Descriptor> connected_port(const AdminAddress& where, const ListenAddress& port) {
  boost::asio::io_context context;
  boost::asio::ip::tcp::resolver resolver(context);
  boost::system::error_code error;
  const auto found = resolver.resolve(port.host, std::to_string(port.port), error);
  if (error) return core::fail(to_text(where), error.message());
  const auto endpoint = found.begin()->endpoint();
  // Whoever is elsewhere gets no token in plain text.
  if (!endpoint.address().is_loopback())
    return core::fail(to_text(where), "is not on this machine, and a token would go there in plain text",
                      "ssh -L 7779:127.0.0.1:7779 HOST, then --connect 127.0.0.1:7779");
  Descriptor socket(::socket(endpoint.protocol().family(), SOCK_STREAM | SOCK_CLOEXEC, 0));
  if (socket.number() < 0 ||
      ::connect(socket.number(), endpoint.data(), static_cast<socklen_t>(endpoint.size())) != 0)
    return tl::unexpected(no_door(where, errno));
  return socket;
}

/// Those that take as long as a game or a disk does.
bool is_patient(Verb verb) { return verb == Verb::kStep || verb == Verb::kOpen || verb == Verb::kClose; }

core::Expected<std::string> ask(const AdminErrand& errand, const std::string& line) {
  const std::string place = to_text(errand.where);
  const auto* path = std::get_if<fs::path>(&errand.where);
  const auto socket = path != nullptr ? connected_socket(errand.where, *path)
                                      : connected_port(errand.where, std::get<ListenAddress>(errand.where));
  if (!socket) return tl::unexpected(socket.error());
  const timeval patience{is_patient(errand.command.verb) ? 0 : kPatienceSeconds, 0};
  static_cast<void>(::setsockopt(socket->number(), SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof(patience)));
  std::string_view left = line;
  while (!left.empty()) {
    const ssize_t sent = ::send(socket->number(), left.data(), left.size(), MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) break;  // then it says why, or nothing
    left.remove_prefix(static_cast<std::size_t>(sent));
  }
  std::string answer;
  char bytes[16384];
  while (answer.find('\n') == std::string::npos && answer.size() <= kMostAnswerBytes) {
    const ssize_t size = ::recv(socket->number(), bytes, sizeof(bytes), 0);
    if (size < 0 && errno == EINTR) continue;
    if (size < 0)
      return core::fail(place, errno == EAGAIN ? "no answer within 30 s" : words(errno),
                        "the command may be carried out all the same");
    if (size == 0) return core::fail(place, "the server closed the connection without an answer");
    answer.append(bytes, static_cast<std::size_t>(size));
  }
  return answer.substr(0, answer.find('\n'));
}

core::Expected<std::string> token_of(const fs::path& file) {
  auto bytes = core::read_whole_file(file, kMostTokenFileBytes);
  if (!bytes) return core::fail("--token-file " + file.string(), bytes.error().what, bytes.error().hint);
  return bytes->substr(0, bytes->find_first_of("\r\n"));
}

/// Each line of it, fit for a terminal.
void show(std::string_view text, std::ostream& out) {
  while (true) {
    const std::size_t end = text.find('\n');
    out << core::printable(text.substr(0, end)) << '\n';
    if (end == std::string_view::npos) return;
    text.remove_prefix(end + 1);
  }
}

int complain(const core::Error& error, std::ostream& err) {
  err << "woodlouse-server admin: " << (error.where.empty() ? "" : error.where + ": ") << error.what << '\n';
  if (!error.hint.empty()) err << "      " << error.hint << '\n';
  return kNoDoor;
}

}  // namespace

int admin_command(const AdminErrand& errand, std::ostream& out, std::ostream& err) {
  AdminLine line{errand.command, {}};
  if (errand.token_file) {
    auto token = token_of(*errand.token_file);
    if (!token) return complain(token.error(), err);
    line.token = std::move(*token);
  }
  const auto answer = ask(errand, encode(line));
  if (!answer) return complain(answer.error(), err);
  const auto document = json::parse(*answer, {8, 1'000'000});
  const auto type = document ? document->root().find("type") : std::nullopt;
  const auto text = document ? document->root().find("text") : std::nullopt;
  if (!type || !text || !type->is(json::Kind::kString) || !text->is(json::Kind::kString))
    return complain({to_text(errand.where), "what listens there is no admin door of ours", ""}, err);
  const bool is_done = type->text() == "done";
  if (errand.as_json)
    out << json::printable_json(*answer) << '\n';
  else
    show(text->text(), is_done ? out : err);
  return is_done ? 0 : kAdminRefused;
}

}  // namespace woodlouse::server
