// The folder of a survey's shards, i.e. of the parts into which the survey is divided.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace vegard::apps {

/// A shard's file in a folder.
struct ShardFile {
  std::string path;
  int shard = 0, shards = 0;  ///< number of this shard, from 1, and number of all shards
};

/// The shards in the folder, sorted by name; other files are ignored. Empty if the folder does not exist.
std::vector<ShardFile> shard_files(const std::string& folder);

/// Parses "3/120" to 3 and 120. Throws Error(usage) for anything else.
std::pair<int, int> shard_words(const std::string& words);

/// Makes the folder if it does not exist. Throws Error(existing_output) if it holds shards of a survey with
/// another number of shards, and Error(unwritable_output).
void begin_shard_folder(const std::string& folder, int shards);

/// Number of frames in a shard's database. Throws as SurveyReader does.
int frames_in(const std::string& database);

}  // namespace vegard::apps
