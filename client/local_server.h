// A game without an address: starts the woodlouse-server that lies beside this program, on a free loopback
// port, and ends it with this object. Should this process die without a word, the kernel ends it.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <memory>
#include <string>

#include "client/net/address.h"
#include "shared/core/error.h"

namespace woodlouse::client {

struct LocalServerSettings {
  std::filesystem::path map;  ///< a map file
  int bots = 3;
};

class LocalServer {
 public:
  /// Starts it and waits for `listening HOST:PORT` and `web URL`, at most 5 s. Error: what it said instead.
  static core::Expected<std::unique_ptr<LocalServer>> start(const LocalServerSettings& settings);
  /// SIGTERM, then after 1 s SIGKILL.
  ~LocalServer();
  LocalServer(const LocalServer&) = delete;
  LocalServer& operator=(const LocalServer&) = delete;

  [[nodiscard]] const Address& address() const { return address_; }
  /// Where browsers find its page, "http://127.0.0.1:7778/"; another port where that is taken.
  [[nodiscard]] const std::string& page() const { return page_; }
  /// Whether it still runs; reaps it when not, and takes in what it said. Call it now and then.
  [[nodiscard]] bool alive();
  /// The end of its standard error, for a person who asks why it ended.
  [[nodiscard]] std::string last_words();

 private:
  LocalServer(pid_t process, int output, int log) : process_(process), output_(output), log_(log) {}
  static core::Expected<std::unique_ptr<LocalServer>> start(const LocalServerSettings& settings,
                                                            const char* web);
  core::Expected<void> wait_until_listening();

  pid_t process_;  ///< 0 once it is reaped
  int output_;  ///< read end of its standard output; owned, open to the end so that its summary has a place
  int log_;     ///< read end of its standard error, non-blocking; owned
  std::string words_;  ///< the last of its standard error
  Address address_;
  std::string page_;
};

}  // namespace woodlouse::client
