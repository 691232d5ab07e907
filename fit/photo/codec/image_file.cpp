#include "fit/photo/codec/image_file.h"

#include "sim/base/error.h"

namespace vegard::fit {

void throw_unsupported(const std::string& file, const std::string& kind) {
  throw sim::unreadable(file, kind + " is not read")
      .expected("8 or 16 bits, or a TIFF of 32-bit floats, grey or RGB")
      .hint("save it again as a plain PNG or TIFF");
}

}  // namespace vegard::fit
