// Of which fit the fuzzed journals are: the seeds are of it, and the target asks for it.
#pragma once

#include "fit/search/file_journal.h"

namespace vegard::tests {

inline fit::JournalSubject fuzzed_subject() {
  return {{"the version of vegard", "1"}, {"the scene", "5e2f"}, {"the photograph", "0a91"}};
}

}  // namespace vegard::tests
