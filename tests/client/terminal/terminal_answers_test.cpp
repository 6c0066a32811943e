#include "client/terminal/terminal_answers.h"

#include "scripted_terminal.h"

using namespace woodlouse::client;
using namespace std::chrono_literals;

namespace {

struct Asked {
  TerminalAnswers answers;
  std::vector<TerminalInput> typed;
  std::chrono::steady_clock::duration took;
};

/// Asks a terminal that answers, once asked, by these parts with 20 ms before each.
Asked asked(const std::vector<std::string>& parts, std::chrono::milliseconds patience = 1000ms) {
  const PseudoTerminal terminal;
  const auto begin = std::chrono::steady_clock::now();
  std::string questions;
  std::thread other([&] {
    questions = terminal.written_until("\x1b[c", 2000ms);
    for (const std::string& part : parts) {
      std::this_thread::sleep_for(20ms);
      terminal.type(part);
    }
  });
  KeySource keys{terminal.slave(), {}, {}};
  Asked result;
  {
    const auto guard = TerminalGuard::enter(terminal.slave(), terminal.slave(), TerminalUse::kKeysOnly);
    REQUIRE(guard);
    (*guard)->ask(terminal_questions());
    result.answers = await_answers(**guard, keys, std::chrono::steady_clock::now() + patience);
    result.took = std::chrono::steady_clock::now() - begin;
    result.typed = keys.typed;
    other.join();
  }
  CHECK(questions.find("\x1bP$qm\x1b\\") != std::string::npos);
  CHECK_FALSE(terminal.has_input());
  return result;
}

}  // namespace

TEST_CASE("a terminal that answers all is asked once and believed") {
  const Asked all = asked({kKnowsAll});
  CHECK(all.answers.is_finished());
  CHECK(all.answers.truecolor() == true);
  CHECK(all.answers.utf8() == true);
  CHECK(all.answers.narrow_blocks() == true);
  CHECK(all.answers.synchronizes());
  CHECK(all.answers.kitty());
  CHECK(all.typed.empty());
}

TEST_CASE("answers in halves and keys between them are told apart") {
  const std::vector<std::string> parts = {kKnowsAll.substr(0, 3), kKnowsAll.substr(3, 20),
                                          kKnowsAll.substr(23, 14), "?", kKnowsAll.substr(37)};
  const Asked halves = asked(parts);
  CHECK(halves.answers.truecolor() == true);
  CHECK(halves.answers.narrow_blocks() == true);
  CHECK(halves.typed == std::vector<TerminalInput>{Key{.character = U'?'}});
}

TEST_CASE("what a terminal does not know it is not thought to") {
  // 256 colours, no mode 2026, East Asian width, no kitty.
  const Asked old = asked({"\x1b[?2026;0$y\x1bP1$r48:5:16m\x1b\\\x1b[5;2R\x1b[5;3R\x1b[?6c"});
  CHECK(old.answers.truecolor() == false);
  CHECK(old.answers.utf8() == true);
  CHECK(old.answers.narrow_blocks() == false);
  CHECK_FALSE(old.answers.synchronizes());
  CHECK_FALSE(old.answers.kitty());
  const Asked latin = asked({"\x1bP0$r\x1b\\\x1b[5;3R\x1b[5;4R\x1b[?6c"});
  CHECK(latin.answers.truecolor() == std::nullopt);
  CHECK(latin.answers.utf8() == false);
}

TEST_CASE("a terminal that answers nothing is waited for no longer than it may take") {
  const Asked silent = asked({"w"}, 100ms);
  CHECK_FALSE(silent.answers.is_finished());
  CHECK(silent.answers.truecolor() == std::nullopt);
  CHECK(silent.typed == std::vector<TerminalInput>{Key{.character = U'w'}});
  CHECK(silent.took < 1500ms);
}

TEST_CASE("answers that have come while something else was done are all read, though nobody waits any more") {
  const PseudoTerminal terminal;
  KeySource keys{terminal.slave(), {}, {}};
  const auto guard = TerminalGuard::enter(terminal.slave(), terminal.slave(), TerminalUse::kKeysOnly);
  REQUIRE(guard);
  (*guard)->ask(terminal_questions());
  terminal.type(kKnowsAll);
  const TerminalAnswers answers = await_answers(**guard, keys, std::chrono::steady_clock::now());
  CHECK(answers.is_finished());
  CHECK(answers.truecolor() == true);
}

TEST_CASE("garbage answers nothing and ends with the last answer") {
  const Asked garbage =
      asked({"\x1bP\xff\xfe$r48\x1b[\x1b[;;;R\x1b[?;$y\x1b]0;x\x07\x1b[99999999999;2R\x1b[?c"});
  CHECK(garbage.answers.is_finished());
  CHECK(garbage.answers.truecolor() == std::nullopt);
  CHECK_FALSE(garbage.answers.synchronizes());
}
