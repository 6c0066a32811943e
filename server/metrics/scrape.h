// The series of one look at the server, as text.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "server/metrics/families.h"
#include "server/timing/figures.h"

namespace woodlouse::server {

class Scrape {
 public:
  Scrape();
  Scrape(const Scrape&) = delete;
  Scrape& operator=(const Scrape&) = delete;
  ~Scrape();

  // REQUIRES as many values as the family has labels, each of any text: what is no UTF-8 of one line is shown
  // as core::printable() does.
  void add(Family family, double value, std::string_view first = {}, std::string_view second = {},
           std::string_view third = {});
  void add(Family family, std::uint64_t value, std::string_view first = {}, std::string_view second = {}) {
    add(family, static_cast<double>(value), first, second);
  }
  void add(Family family, const DurationHistogram& durations, std::string_view label);

  /// In Prometheus's text format, version 0.0.4. A family without a series is left out.
  [[nodiscard]] std::string text() const;

 private:
  struct Families;
  std::unique_ptr<Families> families_;
};

}  // namespace woodlouse::server
