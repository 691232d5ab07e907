// The folder of a survey's shards: which number of them it is cut into.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace vegard::apps {

/// A shard's file in a folder.
struct ShardFile {
  std::string path;
  int shard = 0, shards = 0;  ///< the first from 1
};

/// In the order of their names; other files are no concern. Empty for a folder that is not there.
std::vector<ShardFile> shard_files(const std::string& folder);

/// "3/120" as 3 and 120. Throws Error(usage) for anything else.
std::pair<int, int> shard_words(const std::string& words);

/// Makes the folder if it is not there. Throws Error(existing_output) if the shards in it are another number,
/// and Error(unwritable_output).
void begin_shard_folder(const std::string& folder, int shards);

/// Frames that a shard's database has. Throws as SurveyReader does.
int frames_in(const std::string& database);

}  // namespace vegard::apps
