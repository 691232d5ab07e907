#include "sim/base/memory_limit.h"

#include <sys/resource.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>

#include "sim/base/error.h"

namespace vegard::sim {
namespace {

/// The number behind a word at a line's beginning; of an empty word the file's first.
std::optional<std::uint64_t> number_behind(const std::string& file, const std::string& word) {
  std::ifstream stream(file);
  std::string line;
  while (std::getline(stream, line)) {
    if (line.compare(0, word.size(), word) != 0) continue;
    std::istringstream rest(line.substr(word.size()));
    std::uint64_t number = 0;
    if (rest >> number) return number;
    return {};  // "max"
  }
  return {};
}

struct GroupFiles {
  const char *limit, *used, *cache;
};

/// Returns the memory that a control group and those above it have left. Pages of files are not counted as
/// used, because they can be dropped.
std::uint64_t left_in_groups(const std::string& mount, std::string group, const GroupFiles& files) {
  std::uint64_t left = std::numeric_limits<std::uint64_t>::max();
  while (true) {
    const std::string folder = mount + group + "/";
    const auto limit = number_behind(folder + files.limit, "");
    if (limit) {
      const std::uint64_t used = number_behind(folder + files.used, "").value_or(0);
      const std::uint64_t cache = number_behind(folder + "memory.stat", files.cache).value_or(0);
      const std::uint64_t held = used - std::min(used, cache);
      left = std::min(left, *limit - std::min(*limit, held));
    }
    if (group.empty() || group == "/") return left;
    group.resize(group.rfind('/'));
  }
}

}  // namespace

double usable_memory_bytes() {
  const std::uint64_t available = available_memory();
  return available == 0 ? std::numeric_limits<double>::infinity() : 0.8 * static_cast<double>(available);
}

void require_memory(const MemoryLimit& limit, double bytes, const std::string& what,
                    const std::string& hint) {
  if (bytes <= limit.bytes) return;
  throw Error(ErrorKind::usage, what + " would take about " + memory_text(bytes) + " of memory")
      .key(limit.option)
      .expected("at most " + memory_text(limit.bytes) +
                (limit.given ? ", as given" : ", four fifths of what is free"))
      .hint(hint);
}

std::uint64_t available_memory(const std::string& root) {
  constexpr std::uint64_t kUnknown = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t left = kUnknown;
  if (const auto kilobytes = number_behind(root + "/proc/meminfo", "MemAvailable:")) left = *kilobytes * 1024;
  std::ifstream groups(root + "/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    // "0::/user.slice" of version 2, "5:memory:/docker/1f" of version 1.
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controllers = "," + line.substr(first + 1, second - first - 1) + ",";
    const std::string group = line.substr(second + 1);
    if (controllers == ",,")
      left = std::min(left, left_in_groups(root + "/sys/fs/cgroup", group,
                                           {"memory.max", "memory.current", "inactive_file "}));
    else if (controllers.find(",memory,") != std::string::npos)
      left = std::min(
          left, left_in_groups(root + "/sys/fs/cgroup/memory", group,
                               {"memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file "}));
  }
  rlimit limit{};
  if (root.empty() && getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) {
    const std::uint64_t used = number_behind("/proc/self/status", "VmSize:").value_or(0) * 1024;
    left = std::min<std::uint64_t>(left, limit.rlim_cur - std::min<std::uint64_t>(limit.rlim_cur, used));
  }
  return left == kUnknown ? 0 : left;
}

std::string memory_text(double bytes) {
  char text[32];
  constexpr double kMega = 1024.0 * 1024.0, kGiga = 1024.0 * kMega;
  if (bytes >= 999.5 * kMega)
    std::snprintf(text, sizeof text, bytes < 999.5 * kGiga ? "%.3g GB" : "%.0f GB", bytes / kGiga);
  else
    std::snprintf(text, sizeof text, "%.3g MB", bytes / kMega);
  return text;
}

}  // namespace vegard::sim
