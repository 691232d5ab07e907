#include <algorithm>

#include "fit/photo/codec/picture_codes.h"
#include "sim/base/picture/camera_raw.h"

namespace vegard::fit {

PictureCodes decode_camera_raw(std::string_view bytes, const std::string& file) {
  const sim::CodedPicture picture = sim::read_camera_raw(bytes, file);
  PictureCodes codes;
  codes.width = picture.width;
  codes.height = picture.height;
  codes.bits = 16;
  codes.white = 65535.0;
  codes.linear = true;
  codes.kind = "camera raw by " + picture.library + ", gains 1, 1, 1, bilinear";
  codes.values.assign(picture.codes.begin(), picture.codes.end());
  // A full site has had a part in its channel of the eight pixels around it.
  codes.usable.assign(codes.values.size(), 1);
  for (int y = 0; y < codes.height; ++y)
    for (int x = 0; x < codes.width; ++x)
      for (int c = 0; c < 3; ++c) {
        if (picture.codes[(static_cast<std::size_t>(y) * codes.width + x) * 3 + c] < 65535) continue;
        for (int v = std::max(0, y - 1); v <= std::min(codes.height - 1, y + 1); ++v)
          for (int u = std::max(0, x - 1); u <= std::min(codes.width - 1, x + 1); ++u)
            codes.usable[(static_cast<std::size_t>(v) * codes.width + u) * 3 + c] = 0;
      }
  return codes;
}

}  // namespace vegard::fit
