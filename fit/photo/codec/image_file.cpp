#include "fit/photo/codec/image_file.h"

#include "sim/base/error.h"

namespace vegard::fit {

void throw_truncated(const std::string& file, const std::string& what_is_missing) {
  refuse_image(file, "the file is truncated: " + what_is_missing, "", "copy it again from where it came");
}

void throw_damaged(const std::string& file, const std::string& problem) {
  refuse_image(file, "the file is damaged: " + problem, "", "copy it again from where it came");
}

void throw_unsupported(const std::string& file, const std::string& kind) {
  refuse_image(file, kind + " is not read", "8 or 16 bits, or a TIFF of 32-bit floats, grey or RGB",
               "save it again as a plain PNG or TIFF");
}

void refuse_image(const std::string& file, const std::string& problem, const std::string& expected,
                  const std::string& hint) {
  throw sim::Error(sim::ErrorKind::unreadable_input, problem).file(file).expected(expected).hint(hint);
}

}  // namespace vegard::fit
