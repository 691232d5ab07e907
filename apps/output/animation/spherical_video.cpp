#include "apps/output/animation/movie.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <functional>
#include <string_view>
#include <vector>

#include "sim/base/error.h"
#include "sim/base/version.h"

namespace vegard::apps {
namespace {

constexpr std::size_t kBoxHead = 8;             // size and type
constexpr std::size_t kVisualSampleEntry = 78;  // what a sample's description has before its own boxes
constexpr std::uint64_t kMaxMoovBytes = 1u << 30;
constexpr unsigned char kSphericalUuid[16] = {0xff, 0xcc, 0x82, 0x63, 0xf8, 0x55, 0x4a, 0x93,
                                              0x88, 0x14, 0x58, 0x7a, 0x02, 0x52, 0x1f, 0xdd};

sim::Error bad_movie(const std::string& name, const std::string& problem) {
  return sim::unreadable(name, problem).expected("an MP4 movie");
}

std::uint32_t number_at(std::string_view bytes, std::size_t at) {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < 4; ++i) number = number << 8 | static_cast<unsigned char>(bytes[at + i]);
  return number;
}

std::string bytes_of(std::uint32_t number) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(number >> shift & 0xff);
  return bytes;
}

std::string box(const std::string& type, const std::string& content) {
  return bytes_of(static_cast<std::uint32_t>(kBoxHead + content.size())) + type + content;
}

/// One box within another: all of it, head and content.
struct BoxWithin {
  std::string type;
  std::string_view all;
  std::string_view content() const { return all.substr(kBoxHead); }
};

std::vector<BoxWithin> boxes_in(std::string_view content, const std::string& name) {
  std::vector<BoxWithin> boxes;
  while (!content.empty()) {
    if (content.size() < kBoxHead) throw bad_movie(name, "ends within a box");
    const std::uint32_t size = number_at(content, 0);
    if (size < kBoxHead || size > content.size())
      throw bad_movie(name, "has a box that is larger than what it is in");
    boxes.push_back({std::string(content.substr(4, 4)), content.substr(0, size)});
    content.remove_prefix(size);
  }
  return boxes;
}

/// The first box of a type, at the end of a way down; empty if there is none.
std::string_view box_at(std::string_view content, const std::vector<std::string>& way,
                        const std::string& name) {
  for (const std::string& type : way) {
    std::string_view found;
    for (const BoxWithin& one : boxes_in(content, name))
      if (one.type == type && found.empty()) found = one.content();
    if (found.empty()) return {};
    content = found;
  }
  return content;
}

bool is_video(std::string_view track, const std::string& name) {
  const std::string_view handler = box_at(track, {"mdia", "hdlr"}, name);
  return handler.size() >= 12 && handler.substr(8, 4) == "vide";
}

/// A box's content with one of the boxes within made again.
std::string with_new(std::string_view content, const std::string& type, const std::string& name,
                     const std::function<std::string(std::string_view)>& renewed) {
  std::string all;
  for (const BoxWithin& one : boxes_in(content, name))
    all += one.type == type ? box(type, renewed(one.content())) : std::string(one.all);
  return all;
}

std::string spherical_xml() {
  const auto element = [](const std::string& tag, const std::string& text) {
    return "<GSpherical:" + tag + ">" + text + "</GSpherical:" + tag + ">";
  };
  return "<?xml version=\"1.0\"?><rdf:SphericalVideo "
         "xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\" "
         "xmlns:GSpherical=\"http://ns.google.com/videos/1.0/spherical/\">" +
         element("Spherical", "true") + element("Stitched", "true") +
         element("StitchingSoftware", std::string("vegard ") + sim::version()) +
         element("ProjectionType", "equirectangular") + "</rdf:SphericalVideo>";
}

