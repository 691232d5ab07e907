#include "sim/base/file/output_error.h"

#include <cerrno>
#include <system_error>

namespace vegard::sim {
namespace {

std::string hint_for(int error_number) {
  switch (error_number) {
    case ENOENT:
    case ENOTDIR:
      return "does its folder exist?";
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
      return "nothing was left behind; make room or choose another disk";
    case EACCES:
    case EPERM:
    case EROFS:
      return "choose a folder that you may write to";
    default:
      return {};
  }
}

}  // namespace

Error unwritable(const std::string& target, int error_number) {
  ErrorDetails details;
  details.file = target;
  details.problem = "cannot be written: " + std::generic_category().message(error_number);
  details.hint = hint_for(error_number);
  return Error(ErrorKind::unwritable_output, details);
}

Error already_exists(const std::string& target) {
  ErrorDetails details;
  details.file = target;
  details.problem = "exists already";
  details.hint = "use --overwrite to replace it, or choose another name";
  return Error(ErrorKind::existing_output, details);
}

}  // namespace vegard::sim
