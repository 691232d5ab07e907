#include "sim/scene/rows/complaint.h"

#include "sim/base/error.h"

namespace vegard::sim {

std::string in_line(int line) { return line > 0 ? " in line " + std::to_string(line) : ""; }

void complain(const Complaint& complaint, const Origin& origin) {
  throw Error(ErrorKind::scene, complaint.problem)
      .file(origin.file)
      .line(origin.line)
      .key(origin.key)
      .expected(complaint.expected)
      .hint(complaint.hint);
}

}  // namespace vegard::sim
