// What the admin door asks of the server behind it.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "server/admin/command.h"
#include "server/web/web_answers.h"

namespace woodlouse::server {

/// Any thread; every call returns at once, and none waits for a tick, a disk or a client.
class Control {
 public:
  /// A whole line (answer.h). Called once, on any thread; never, where the server has ended by then.
  using Answered = std::function<void(std::string line)>;

  Control() = default;
  Control(const Control&) = delete;
  Control& operator=(const Control&) = delete;
  virtual ~Control() = default;

  virtual void carry_out(Command command, Answered answered) = 0;
  /// What GET of that path, without its query, is answered.
  [[nodiscard]] virtual WebAnswer page(std::string_view path) const = 0;
};

}  // namespace woodlouse::server
