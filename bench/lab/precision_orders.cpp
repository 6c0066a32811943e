#include "bench/lab/precision_orders.h"

#include <array>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include "bench/lab/problems/convergence.h"
#include "bench/lab/report/progress.h"
#include "bench/lab/report/side_by_side.h"

namespace woodlouse::lab {
namespace {

using state::Method;

constexpr std::array kRoomMethods = {Method::kStandard, Method::kPrecise, Method::kCheap};

void add_row(Table& table, const Event& event, Method method, const char* error, const Errors& errors,
             const Errors& sub_steps, double uncertainty) {
  std::vector<Table::Cell> row{event.name, event.ground, std::string(state::to_text(method)),
                               std::string(error)};
  row.insert(row.end(), errors.begin(), errors.end());
  row.emplace_back(order_of(errors, uncertainty));
  row.emplace_back(uncertainty);
  row.emplace_back(sub_steps[0]);
  row.emplace_back(sub_steps[2]);
  table.add(std::move(row));
}

}  // namespace

core::Expected<void> measure_orders(const Output& output) {
  const std::size_t starts = output.quick ? 5 : 99;
  const std::vector<Event> all = events();
  std::vector<std::string> header{"event", "ground", "method", "error"};
  for (const int rate : kConvergenceRates) header.push_back(std::to_string(rate) + "_hz");
  header.insert(header.end(), {"order", "uncertainty", "sub_steps_15", "sub_steps_60"});
  Table table(std::move(header));
  Progress progress("orders", all.size());
  std::vector<std::vector<Convergence>> found(all.size());  // by method; none: too few starts meet it
  side_by_side(
      all.size(),
      [&](std::size_t i) {
        const std::vector<ReferenceWay> ways = reference_ways(all[i], starts);
        if (ways.size() < starts) return;
        for (const Method method : kRoomMethods) found[i].push_back(convergence(all[i], method, ways));
      },
      [&] { progress.advance(); });
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Event& event = all[i];
    if (found[i].empty())
      return core::fail(event.name + " on " + event.ground, "too few starts meet it",
                        "see problems/events.cpp");
    for (std::size_t m = 0; m < found[i].size(); ++m) {
      const Convergence& c = found[i][m];
      const auto add = [&](const char* error, const Errors& errors, double uncertainty) {
        add_row(table, event, kRoomMethods[m], error, errors, c.sub_steps, uncertainty);
      };
      add("place, median", c.position.median, c.position.median_uncertainty);
      add("place, worst", c.position.worst, c.position.worst_uncertainty);
      add("way, median", c.distance.median, c.distance.median_uncertainty);
      add("way, worst", c.distance.worst, c.distance.worst_uncertainty);
    }
  }
  std::cout << "Errors [m] of place and length of the way at the end, " << starts
            << " starts an event, against `precise` at " << kReferenceRate
            << " Hz;\norder: from 60 Hz on, of what stands above the reference's uncertainty (what halving "
               "its rate "
               "changes)\n";
  table.print(std::cout);
  return {};
}

}  // namespace woodlouse::lab
