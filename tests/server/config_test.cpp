#include "server/config.h"

#include <unistd.h>

#include <catch2/catch.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

using namespace woodlouse;
using namespace woodlouse::server;

namespace {

core::Expected<Config> parse(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "woodlouse-server");
  return parse_config(static_cast<int>(arguments.size()), arguments.data());
}

ServeConfig serve(const std::vector<const char*>& arguments) {
  const auto config = parse(arguments);
  if (!config) FAIL(config.error().text());
  REQUIRE(std::holds_alternative<ServeConfig>(*config));
  return std::get<ServeConfig>(*config);
}

class Variable {
 public:
  Variable(const char* name, const char* value) : name_(name) { ::setenv(name, value, 1); }
  ~Variable() { ::unsetenv(name_); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
};

class File {
 public:
  explicit File(const std::string& text)
      : path_((std::filesystem::temp_directory_path() /
               ("woodlouse_config_test_" + std::to_string(::getpid()) + ".json"))
                  .string()) {
    std::ofstream(path_) << text;
  }
  ~File() { std::filesystem::remove(path_); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  [[nodiscard]] const char* path() const { return path_.c_str(); }

 private:
  std::string path_;
};

}  // namespace

TEST_CASE("what is not asked for has its default") {
  const ServeConfig config = serve({"--map", "a.json"});
  CHECK(config.listen == ListenAddress{"127.0.0.1", 7777});
  CHECK(config.tick_hz == 60);
  CHECK(config.state_hz == 20);
  CHECK(config.bots == 0);
  CHECK_FALSE(config.bots_alone_play);
  CHECK(config.step_threads == 1);
  CHECK_FALSE(config.seed);
  CHECK_FALSE(config.record);
  CHECK_FALSE(config.ticks);
}

TEST_CASE("flags are read, several maps make several rooms") {
  const ServeConfig config = serve({"--map",
                                    "a.json",
                                    "b.json",
                                    "--listen",
                                    "[::1]:0",
                                    "--tick-hz",
                                    "120",
                                    "--state-hz",
                                    "40",
                                    "--record",
                                    "game.ndjson",
                                    "--ticks",
                                    "7",
                                    "--seed",
                                    "18446744073709551615",
                                    "--bots",
                                    "3",
                                    "--bots-skill",
                                    "hard",
                                    "--bots-alone",
                                    "play",
                                    "--step-threads",
                                    "64",
                                    "--log-format",
                                    "json"});
  CHECK(config.maps == std::vector<std::filesystem::path>{"a.json", "b.json"});
  CHECK(config.listen == ListenAddress{"::1", 0});
  CHECK(config.tick_hz == 120);
  CHECK(config.state_hz == 40);
  CHECK(config.record->pattern.file("x", 0) == "game.x.ndjson");
  CHECK(config.ticks == 7u);
  CHECK(config.seed == 18446744073709551615u);
  CHECK(config.bots == 3);
  CHECK(config.bots_skill == bots::Skill::kHard);
  CHECK(config.bots_alone_play);
  CHECK(config.step_threads == 64);
  CHECK(config.log_format == LogFormat::kJson);
}

TEST_CASE("a flag goes over a variable, a variable over the file, the file over the default") {
  const File file(
      R"({"map": ["f.json", "g.json"], "bots": 1, "tick_hz": 30, "state-hz": 10, "seed": 5, "record": "r"})");
  const Variable bots("WOODLOUSE_BOTS", "2");
  const Variable hz("WOODLOUSE_TICK_HZ", "50");
  const ServeConfig config = serve({"--config", file.path(), "--bots", "3"});
  CHECK(config.bots == 3);
  CHECK(config.tick_hz == 50);
  CHECK(config.state_hz == 10);
  CHECK(config.seed == 5u);
  CHECK(config.record->pattern.file("f", 0) == "r.f.ndjson.zst");
  CHECK(config.maps == std::vector<std::filesystem::path>{"f.json", "g.json"});
}

TEST_CASE("the file may be named by a variable too") {
  const File file(R"({"map": "f.json", "bots": 9})");
  const Variable config_file("WOODLOUSE_CONFIG", file.path());
  CHECK(serve({}).bots == 9);
}

TEST_CASE("a wrong option is refused by its name") {
  const auto [arguments, names] = GENERATE(table<std::vector<const char*>, std::string>({
      {std::vector<const char*>{}, "--map"},
      {{"--map", "a", "--tick-hz", "0"}, "--tick-hz"},
      {{"--map", "a", "--tick-hz", "1001"}, "--tick-hz"},
      {{"--map", "a", "--tick-hz", "sixty"}, "--tick-hz"},
      {{"--map", "a", "--state-hz", "25"}, "--state-hz"},
      {{"--map", "a", "--state-hz", "120"}, "--state-hz"},
      {{"--map", "a", "--bots", "-1"}, "--bots"},
      {{"--map", "a", "--bots-alone", "sleep"}, "--bots-alone"},
      {{"--map", "a", "--bots-skill", "unfair"}, "--bots-skill"},
      {{"--map", "a", "--ticks", "0"}, "--ticks"},
      {{"--map", "a", "--seed", "1.5"}, "--seed"},
      {{"--map", "a", "--step-threads", "0"}, "--step-threads"},
      {{"--map", "a", "--step-threads", "65"}, "--step-threads"},
      {{"--map", "a", "--log-format", "xml"}, "--log-format"},
      {{"--map", "a", "--listen", "host:seven"}, "--listen"},
      {{"--map", "a", "--web", "::1:80"}, "--web"},
      {{"--map", "a", "--web-host", "a.org"}, "--web-host"},
      {{"--map", "a", "--tls-cert", "c.pem", "--tls-key", "k.pem"}, "--tls-cert"},
      {{"--map", "a", "--web", ":1", "--tls-cert", "c.pem"}, "--tls-cert"},
      {{"--map", "a", "--web", ":1", "--tls-key", "k.pem"}, "--tls-key"},
      {{"--map", "a", "--web", ":1", "--web-host", "a:80"}, "--web-host a:80"},
      {{"--map", "a", "--web", ":1", "--web-origin", "null"}, "--web-origin null"},
      {{"--map", "a", "--record", "%Q"}, "--record"},
      {{"--map", "a", "--record-every", "1h"}, "--record-every"},
      {{"--map", "a", "--record-keep", "1G"}, "--record-keep"},
      {{"--map", "a", "--record", "r", "--record-every", "9s"}, "--record-every"},
      {{"--map", "a", "--record", "r", "--record-keep", "much"}, "--record-keep"},
      {{"--map", "a", "--frobnicate"}, "--frobnicate"},
      {{"--map", "a", "--config", "/no/such/file.json"}, "/no/such/file.json"},
  }));
  const auto config = parse(arguments);
  REQUIRE_FALSE(config);
  CHECK_THAT(config.error().text(), Catch::Contains(names));
}

TEST_CASE("a web port is opened only for who asks for one") {
  CHECK_FALSE(serve({"--map", "a"}).web);
  CHECK(serve({"--map", "a", "--web", "localhost"}).web->listen == ListenAddress{"localhost", 7778});
  CHECK(serve({"fork", "game.ndjson", "--tick", "6", "--web", ":0"}).web->listen ==
        ListenAddress{"0.0.0.0", 0});
  const WebNames names = serve({"--map", "a", "--web", ":1", "--web-host", "A.org", "--web-host", "b.org",
                                "--web-origin", "https://c.org"})
                             .web->names;
  CHECK(names.hosts == std::vector<std::string>{"a.org", "b.org"});
  CHECK(names.origins == std::vector<Origin>{{true, "c.org", 443}});
}

TEST_CASE("recordings may be cut and bounded") {
  const ServeConfig config =
      serve({"--map", "a", "--record", "r", "--record-every", "90m", "--record-keep", "10G"});
  REQUIRE(config.record);
  CHECK(config.record->every == std::chrono::minutes(90));
  CHECK(config.record->keep_bytes == std::uint64_t{10} << 30);
}

TEST_CASE("a server opens as many rooms as it says, and no more") {
  std::vector<const char*> arguments;
  for (std::size_t i = 0; i < kMaxRooms; ++i) arguments.insert(arguments.end(), {"--map", "a"});
  CHECK(parse(arguments));
  arguments.insert(arguments.end(), {"--map", "a"});
  const auto config = parse(arguments);
  REQUIRE_FALSE(config);
  CHECK_THAT(config.error().text(), Catch::Contains("1025 maps") && Catch::Contains("at most 1024"));
}

TEST_CASE("a frame rate that divides no tick rate is answered with those nearest that do") {
  const auto [tick_hz, state_hz, nearest] = GENERATE(table<const char*, const char*, std::string>(
      {{"120", "50", "take 40 or 60"}, {"60", "25", "take 20 or 30"}, {"60", "120", "take 60"}}));
  const auto config = parse({"--map", "a", "--tick-hz", tick_hz, "--state-hz", state_hz});
  REQUIRE_FALSE(config);
  CHECK_THAT(config.error().hint, Catch::EndsWith(nearest));
}

TEST_CASE("a wrong config file is refused by its key or place") {
  const auto [text, names] = GENERATE(table<std::string, std::string>({
      {R"({"bots": 3, "botts": 4})", "botts"},
      {R"({"bots": {"a": 1}})", "bots"},
      {R"({"bots": "many"})", "bots"},
      {R"({"config": "x.json"})", "config"},
      {R"([1, 2])", "object"},
      {R"({"map": [[[[[[[[[[1]]]]]]]]]]})", "nested more than 3 deep"},
      {R"({"map": )" + std::string(400000, '[') + std::string(400000, ']') + "}", "nested more than 3 deep"},
      {R"({"bots": )", ":1"},
      {R"({"ticks": 5, "ticks": 600000})", "ticks"},
      {R"({"tick-hz": 60, "tick_hz": 30})", "tick_hz: stands twice"},
  }));
  const File file(text);
  const auto config = parse({"--map", "a", "--config", file.path()});
  REQUIRE_FALSE(config);
  CHECK_THAT(config.error().text(), Catch::Contains(names));
}

TEST_CASE("a fork takes a server's options but what its recording decides") {
  const ServeConfig config =
      serve({"fork", "game.ndjson", "--tick", "600", "--listen", ":0", "--bots", "2", "--record",
             "other.ndjson", "--shadow", "--ticks", "7", "--state-hz", "25"});
  REQUIRE(config.fork);
  CHECK(config.fork->recording == "game.ndjson");
  CHECK(config.fork->tick == 600);
  CHECK(config.bots == 2);
  CHECK(config.record->pattern.file("x", 0) == "other.ndjson");
  CHECK(config.shadow);
  CHECK(config.ticks == 7u);
  CHECK(config.state_hz == 25);
  CHECK(config.maps.empty());
  CHECK_THAT(std::get<PrintConfig>(*parse({"fork", "--help"})).text,
             Catch::Contains("--shadow") && Catch::Contains("fork game.ndjson --tick"));
  for (const char* option : {"--map", "--tick-hz", "--seed"})
    CHECK_FALSE(parse({"fork", "game.ndjson", "--tick", "600", option, "60"}));
  CHECK(parse({"fork", "game.ndjson"}).error().hint == "see woodlouse-server fork --help");
  CHECK(parse({"--forks"}).error().hint == "see woodlouse-server --help");
}

TEST_CASE("a shadow is asked for by flag, variable or file") {
  CHECK_FALSE(serve({"--map", "a.json"}).shadow);
  CHECK(serve({"--map", "a.json", "--shadow"}).shadow);
  const File file(R"({"map": "f.json", "shadow": true})");
  CHECK(serve({"--config", file.path()}).shadow);
  const Variable variable("WOODLOUSE_SHADOW", "true");
  CHECK(serve({"--map", "a.json"}).shadow);
}

TEST_CASE("check and verify take their files, help and version are texts") {
  CHECK(std::get<CheckConfig>(*parse({"check", "a.json", "b.json"})).maps.size() == 2);
  const auto verify =
      std::get<VerifyConfig>(*parse({"verify", "game.ndjson", "other.ndjson.zst", "--jobs", "4"}));
  CHECK(verify.request.files == std::vector<std::filesystem::path>{"game.ndjson", "other.ndjson.zst"});
  CHECK(verify.request.jobs == 4);
  const auto inspect = std::get<InspectConfig>(*parse({"inspect", "game.ndjson", "--at", "41.7"}));
  CHECK(inspect.request.file == "game.ndjson");
  CHECK(inspect.request.seconds == 41.7);
  CHECK_FALSE(inspect.request.tick);
  CHECK_FALSE(inspect.request.error);
  CHECK(std::get<InspectConfig>(*parse({"inspect", "game.ndjson", "--error"})).request.error);
  CHECK_THAT(std::get<PrintConfig>(*parse({"--help"})).text, Catch::Contains("--state-hz"));
  CHECK_THAT(std::get<PrintConfig>(*parse({"--version"})).text, Catch::Contains("woodlouse-server"));
  CHECK_FALSE(parse({"verify"}));
}
