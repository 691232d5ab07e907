#include "tests/support/source_folder.h"

namespace vegard::tests {

std::string source_folder() { return VEGARD_SOURCE_DIR; }

}  // namespace vegard::tests
