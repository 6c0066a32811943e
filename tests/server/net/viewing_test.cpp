// A session that is shown a part of its room.
#include <catch2/catch.hpp>

#include <algorithm>
#include <string>

#include "server/frames/sheet_encoder.h"
#include "tests/server/frames/scene.h"
#include "tests/server/net/session_stage.h"

namespace woodlouse::server::viewing_test {
namespace {

const RowLayout kLayout{protocol::default_columns(), protocol::Format::kQuantized, true};

protocol::Welcome welcome(std::uint32_t louse) {
  protocol::Welcome welcome;
  welcome.id = louse;
  welcome.fields = protocol::default_columns();
  welcome.view_rows = protocol::kEveryRow;
  return welcome;
}

constexpr std::string_view kJoinLooking = R"({"type":"join","protocol":1,"name":"ann","view":{"rows":2}})"
                                          "\n";

/// Rows of the last frame.
std::size_t rows_of(const std::string& line) {
  const auto begin = line.find(R"("louse":[)") + 9;
  const auto rows = line.substr(begin, line.find(R"(],")", begin) - begin);
  return static_cast<std::size_t>(std::count(rows.begin(), rows.end(), '['));
}

}  // namespace

TEST_CASE("a view is asked for in the join, changed by a message, and kept for the room's next game") {
  Stage stage;
  stage.start();
  stage.send(kJoinLooking);
  REQUIRE(stage.volcano->joins.at(0).view == protocol::View{{}, {}, {}, 2u});
  stage.session->welcome(welcome(3), 1);
  test::Scenery scenery(4);
  SheetEncoder encoder(kLayout);
  stage.session->show_again(encoder.key(scenery.scene()));
  stage.run();
  CHECK(rows_of(stage.last_line()) == 2);
  CHECK(stage.last_line().find("[3,") != std::string::npos);
  stage.send("{\"type\":\"view\",\"louse\":9,\"rows\":5}\n");
  CHECK(stage.volcano->messages.empty());  // the room need not know
  ++scenery.tick;
  stage.session->show(encoder.key(scenery.scene()));
  stage.run();
  CHECK(rows_of(stage.last_line()) == 5);
  stage.session->welcome(welcome(8), 1);
  SheetEncoder next(kLayout);
  scenery.tick = 0;
  stage.session->show_again(next.key(scenery.scene()));
  stage.run();
  CHECK(rows_of(stage.last_line()) == 5);
  CHECK(stage.last_line().find("[8,") != std::string::npos);
}

TEST_CASE("a key that comes again for another view takes the delta that waits for the one before with it") {
  Stage stage;
  stage.start();
  stage.send(kJoinLooking);
  stage.session->welcome(welcome(3), 1);
  test::Scenery scenery(4);
  SheetEncoder encoder(kLayout);
  const Frame key = encoder.key(scenery.scene());
  stage.session->show_again(key);
  stage.run();
  stage.far->holds_writes = true;
  stage.send("{\"type\":\"ping\",\"t\":1}\n");  // its answer is on its way, and what follows waits
  scenery.change();
  const Frame delta = encoder.delta(scenery.scene());
  stage.session->show(delta);
  stage.run();
  stage.send("{\"type\":\"view\",\"rows\":20}\n");
  stage.session->show_again(key);
  stage.session->show_again(delta);
  stage.run();
  stage.far->let_go();
  stage.run();
  const auto lines = stage.lines();
  REQUIRE(lines.size() >= 2);
  CHECK(rows_of(lines[lines.size() - 2]) == 20);
  CHECK(lines.back().find(R"("type":"delta")") != std::string::npos);
  // Rows of those in view who are not as in the key, whoever was in view before.
  Viewer fresh({{}, {}, {}, 20u}, 3, protocol::kEveryRow);
  fresh.frame(key);
  CHECK(lines.back() == *fresh.frame(delta)->text);
}

TEST_CASE("the room is told when all becomes a part, and a part all, and of nothing between") {
  Stage stage;
  stage.start();
  stage.send("{\"type\":\"view\",\"radius\":3}\n");
  CHECK(stage.last_line().find("not_joined") != std::string::npos);
  stage.send(kJoin);
  stage.session->welcome(welcome(3), 1);
  for (const std::string view : {R"("radius":3)", R"("radius":4)", R"("rows":9)", "", ""})
    stage.send(R"({"type":"view")" + (view.empty() ? view : "," + view) + "}\n");
  REQUIRE(stage.volcano->messages.size() == 2);
  CHECK(std::get<protocol::Look>(stage.volcano->messages[0].first).view.radius == 3.0);
  CHECK(std::get<protocol::Look>(stage.volcano->messages[1].first).view.is_whole());
}

TEST_CASE("where the room shows everybody a part, a view may be asked for without one in the join") {
  Stage stage;
  stage.start_joined();
  protocol::Welcome capped = welcome(3);
  capped.view_rows = 4;
  stage.session->welcome(capped, 1);
  test::Scenery scenery(4);
  SheetEncoder encoder(kLayout);
  stage.session->show_again(encoder.key(scenery.scene()));
  stage.run();
  CHECK(rows_of(stage.last_line()) == 4);
  stage.send("{\"type\":\"view\",\"rows\":10}\n");
  ++scenery.tick;
  stage.session->show(encoder.key(scenery.scene()));
  stage.run();
  CHECK(rows_of(stage.last_line()) == 4);  // no more than the room allows
}

}  // namespace woodlouse::server::viewing_test
