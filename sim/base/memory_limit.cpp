#include "sim/base/memory_limit.h"

#include <cstdint>
#include <limits>

#include "sim/base/available_memory.h"
#include "sim/base/error.h"

namespace vegard::sim {

double usable_memory_bytes() {
  const std::uint64_t available = available_memory();
  return available == 0 ? std::numeric_limits<double>::infinity() : 0.8 * static_cast<double>(available);
}

void require_memory(const MemoryLimit& limit, double bytes, const std::string& what,
                    const std::string& hint) {
  if (bytes <= limit.bytes) return;
  refuse_key(
      ErrorKind::usage, limit.option, what + " would take about " + memory_text(bytes) + " of memory",
      "at most " + memory_text(limit.bytes) + (limit.given ? ", as given" : ", four fifths of what is free"),
      hint);
}

}  // namespace vegard::sim
