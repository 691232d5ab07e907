// The command as it was given, for a result's provenance.
#pragma once

#include <string>

namespace vegard::apps {

/// The program's name without its folder and the arguments as given, quoted where a shell would need it.
std::string command_line(int argc, const char* const* argv);

}  // namespace vegard::apps
