// Merges the databases of many shards into one.
#pragma once

#include <string>
#include <vector>

namespace vegard::fit {

struct SurveyMerge {
  int databases = 0;
  int plans = 0, versions = 0;
  int frames = 0;   ///< in the merged database
  int lacking = 0;  ///< frames of its plans that are not in it
};

/// Writes `output`, completely or not at all. Its bytes depend only on the answers in the databases, not on
/// the databases' number or order, nor on the division of the work into shards; databases may be results of
/// earlier merges. If several databases have the same block, the one with most frames of it is used. Memory
/// is needed for one row, and some numbers per block.
///
/// Different plans or versions are refused unless `mixed` is set. Then frames and blocks are numbered
/// consecutively, with the plans ordered by name and hash, and if several versions have the same block, that
/// of the newest is used. Throws sim::Error: (usage) for different plans or versions, and if there are no
/// databases; (unreadable_input) for a file that is not a survey's database, and for two with different
/// answers for the same frame, plan and version; and as WholeFile does.
SurveyMerge merge_surveys(const std::vector<std::string>& databases, const std::string& output, bool mixed,
                          bool overwrite);

}  // namespace vegard::fit
