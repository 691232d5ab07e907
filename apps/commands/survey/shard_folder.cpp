#include "apps/commands/survey/shard_folder.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <numeric>
#include <system_error>

#include "apps/options/refusals.h"
#include "fit/survey/survey_results.h"
#include "fit/survey/survey_run.h"
#include "sim/base/error.h"

namespace vegard::apps {
namespace {

namespace fs = std::filesystem;

/// The whole number at the beginning of the text, which is cut off; 0 if there is none.
int take_number(std::string_view& text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc()) return 0;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return number;
}

bool take_word(std::string_view& text, std::string_view word) {
  if (text.substr(0, word.size()) != word) return false;
  text.remove_prefix(word.size());
  return true;
}

}  // namespace

std::vector<ShardFile> shard_files(const std::string& folder) {
  std::vector<ShardFile> found;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    std::string_view rest = name;
    if (!take_word(rest, "shard-")) continue;
    const int shard = take_number(rest);
    if (!take_word(rest, "-of-")) continue;
    const int shards = take_number(rest);
    if (shard >= 1 && shard <= shards && name == fit::shard_name(shard, shards))
      found.push_back({entry->path().string(), shard, shards});
  }
  std::sort(found.begin(), found.end(),
            [](const ShardFile& a, const ShardFile& b) { return a.path < b.path; });
  return found;
}

std::pair<int, int> shard_words(const std::string& words) {
  std::string_view rest = words;
  const int shard = take_number(rest);
  const bool has_slash = take_word(rest, "/");
  const int shards = take_number(rest);
  if (!has_slash || !rest.empty() || shard < 1 || shard > shards)
    throw usage_error("--shard", "'" + words + "' is no shard", "I/N, as in 3/120: the third of 120");
  return {shard, shards};
}

void begin_shard_folder(const std::string& folder, int shards) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw sim::unwritable(folder, error.value());
  for (const ShardFile& file : shard_files(folder))
    if (file.shards != shards)
      throw sim::Error(sim::ErrorKind::existing_output,
                       "has shards of a survey that is cut into " + std::to_string(file.shards))
          .file(folder)
          .hint("go on with this number, or choose another folder");
}

int frames_in(const std::string& database) {
  const fit::SqliteFile file(database, fit::SqliteFile::Opening::read);
  const std::vector<int> counts = fit::count_by_status(file);
  return std::accumulate(counts.begin(), counts.end(), 0);
}

}  // namespace vegard::apps
