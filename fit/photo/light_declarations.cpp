#include "fit/photo/light_declarations.h"

#include "fit/photo/codec/declaration_reader.h"
#include "fit/photo/codec/picture_format.h"
#include "fit/photo/frames/frame_file.h"
#include "fit/photo/frames/frame_name.h"
#include "fit/photo/frames/picture_bytes.h"
#include "sim/base/file/input_file.h"
#include "sim/base/text.h"

namespace vegard::fit {

std::vector<std::string> light_declarations(const std::string& name) {
  const FrameName wanted = frame_name(name);
  constexpr std::size_t kHeaders = std::size_t{1} << 22;  // before the pixels, profiles included
  std::string bytes;
  if (wanted.is_chosen() || is_frame_file(wanted.file)) {
    bytes = read_picture_bytes(name).bytes;
  } else {
    bytes = beginning_of_packed_fits(wanted.file);
    if (bytes.empty()) bytes = sim::read_beginning(wanted.file, kHeaders).bytes;
    const bool is_tiff = sim::starts_with(bytes, "II") || sim::starts_with(bytes, "MM");
    if (is_tiff && bytes.size() == kHeaders)
      bytes = sim::input_bytes(wanted.file, "a picture", sim::kMaxPictureBytes);
  }
  if (is_camera_raw(bytes)) return {};
  const DeclaredLight light = declared_light(bytes);
  std::vector<std::string> words = light.words;
  if (!light.problem.empty()) words.push_back(light.source + " cannot be applied: " + light.problem);
  return words;
}

}  // namespace vegard::fit
