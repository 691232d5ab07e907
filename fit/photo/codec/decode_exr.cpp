#include <algorithm>

#include "fit/photo/codec/picture_codes.h"
#include "sim/base/picture/image_io.h"

namespace vegard::fit {

PictureCodes decode_exr(std::string_view bytes, const std::string& file) {
  sim::ExrFile exr = sim::read_exr_bytes(bytes, file);
  const sim::Image& all = exr.image;
  const auto place = [&](const char* name) {
    const auto at = std::find(all.channel_names.begin(), all.channel_names.end(), name);
    return at == all.channel_names.end() ? -1 : static_cast<int>(at - all.channel_names.begin());
  };
  std::vector<int> from = {place("R"), place("G"), place("B")};
  if (*std::min_element(from.begin(), from.end()) < 0) {
    from = {place("Y")};
    if (from[0] < 0 && all.channels() == 1) from[0] = 0;
    if (from[0] < 0)
      refuse_image(file, "there is no picture in it", "the channels R, G and B, or Y, or only one channel");
  }
  PictureCodes codes;
  codes.width = all.width;
  codes.height = all.height;
  codes.channels = static_cast<int>(from.size());
  codes.white = 1.0;
  codes.step = 0.0;
  codes.bits = 32;
  codes.floating = codes.linear = true;
  codes.kind = "float EXR";
  codes.values.reserve(static_cast<std::size_t>(all.width) * all.height * from.size());
  for (int y = 0; y < all.height; ++y)
    for (int x = 0; x < all.width; ++x)
      for (const int channel : from) codes.values.push_back(all.at(x, y, channel));
  codes.words = std::move(exr.attributes);
  return codes;
}

}  // namespace vegard::fit
