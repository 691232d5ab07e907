#include "sim/scene/rows/complaint.h"

#include "sim/base/error.h"

namespace vegard::sim {

std::string in_line(int line) { return line > 0 ? " in line " + std::to_string(line) : ""; }

void complain(const Complaint& complaint, const Origin& origin) {
  ErrorDetails details;
  details.problem = complaint.problem;
  details.file = origin.file;
  details.line = origin.line;
  details.key = origin.key;
  details.expected = complaint.expected;
  details.hint = complaint.hint;
  throw Error(ErrorKind::scene, details);
}

}  // namespace vegard::sim
