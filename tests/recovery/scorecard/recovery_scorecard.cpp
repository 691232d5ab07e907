// The recovery scorecard: scenes drawn at random, photographed, fitted from one wide start, and scored.
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <exception>
#include <fstream>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "apps/options/command.h"
#include "tests/recovery/scorecard/card.h"
#include "tests/recovery/scorecard/one_case.h"
#include "tests/recovery/scorecard/score.h"

namespace vegard::scorecard {
namespace {

struct Options {
  CaseOptions of_case;
  int first = 0, count = 12, jobs = 2;
  bool make_only = false, is_exact = false;
  std::string card;
  std::vector<std::string> to_sum_up;
};

/// Every row is in the file as soon as it is known; at the end they stand in order.
class CardFile {
 public:
  explicit CardFile(std::string file) : file_(std::move(file)) {
    if (!file_.empty()) stream_.open(file_);
    if (stream_.is_open()) stream_ << csv_header() << std::flush;
  }
  void add(const Row& row) {
    const std::scoped_lock lock(mutex_);
    rows_[row.scene] = row;
    if (stream_.is_open()) stream_ << csv_row(row) << std::flush;
    std::fprintf(stderr, "scene %d: %s, %s%s, %d evaluations, %.0f s\n", row.scene, row.verdict.c_str(),
                 row.recovered != 0 ? "recovered" : "missed ", row.missed.c_str(), row.evaluations,
                 row.seconds);
  }
  std::vector<Row> close() {
    std::vector<Row> rows;
    for (const auto& [number, row] : rows_) rows.push_back(row);
    if (stream_.is_open()) {
      stream_.close();
      stream_.open(file_);
      stream_ << csv_header();
      for (const Row& row : rows) stream_ << csv_row(row);
      stream_.close();
    }
    return rows;
  }

 private:
  std::string file_;
  std::ofstream stream_;
  std::mutex mutex_;
  std::map<int, Row> rows_;
};

std::vector<Row> played(const Options& options) {
  CardFile card(options.card);
  std::atomic<int> next{options.first};
  const auto work = [&] {
    for (int scene = next++; scene < options.first + options.count; scene = next++) {
      if (options.make_only)
        make_case(scene, options.of_case);
      else
        card.add(run_case(scene, options.of_case));
    }
  };
  std::vector<std::thread> workers;
  for (int j = 0; j < options.jobs; ++j) workers.emplace_back(work);
  for (std::thread& worker : workers) worker.join();
  return card.close();
}

int run(int argc, char** argv) {
  Options options;
  apps::Program program("recovery_scorecard",
                        "Recovery scorecard: fits of scenes of which the truth is known", {}, argc, argv);
  const apps::Command app = program.root();
  app.option("--seed", options.of_case.set, "The set of scenes").shows_default();
  app.option("--tables", options.of_case.tables, "The emission tables of pictures and fits")
      .one_of({"vegard", "glow"})
      .shows_default();
  app.flag("--drawn-physics", options.of_case.drawn_physics,
           "Pictures have other light than the tables: a draw of their uncertainty's modes");
  app.flag("--lossless", options.of_case.is_lossless, "Photographs are PNG, without JPEG's errors");
  app.flag("--exact", options.is_exact, "Fits take their tables as exact");
  app.option("--first", options.first, "Number of the first scene").shows_default();
  app.option("--count", options.count, "How many scenes").shows_default();
  app.option("--jobs", options.jobs, "Scenes side by side, one thread each").range(1, 256).shows_default();
  app.option("--max-evaluations", options.of_case.max_evaluations, "Of a fit").shows_default();
  app.option("--keep", options.of_case.keep, "Folder for photographs, truths and starts");
  app.flag("--make-only", options.make_only, "Photographs only (with --keep)");
  app.flag("--from-truth", options.of_case.from_truth, "Start at the truth, without a search");
  app.flag("--free-ends", options.of_case.free_ends,
           "Sheets' lengths and places along themselves are free too");
  app.option("-o,--out", options.card, "The card, a CSV file");
  app.option("--summary", options.to_sum_up, "Print the tables of these cards, and do nothing else");
  if (const std::optional<int> end = program.read()) return *end;
  if (options.is_exact) options.of_case.uncertainty = sim::TablesUncertainty::none;

  std::vector<Row> rows;
  if (options.to_sum_up.empty()) {
    rows = played(options);
  } else {
    for (const std::string& file : options.to_sum_up)
      for (const Row& row : read_card(file)) rows.push_back(row);
  }
  if (!rows.empty()) std::printf("%s", summary(rows).c_str());
  return 0;
}

}  // namespace
}  // namespace vegard::scorecard

int main(int argc, char** argv) {
  try {
    return vegard::scorecard::run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "recovery_scorecard: %s\n", error.what());
    return 1;
  }
}
