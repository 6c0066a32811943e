// Joins the server HOST PORT and says who it is there.
#include <iostream>

#include "bots/cpp/line_client.h"

int main(int count, char** argv) {
  if (count != 3) return 2;
  woodlouse::bots::LineClient client;
  woodlouse::protocol::Join join;
  join.name = "stranger";
  const auto welcome = client.join(argv[1], argv[2], join);
  if (!welcome) {
    std::cerr << welcome.error().text() << '\n';
    return 1;
  }
  std::cout << "louse " << welcome->id << " on " << welcome->map_name << '\n';
  return 0;
}
