#include "fit/photo/codec/image_file.h"

#include "sim/base/error.h"

namespace vegard::fit {

const char* format_name(ImageFormat format) {
  switch (format) {
    case ImageFormat::jpeg:
      return "JPEG";
    case ImageFormat::png:
      return "PNG";
    case ImageFormat::tiff:
      return "TIFF";
    case ImageFormat::pgm:
      return "PGM";
    case ImageFormat::ppm:
      return "PPM";
    case ImageFormat::exr:
      return "EXR";
    case ImageFormat::fits:
      return "FITS";
    case ImageFormat::raw:
      return "camera raw";
    case ImageFormat::heif:
      return "HEIC";
  }
  return "";
}

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
  sim::ErrorDetails details;
  details.file = file;
  details.problem = problem;
  details.expected = expected;
  details.hint = hint;
  throw sim::Error(sim::ErrorKind::unreadable_input, details);
}

}  // namespace vegard::fit
