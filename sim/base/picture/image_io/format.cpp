#include <algorithm>
#include <cctype>
#include <filesystem>

#include "sim/base/picture/image_io.h"
#include "sim/base/picture/image_io/library.h"

namespace vegard::sim {

ImageFormat image_format(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".exr") return ImageFormat::exr;
  if (extension == ".png") return ImageFormat::png;
  if (extension == ".tif" || extension == ".tiff") return ImageFormat::tiff;
  if (extension == ".jpg" || extension == ".jpeg") return ImageFormat::jpeg;
  throw failure(ErrorKind::usage, path, "unknown image format '" + extension + "'",
                ".exr, .png, .tif or .jpg");
}

}  // namespace vegard::sim
