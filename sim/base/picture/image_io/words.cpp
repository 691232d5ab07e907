#include "sim/base/picture/image_io/words.h"

namespace vegard::sim {

std::string exif_time(std::string time) {
  if (time.empty()) return unknown_time;
  if (time.size() >= 19 && time[4] == '-' && time[7] == '-' && (time[10] == 'T' || time[10] == ' ')) {
    time.resize(19);
    time[4] = time[7] = ':';
    time[10] = ' ';
  }
  return time;
}

std::string value_or_empty(const ImageAttributes& attributes, const std::string& key) {
  const auto found = attributes.find(key);
  return found == attributes.end() ? std::string() : found->second;
}

std::string description_of(const ImageAttributes& attributes) {
  std::string text = value_or_empty(attributes, "ImageDescription");
  for (const auto& [key, value] : attributes) {
    if (key == "DateTime" || key == "ImageDescription" || value.empty()) continue;
    if (!text.empty()) text += '\n';
    text += key;
    text += '=';
    text += value;
  }
  return text;
}

void describe_in_own_keys(OIIO::ImageSpec& spec, const ImageAttributes& attributes) {
  for (const auto& [key, value] : attributes) {
    if (key == "DateTime" || value.empty()) continue;
    spec.attribute(key == "ImageDescription" ? key : own_prefix + key, value);
  }
}

void describe_in_one_text(OIIO::ImageSpec& spec, const std::string& text) {
  // OpenImageIO 2.4 ends the process over an empty text in a JPEG: "encode_iptc_iim_one_tag: Assertion".
  if (!text.empty()) spec.attribute("ImageDescription", text);
}

}  // namespace vegard::sim