/// st3d: one picture for both eyes. sv3d: all of the sphere, level, the middle of the picture ahead.
std::string spherical_boxes() {
  const std::string plain(4, '\0');  // version and flags
  const std::string ahead(12, '\0'), uncut(16, '\0');
  return box("st3d", plain + std::string(1, '\0')) +
         box("sv3d", box("svhd", plain + "vegard " + sim::version() + std::string(1, '\0')) +
                         box("proj", box("prhd", plain + ahead) + box("equi", plain + uncut)));
}

/// A table of sample descriptions, each with the boxes at its end.
std::string with_spherical_samples(std::string_view descriptions, const std::string& name) {
  constexpr std::size_t kBefore = 8;  // version, flags, how many
  if (descriptions.size() < kBefore) throw bad_movie(name, "has no description of its samples");
  std::string all(descriptions.substr(0, kBefore));
  for (const BoxWithin& one : boxes_in(descriptions.substr(kBefore), name)) {
    if (one.content().size() < kVisualSampleEntry)
      throw bad_movie(name, "has a description of its samples that is cut");
    all += box(one.type, std::string(one.content()) + spherical_boxes());
  }
  return all;
}

std::string spherical_track(std::string_view track, const std::string& name) {
  const std::string told = with_new(track, "mdia", name, [&](std::string_view media) {
    return with_new(media, "minf", name, [&](std::string_view information) {
      return with_new(information, "stbl", name, [&](std::string_view table) {
        return with_new(table, "stsd", name, [&](std::string_view descriptions) {
          return with_spherical_samples(descriptions, name);
        });
      });
    });
  });
  return told +
         box("uuid", std::string(reinterpret_cast<const char*>(kSphericalUuid), sizeof(kSphericalUuid)) +
                         spherical_xml());
}

}  // namespace

std::string spherical_moov(const std::string& moov, const std::string& name) {
  const std::vector<BoxWithin> whole = boxes_in(moov, name);
  if (whole.size() != 1 || whole.front().type != "moov")
    throw bad_movie(name, "has no description of a movie");
  bool any = false;
  std::string content;
  for (const BoxWithin& one : boxes_in(whole.front().content(), name)) {
    if (one.type == "trak" && is_video(one.content(), name)) {
      content += box("trak", spherical_track(one.content(), name));
      any = true;
    } else {
      content += one.all;
    }
  }
  if (!any) throw bad_movie(name, "has no track of pictures");
  return box("moov", content);
}

void mark_as_spherical(const std::string& path, const std::string& name) {
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  file.seekg(0, std::ios::end);
  const std::uint64_t end = file ? static_cast<std::uint64_t>(file.tellg()) : 0;
  std::uint64_t at = 0;
  while (at + kBoxHead <= end) {
    std::string head(2 * kBoxHead, '\0');
    file.seekg(static_cast<std::streamoff>(at));
    file.read(head.data(), static_cast<std::streamsize>(std::min<std::uint64_t>(head.size(), end - at)));
    if (!file) break;
    std::uint64_t size = number_at(head, 0);
    if (size == 1) size = static_cast<std::uint64_t>(number_at(head, 8)) << 32 | number_at(head, 12);
    if (size == 0) size = end - at;
    if (size < kBoxHead || size > end - at) break;
    if (head.substr(4, 4) == "moov") {
      // What lies behind it would move, and with it the places that it tells.
      if (at + size != end || size > kMaxMoovBytes) break;
      std::string moov(size, '\0');
      file.seekg(static_cast<std::streamoff>(at));
      file.read(moov.data(), static_cast<std::streamsize>(size));
      const std::string told = spherical_moov(moov, name);
      file.seekp(static_cast<std::streamoff>(at));
      file.write(told.data(), static_cast<std::streamsize>(told.size()));
      file.flush();
      if (file) return;
      throw sim::Error(sim::ErrorKind::unwritable_output, "cannot be written")
          .file(name)
          .hint("is the disk full?");
    }
    at += size;
  }
  throw bad_movie(name, "cannot be told to be a panorama: its description is not at its end");
}

}  // namespace vegard::apps
