#include "server/admin/admin_address.h"

#include <catch2/catch.hpp>

#include <string>

#include "server/admin/admin_request.h"
#include "server/admin/admin_watch.h"

namespace woodlouse::server::admin_address_test {

namespace {

std::string where(const std::string& text) {
  const auto address = parse_admin_address(text, "--admin");
  if (!address) return "none";
  return (std::holds_alternative<ListenAddress>(*address) ? "port " : "socket ") + to_text(*address);
}

}  // namespace

TEST_CASE("what has a slash, or no colon, is a socket, and another text a port") {
  CHECK(where("/run/woodlouse/admin.sock") == "socket /run/woodlouse/admin.sock");
  CHECK(where("./a:b") == "socket ./a:b");
  CHECK(where("admin.sock") == "socket admin.sock");
  CHECK(where("127.0.0.1:7779") == "port 127.0.0.1:7779");
  CHECK(where("[::1]:0") == "port [::1]:0");
  CHECK(where("") == "none");
  CHECK(where("/run/") == "none");
  CHECK(where("a:b") == "none");
  CHECK(where("/" + std::string(106, 'a')) == "socket /" + std::string(106, 'a'));
  CHECK(where("/" + std::string(107, 'a')) == "none");
}

TEST_CASE("a request's head is read, and what is none refused") {
  const auto request =
      read_request("GET /metrics?a=b HTTP/1.1\r\nHost: x\r\nAuthorization: Bearer correct-horse\r\n\r\n");
  REQUIRE(request);
  CHECK(request->path == "/metrics");
  CHECK(request->token == "correct-horse");
  CHECK_FALSE(request->is_head);
  CHECK(read_request("HEAD / HTTP/1.0\r\n\r\n")->is_head);
  CHECK(read_request("GET / HTTP/1.1\r\nAuthorization: Basic eA==\r\n\r\n")->token.empty());
  CHECK(read_request("POST / HTTP/1.1\r\n\r\n").error().status == 405);
  CHECK(read_request("GET / HTTP/1.1\r\nContent-Length: 5\r\n\r\n").error().status == 413);
  CHECK(read_request("GET / HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\n").error().status == 413);
  CHECK(read_request("GET /\r\n\r\n").error().status == 400);
  CHECK(read_request("NONSENSE\r\n\r\n").error().status == 400);
}

TEST_CASE("the answer to a request is whole, and without a body where its head alone was asked for") {
  const std::string whole = response_text({200, "text/plain", "ok\n"}, false);
  CHECK(whole.starts_with("HTTP/1.1 200 OK\r\n"));
  CHECK(whole.find("\r\nContent-Length: 3\r\n") != std::string::npos);
  CHECK(whole.ends_with("\r\n\r\nok\n"));
  const std::string head = response_text({200, "text/plain", "ok\n"}, true);
  CHECK(head.find("\r\nContent-Length: 3\r\n") != std::string::npos);
  CHECK(head.ends_with("\r\n\r\n"));
}

TEST_CASE("wrong tokens are limited, then none is looked at, and later one may try again") {
  using Verdict = AdminWatch::Verdict;
  Time now{};
  AdminWatch watch(Secret("correct-horse"), now);
  CHECK(watch.judge("correct-horse", now) == Verdict::kPass);
  for (int k = 0; k < 5; ++k) CHECK(watch.judge("guess", now) == Verdict::kWrong);
  CHECK(watch.judge("guess", now) == Verdict::kLimited);
  CHECK(watch.judge("correct-horse", now) == Verdict::kLimited);
  now += std::chrono::seconds(9);
  CHECK(watch.judge("correct-horse", now) == Verdict::kLimited);
  now += std::chrono::seconds(2);
  CHECK(watch.judge("correct-horse", now) == Verdict::kPass);
  CHECK(watch.judge("guess", now) == Verdict::kWrong);
  CHECK(watch.judge("correct-horse", now) == Verdict::kLimited);
  CHECK(AdminWatch(std::nullopt, now).judge("", now) == Verdict::kPass);
}

}  // namespace woodlouse::server::admin_address_test
