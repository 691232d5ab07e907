// The databases of many shards as one.
#pragma once

#include <string>
#include <vector>

namespace vegard::fit {

struct SurveyMerge {
  int databases = 0;
  int plans = 0, versions = 0;
  int frames = 0;   ///< that the merged database has
  int lacking = 0;  ///< of all frames of its plans
};

/// Writes `output`, whole or not at all. What it holds, to the last byte, depends on what the databases have,
/// not on their number or order, nor on how the work was cut into shards; databases that were merged before
/// do as well. Of a block that several have, the one with most frames is taken. One row at a time is held, of
/// the blocks some numbers.
///
/// Different plans or versions are refused unless `mixed`: then frames and blocks are numbered through, plan
/// after plan by name and hash, and of a block that several versions have, the newest's is taken. Throws
/// sim::Error: (usage) for that, and for no database at all; (unreadable_input) for what is none, and for two
/// that have different answers for the same frame, of the same plan and version; and as WholeFile does.
SurveyMerge merge_surveys(const std::vector<std::string>& databases, const std::string& output, bool mixed,
                          bool overwrite);

}  // namespace vegard::fit
