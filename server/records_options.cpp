#include "server/records_options.h"

#include <CLI/CLI.hpp>

#include "server/option_checks.h"

namespace woodlouse::server {
namespace {

constexpr const char* kRecordsExamples =
    R"(A board proves each run that is on it, not who drove it: whoever has its file
re-runs it. Live boards of people and of bots are written by the server alone;
what is handed in has a board of its own.

Examples:
  woodlouse-server records list records/
  woodlouse-server records verify records/
  woodlouse-server records prune records/ --keep 20
  woodlouse-server records add records/ ghost.json --map volcano)";

constexpr std::uint64_t kMostKept = 100;

CLI::App* add_action(CLI::App& records, RecordsRequest& request, RecordsRequest::Action action,
                     const std::string& name, const std::string& what) {
  CLI::App* command = records.add_subcommand(name, what);
  command->add_option("folder", request.folder, "Folder of boards, as --records has it")->required();
  command->footer(std::string());
  command->final_callback([&request, action] { request.action = action; });
  return command;
}

}  // namespace

void add_records_option(CLI::App& app, std::optional<std::filesystem::path>& folder) {
  app.add_option(
         "--records", folder,
         "Keep records of races in this folder, a board a course; left out, none are kept: nothing is "
         "written that nobody asked for")
      ->envname("WOODLOUSE_RECORDS");
}

CLI::App* add_records_command(CLI::App& app, RecordsRequest& request) {
  using Action = RecordsRequest::Action;
  CLI::App* records =
      app.add_subcommand("records", "Show, re-run, shorten boards of races, or hand in a run");
  add_action(*records, request, Action::kList, "list", "What stands on the boards");
  CLI::App* verify = add_action(*records, request, Action::kVerify, "verify",
                                "Re-run every run and compare: gate by gate, to the moment");
  verify
      ->add_option("--maps", request.maps,
                   "Folder of the maps, for boards that only name theirs: it was too big for the file")
      ->check(CLI::ExistingDirectory);
  CLI::App* prune = add_action(*records, request, Action::kPrune, "prune",
                               "Keep the best of each board, and no older runs");
  prune->add_option("--keep", request.keep, "Rows of each board")
      ->required()
      ->check(whole_number(1, kMostKept));
  CLI::App* add =
      add_action(*records, request, Action::kAdd, "add",
                 "Re-run what is handed in and put it on its board; no server may use the folder");
  add->add_option("ghost", request.ghost, "A ghost, as get_ghost gives it")->required();
  add->add_option("--map", request.map,
                  "What it was driven on: a file, or the name of one that came with this")
      ->required();
  records->require_subcommand(1, 1);
  records->footer(kRecordsExamples);
  return records;
}

CLI::App* named_command(CLI::App* records) {
  for (CLI::App* command : records->get_subcommands({}))
    if (command->parsed()) return command;
  return records;
}

}  // namespace woodlouse::server
