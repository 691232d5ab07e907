// Tables for scripts/learn_kinds.py and learn_sky_kind.py: features of skies and what is true of them, of
// made skies or of pictures that were marked by eye; and how many kinds of marked pictures are found.
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/options/command.h"
#include "fit/sky_kind/sky_kind.h"
#include "tests/recovery/made_night/random_sky.h"

namespace vegard::made_night {
namespace {

const std::vector<std::string> kQuestions = {"arc",    "twilight", "cloud", "moon",     "lamp",
                                             "aurora", "several",  "rayed", "overhead", "black"};

struct Options {
  int random = 0;
  std::uint64_t seed = 21;
  std::string marks, photos, out, pictures;
};

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::stringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  if (!line.empty() && line.back() == ',') cells.emplace_back();
  return cells;
}

std::string head() {
  std::string text = "file,camera,kinds";
  for (const std::string& question : kQuestions) text += "," + question;
  for (const fit::SkyFeatureWords& words : fit::sky_feature_words()) text += std::string(",") + words.name;
  return text + ",found,probability,probability of aurora\n";
}

std::string found_text(const fit::SkyFinding& found) {
  std::string text;
  for (const double value : found.features) text += std::isnan(value) ? "," : fmt::format(",{:.9g}", value);
  return text +
         fmt::format(",{},{:.4f},{:.4f}\n", fit::sky_kind_name(found.kind), found.probability, found.aurora);
}

std::string made_rows(const Options& options) {
  std::string text;
  for (int i = 0; i < options.random; ++i) {
    const RandomSky sky = random_sky(options.seed, static_cast<std::uint32_t>(i));
    const std::string name = fmt::format("{}_{:05d}.jpg", options.seed, i);
    if (!options.pictures.empty())
      std::ofstream(std::filesystem::path(options.pictures) / name, std::ios::binary) << sky.jpeg;
    const fit::Photo photo = fit::read_photo_bytes(sky.jpeg, name, fit::Decoding{});
    const RandomSkyTruth& t = sky.truth;
    text += fmt::format("{},,,{:d},{:d},{:d},{:d},{:d},{:d},{:d},{:d},{:d},{:d}", name, t.arc, t.twilight,
                        t.cloud, t.moon, t.lamp, t.aurora, t.several, t.rayed, t.overhead, t.black);
    text += found_text(fit::kind_of_sky(photo, fit::not_sky(photo)));
  }
  return text;
}

std::string marked_rows(const Options& options) {
  std::ifstream marks(options.marks);
  if (!marks) throw std::runtime_error(options.marks + " cannot be read");
  std::string text;
  std::vector<std::string> names;
  for (std::string line; std::getline(marks, line);) {
    if (line.empty() || line[0] == '#') continue;
    const std::vector<std::string> cells = cells_of(line);
    if (names.empty()) {
      names = cells;
      continue;
    }
    std::map<std::string, std::string> row;
    for (std::size_t i = 0; i < names.size() && i < cells.size(); ++i) row[names[i]] = cells[i];
    const std::string file = (std::filesystem::path(options.photos) / row["file"]).string();
    const fit::Photo photo = fit::read_photo(file, fit::Decoding{});
    text += row["file"] + "," + row["camera"] + "," + row["kinds"];
    for (const std::string& question : kQuestions) text += "," + row[question];
    text += found_text(fit::kind_of_sky(photo, fit::not_sky(photo)));
  }
  return text;
}

int run(int argc, char** argv) {
  Options options;
  apps::Program program("sky_table", "Features of skies, and what is true of them", {}, argc, argv);
  const apps::Command app = program.root();
  app.option("--random", options.random, "Number of made skies").range(0, 1000000);
  app.option("--seed", options.seed, "Of the made skies").shows_default();
  app.option("--pictures", options.pictures, "Folder in which to put the made skies");
  app.option("--marks", options.marks, "CSV of pictures that were marked by eye");
  app.option("--photos", options.photos, "Folder of these pictures");
  app.option("-o,--out", options.out, "CSV to write").required();
  if (const std::optional<int> end = program.read()) return *end;
  std::ofstream(options.out) << head() << made_rows(options)
                             << (options.marks.empty() ? std::string() : marked_rows(options));
  return 0;
}

}  // namespace
}  // namespace vegard::made_night

int main(int argc, char** argv) {
  try {
    return vegard::made_night::run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "sky_table: %s\n", error.what());
    return 1;
  }
}
